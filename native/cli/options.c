#include "cli/options.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "cli/hash.h"
#include "cli/limit_options.h"
#include "cli/object_help.h"
#include "cli/output_name.h"
#include "cli/setting_options.h"
#include "cli/video.h"
#include "lab/metrics/timing.h"

typedef enum Kind {
    kindFlag,
    kindText,
    kindList,
    kindInteger,
    kindNumber,
    kindSize,
    kindSetting,
    kindGround,
    kindLimit
} Kind;

typedef struct Option {
    const char* name;
    char letter;
    Kind kind;
    size_t offset; // in vtOptions
    double low, high;
    const char* argument;
    const char* help;
    unsigned commands; // bit set of vtCommand
} Option;

#define RENDER (1u << vt_commandRender)
#define VIEW (1u << vt_commandView)
#define LADDER (1u << vt_commandLadder)
#define BENCH (1u << vt_commandBench)
#define RAYS (1u << vt_commandRays)
#define INSPECT (1u << vt_commandInspect)
#define SCENE (RENDER | VIEW | LADDER | BENCH)
#define AT(field) offsetof(vtOptions, field)
// Everything else of it stands in the table of settings.
#define SETTING(title, where)                                                                                \
    {                                                                                                        \
        .name = title, .kind = kindSetting, .commands = where                                                \
    }
#define GROUND(title, value, text)                                                                           \
    {                                                                                                        \
        .name = title, .kind = kindGround, .argument = value, .help = text, .commands = RENDER | VIEW        \
    }

#define LIMIT(title, value, text)                                                                            \
    {                                                                                                        \
        .name = title, .kind = kindLimit, .argument = value, .help = text, .commands = SCENE | INSPECT       \
    }

static const Option table[] = {
    {"object", 0, kindList, AT(objects), 0, 0, "NAME[:KEYS]", "one more object, see below; up to 64 times",
     SCENE},
    {"root", 0, kindText, AT(root), 0, 0, "DIR",
     "models may name files anywhere in this folder, too, as ../textures/a.png (their own folder only)",
     SCENE | INSPECT},
    {"walls", 0, kindText, AT(walls), 0, 0, "auto|thin|solid",
     "glass of models: as the file says, or all of it thin walls or solid bodies (auto)", SCENE},
    {"variant", 0, kindText, AT(variant), 0, 0, "NAME", "of the files' variants of their materials (none)",
     SCENE},
    {"time", 0, kindNumber, AT(time), 0, 1e6, "SECONDS",
     "of the files' animations: where they have everything then (at rest; view plays)", SCENE},
    {"animation", 0, kindText, AT(animation), 0, 0, "NAME|N",
     "which of the files' animations; none: at rest (each file's first)", SCENE},
    {"output", 'o', kindText, AT(output), 0, 0, "FILE",
     "the picture: PNG, or by its name's end linear light, .exr or .hdr; - is standard output, PNG. Of "
     "several "
     "{name} is the model's and {frame} the number; .mp4, .mov, .mkv, .webm: a film, by ffmpeg",
     RENDER},
    {"output", 'o', kindText, AT(output), 0, 0, "FILE", "the picture, PNG; - is standard output", LADDER},
    {"bits", 0, kindInteger, AT(bits), 8, 16, "N", "of a PNG's numbers, 8 or 16 (8)", RENDER},
    {"list", 0, kindText, AT(list), 0, 0, "FILE",
     "the models, a line each, a picture of each; - is standard input", RENDER},
    {"turntable", 0, kindInteger, AT(turntable), 1, 100000, "N", "a turn about the upright axis in N frames",
     RENDER},
    {"camera-keys", 0, kindText, AT(cameraKeys), 0, 0, "FILE",
     "the eye moves: lines SECONDS X,Y,Z X,Y,Z [DEGREES], the eye, what it looks at, its field of view",
     RENDER},
    {"frames", 0, kindText, AT(frameRange), 0, 0, "A:B",
     "the first and the last, counted from 0 (all there are)", RENDER},
    {"fps", 0, kindNumber, AT(fps), 0.01, 1000, "N", "frames a second (24)", RENDER},
    {"shutter", 0, kindNumber, AT(shutter), 0, 1, "N",
     "motion blur: the samples are spread over this share of a frame's time (0)", RENDER},
    {"part", 0, kindText, AT(part), 0, 0, "I/N",
     "of the pictures part I of N, from 1 on; auto/N: I by Slurm, Kubernetes or GNU parallel (by a job array "
     "of "
     "Slurm, else 1/1)",
     RENDER},
    {"redraw", 0, kindFlag, AT(redraw), 0, 0, NULL, "draw again what is there, whole and of the same options",
     RENDER},
    {"technique", 't', kindText, AT(technique), 0, 0, "ID", "see 'vitrine list' (exact)", RENDER | VIEW},
    {"technique", 't', kindText, AT(technique), 0, 0, "ID,ID,...",
     "see 'vitrine list' (" VT_BENCH_TECHNIQUES ", of a relief " VT_RELIEF_TECHNIQUE
     " before them; sweeps over objects: exact)",
     BENCH},
    SETTING("preset", SCENE),
    SETTING("layers", SCENE),
    SETTING("steps", SCENE),
    SETTING("refine", SCENE),
    SETTING("max-events", SCENE),
    SETTING("layer-size", SCENE),
    {"glass", 0, kindText, AT(glass), 0, 0, "NAME",
     "index and dispersion of all glass are those of this kind, see 'vitrine list' (none)", SCENE},
    SETTING("ior", SCENE),
    SETTING("roughness", SCENE),
    SETTING("dispersion", SCENE),
    {"relief", 0, kindNumber, AT(relief), 0, 10, "DEPTH",
     "MODEL is a relief: its depth from black to white (0.1; a built-in one's own)", SCENE | RAYS},
    {"slab", 0, kindNumber, AT(slab), 0.001, 10, "THICKNESS", "a relief's glass behind black (0.1)",
     SCENE | RAYS},
    {"smooth", 0, kindNumber, AT(smooth), 0, 64, "SAMPLES",
     "a relief's heights are smoothed over so many (0; pictures of 8 bits 2)", SCENE | RAYS},
    {"relief-size", 0, kindInteger, AT(reliefSize), 2, VT_MAX_RELIEF_SIDE, "N",
     "samples along a side of a built-in relief (512)", SCENE | RAYS},
    SETTING("transmittance", SCENE),
    SETTING("max-transmittance", SCENE),
    SETTING("min-transmittance", SCENE),
    SETTING("power", SCENE),
    SETTING("wall-thickness", SCENE),
    SETTING("back-surface", SCENE),
    {"environment", 'e', kindText, AT(environment), 0, 0, "NAME|FILE",
     "see 'vitrine list', or a picture, equirectangular or of six faces (studio)", SCENE},
    SETTING("exposure", SCENE),
    SETTING("tone-mapping", RENDER | VIEW),
    {"background", 0, kindText, AT(background), 0, 0, "WHAT",
     "behind the scene: environment, blurred[:DEGREES], #rrggbb, a picture's file, transparent (environment)",
     RENDER | VIEW},
    {"backdrop", 0, kindText, AT(backdrop), 0, 0, "FILE",
     "a picture behind the scene that glass shows bent: it fills the frame and keeps its colours, glass goes "
     "on "
     "reflecting the environment; exact, heightfield and reference show it",
     RENDER | VIEW},
    {"backdrop-distance", 0, kindNumber, AT(backdropDistance), 0, 1e6, "N",
     "of it behind --target (beyond all of the scene)", RENDER | VIEW},
    GROUND("ground", "=Y",
           "a ground at this height, which catches shadows and light (at the scene's lowest point); exact, "
           "heightfield and reference show it"),
    GROUND("ground-color", "R,G,B",
           "of a matt ground, linear, 0 to 1 each (none: what is seen of it is the environment)"),
    GROUND("sun", "X,Y,Z[,SIZE[,R,G,B]]",
           "light from this direction on the ground and on opaque things, which cast shadows; the sun's "
           "diameter in degrees, its irradiance in the unit of the environment's radiance times steradians "
           "(the environment's own; 0.53, 3,3,3)"),
    GROUND("shadow-intensity", "N", "of what the scene does to the light on the ground (1), 0 to 1"),
    GROUND("shadow-softness", "N",
           "0: as the lights are wide, to 1: blurred over a tenth of the map (0), 0 to 1"),
    SETTING("camera", SCENE | RAYS),
    SETTING("target", SCENE | RAYS),
    SETTING("fov", SCENE | RAYS),
    {"camera-index", 0, kindText, AT(cameraOfFile), 0, 0, "N|NAME",
     "the files' camera of this number or name; --camera, --target and --fov go before it (none)",
     RENDER | VIEW},
    {"resolution", 'r', kindSize, AT(frame.width), 0, 0, "W,H", "pixels (512,512)", SCENE},
    {"directions", 0, kindText, AT(directions), 0, 0, "FILE",
     "exit directions as PFM; 0,0,0 background, 2,2,2 lost", RENDER},
    {"layer-sheet", 0, kindText, AT(layerSheet), 0, 0, "FILE", "depth and normal of each layer, PNG", RENDER},
    {"analysis", 0, kindFlag, AT(analysis), 0, 0, NULL,
     "path colours: red 2 refractions, blue more, green total reflection, grey lost", RENDER | VIEW},
    {"rendering-backend", 0, kindText, AT(backend), 0, 0, "auto|osmesa|egl", "headless GL (auto)",
     RENDER | LADDER | BENCH},
    {"fresnel", 0, kindFlag, AT(fresnelGiven), 0, 0, NULL,
     "with Fresnel reflection, the default; given, it holds for --directions too", RENDER | VIEW},
    {"no-fresnel", 0, kindFlag, AT(noFresnel), 0, 0, NULL, "paths only refract, or reflect where they must",
     RENDER | VIEW},
    SETTING("branches", RENDER | VIEW | BENCH),
    SETTING("wavelengths", RENDER | VIEW),
    SETTING("multi", RENDER | VIEW | BENCH),
    SETTING("search", RENDER | VIEW | BENCH),
    {"events", 0, kindText, AT(events), 0, 0, "FILE",
     "reference: number of events of each pixel's path, grey PNG, for 'compare --events'", RENDER},
    {"samples", 0, kindInteger, AT(samples), 1, 65536, "N",
     "a pixel, for smooth edges; more than 4096 the reference only (1, its centre)", RENDER | LADDER},
    {"samples", 0, kindInteger, AT(samples), 1, VT_MAX_SAMPLES, "N",
     "a pixel, one a frame while the view stands still (64)", VIEW},
    {"reference", 0, kindText, AT(reference), 0, 0, "FILE", "fail where the picture differs from this one",
     RENDER},
    {"reference-threshold", 0, kindNumber, AT(referenceThreshold), 0, 1, "T",
     "by more than this mean FLIP (0.05)", RENDER},
    {"table", 0, kindText, AT(table), 0, 0, "FILE", "the figures as a Markdown table; - is standard output",
     LADDER | BENCH | RAYS},
    {"json", 0, kindFlag, AT(json), 0, 0, NULL, "one JSON object on standard output instead of the table",
     BENCH | RAYS | INSPECT},
    {"sweep", 0, kindText, AT(sweep), 0, 0, "triangles|resolution|relief|objects|depth",
     "measure again and again: knot or torus of 1,000 to 1,000,000 triangles, pictures of 256 to 2048, a "
     "built-in relief of five sizes up to --relief-size (4096), or 1 to 16 copies side by side or one behind "
     "the other",
     BENCH},
    {"triangles", 0, kindInteger, AT(triangles), 200, 4e6, "N",
     "about so many, of the knot or the torus (theirs)", BENCH},
    {"rounds", 0, kindInteger, AT(rounds), 1, vt_maxTimingRounds, "N",
     "frames whose median is taken (9; 3 where they take more than 40 s)", BENCH},
    {"rounds", 0, kindInteger, AT(rounds), 1, vt_maxTimingRounds, "N", "whose median is taken (5)", RAYS},
    {"threads", 0, kindInteger, AT(threads), 1, 32, "N", "of llvmpipe and of the reference (all processors)",
     BENCH},
    {"frames", 0, kindInteger, AT(frames), 1, 1000000, "N", "close the window after so many frames", VIEW},
    LIMIT("max-memory", "SIZE",
          "a file that asks for more than this is refused, with all that it unpacks and those beside it, as "
          "512M (4G)"),
    LIMIT("max-triangles", "N", "a file with more is refused (50M)"),
    LIMIT(
        "max-pixels", "N",
        "a picture of more is neither read nor drawn (67108864, 8192 x 8192); more than 134217728 are never "
        "read"),
    {"verbose", 'v', kindFlag, AT(verbose), 0, 0, NULL, "say what is done, on what, with how much memory",
     SCENE | RAYS},
    {"help", 'h', kindFlag, AT(help), 0, 0, NULL, "this text", SCENE | RAYS | INSPECT},
};
#define OPTION_COUNT ((int)(sizeof table / sizeof table[0]))

static vtResult storeNumber(const Option* option, const char* text, void* field, vtError* error)
{
    const vtRange range = {option->low, option->high, option->kind == kindInteger};
    double number;
    vtResult result = vtReadOption(option->name, text, &range, 1, &number, error);
    if (result == vt_ok && range.isWhole) {
        *(int*)field = (int)number;
    } else if (result == vt_ok) {
        *(float*)field = (float)number;
    }
    return result;
}

static vtResult storeSize(const Option* option, const char* text, vtFrame* frame, vtError* error)
{
    const vtSetting *width = vtFindSetting("width"), *height = vtFindSetting("height");
    const vtRange range = vtRangeOfSetting(width);
    double numbers[2];
    vtResult result = vtReadOption(option->name, text, &range, 2, numbers, error);
    if (result == vt_ok) {
        vtSetting_Set(width, frame, numbers[0]);
        vtSetting_Set(height, frame, numbers[1]);
    }
    return result;
}

static vtResult storeSetting(const Option* option, const char* text, vtOptions* options, vtError* error)
{
    const vtSetting* setting = vtFindSetting(option->name);
    options->hasCamera |= setting->offset == offsetof(vtFrame, view.eye);
    options->hasTarget |= setting->offset == offsetof(vtFrame, view.target);
    options->hasFov |= setting->offset == offsetof(vtFrame, view.fovY);
    return vtReadSetting(setting, text, &options->frame, error);
}

static vtResult store(const Option* option, char* value, vtOptions* options, vtError* error)
{
    void* field = (char*)options + option->offset;
    switch (option->kind) {
    case kindFlag:
        *(bool*)field = true;
        return vt_ok;
    case kindText:
        options->hasTechnique |= option->offset == AT(technique);
        *(const char**)field = value;
        return vt_ok;
    case kindList:
        if (options->objectCount == VT_MAX_OBJECT_OPTIONS) {
            return vtFail(error, vt_errorArgument,
                          "--object '%.200s' is one too many; at most %d can be given", value,
                          VT_MAX_OBJECT_OPTIONS);
        }
        ((const char**)field)[options->objectCount++] = value;
        return vt_ok;
    case kindSize:
        return storeSize(option, value, &options->frame, error);
    case kindSetting:
        return storeSetting(option, value, options, error);
    case kindLimit:
        return vtReadLimit(option->name, value, &options->limits, error);
    case kindGround:
        return vtReadGroundOption(option->name, value, &options->ground, error);
    default:
        return storeNumber(option, value, field, error);
    }
}

/// Does a picture of a series depend on it? What files hold is looked at as well, whatever their names.
static bool isOfPicture(const Option* option)
{
    static const char* const others[] = {"output",     "list",          "camera-keys", "frames",
                                         "part",       "redraw",        "verbose",     "help",
                                         "max-memory", "max-triangles", "max-pixels"};
    bool is = true;
    for (size_t i = 0; i < sizeof others / sizeof others[0]; ++i) {
        is = is && strcmp(option->name, others[i]) != 0;
    }
    return is;
}

vtResult vtParseOptions(vtCommand command, int count, char** words, vtOptions* options, vtError* error)
{
    const vtFrame frame = vtDefaultFrame();
    *options = (vtOptions){
        .frame = frame,
        .ground = {.ground = vtDefaultGround()},
        .environment = "studio",
        .technique = command == vt_commandBench ? VT_BENCH_TECHNIQUES : vtTechnique_Info(frame.technique)->id,
        .backend = "auto",
        .samples = command == vt_commandView ? 64 : 1,
        .referenceThreshold = 0.05f,
        .fps = 24.0f,
        .stamp = vtHashText(VT_NO_HASH, VT_VERSION),
        .time = -1.0f,
        .relief = -1.0f,
        .slab = -1.0f,
        .smooth = -1.0f,
        .triangulates = command == vt_commandLadder || command == vt_commandBench,
        .hasTechnique = command != vt_commandRender && command != vt_commandView,
    };

    // The table in getopt's form.
    struct option longOptions[OPTION_COUNT + 1] = {0};
    char letters[2 * OPTION_COUNT + 2] = ":";
    for (int i = 0, used = 0, length = 1; i < OPTION_COUNT; ++i) {
        if ((table[i].commands & (1u << command)) == 0) {
            continue;
        }
        bool takesValue = table[i].kind != kindFlag;
        const bool may = table[i].argument != NULL && table[i].argument[0] == '='; // have a value
        longOptions[used++] =
            (struct option){table[i].name, may ? optional_argument : takesValue, NULL, 256 + i};
        if (table[i].letter != 0) {
            letters[length++] = table[i].letter;
            letters[length] = ':';
            length += takesValue;
            letters[length] = '\0';
        }
    }

    opterr = 0;
    optind = 1;
    int code;
    while ((code = getopt_long(count, words, letters, longOptions, NULL)) != -1) {
        const char* word = words[optind - 1];
        if (code == ':') {
            return vtFail(error, vt_errorArgument, "option %s needs a value; see 'vitrine %s --help'", word,
                          words[0]);
        }
        if (code == '?') {
            return vtFail(error, vt_errorArgument, "unknown option %s; see 'vitrine %s --help'", word,
                          words[0]);
        }
        const Option* option = &table[0];
        while (code < 256 ? option->letter != code : option != &table[code - 256]) {
            ++option;
        }
        vtResult result = store(option, optarg, options, error);
        if (result != vt_ok) {
            return result;
        }
        if (isOfPicture(option)) {
            options->stamp = vtHashText(options->stamp, option->name);
            options->stamp = vtHashText(options->stamp, optarg != NULL ? optarg : "");
        }
    }
    options->models = (const char* const*)&words[optind];
    options->modelCount = count - optind;
    options->model = optind < count ? words[optind] : NULL;
    if (command != vt_commandRender && options->modelCount > 1) {
        return vtFail(error, vt_errorArgument,
                      "one model is named by itself; '%s' is a second one, add it with --object",
                      options->models[1]);
    }
    if (options->fresnelGiven && options->noFresnel) {
        return vtFail(error, vt_errorArgument, "--fresnel and --no-fresnel contradict each other; give one");
    }
    const bool isStill = options->animation != NULL && strcmp(options->animation, "none") == 0;
    if (isStill && options->time >= 0.0f) {
        return vtFail(error, vt_errorArgument, "--time and --animation none contradict each other; give one");
    }
    const char* output = options->output != NULL ? options->output : "";
    options->asksForFrames = options->frameRange != NULL || options->shutter > 0.0f || vtIsVideo(output) ||
                             vtPatternHas(output, "{frame}");
    // Frames are those of the files' animations, unless the eye's way gives them.
    const bool eyeMoves = options->turntable > 0 || options->cameraKeys != NULL;
    options->plays = !isStill && (command == vt_commandView || options->time >= 0.0f ||
                                  options->animation != NULL || (options->asksForFrames && !eyeMoves));
    if (options->backdropDistance > 0.0f && options->backdrop == NULL) {
        return vtFail(error, vt_errorArgument,
                      "--backdrop-distance says something of a backdrop; add --backdrop");
    }
    const vtGlassInfo* glass = vtFindGlass(options->glass);
    if (options->glass != NULL && glass == NULL) {
        return vtFail(error, vt_errorArgument, "--glass is '%.100s', which is unknown; see 'vitrine list'",
                      options->glass);
    }
    if (glass != NULL) { // a number that is given goes before it
        vtFrame* chosen = &options->frame;
        chosen->ior = chosen->ior > 0.0f ? chosen->ior : glass->ior;
        chosen->dispersion = chosen->dispersion >= 0.0f ? chosen->dispersion : 20.0f / glass->abbe;
    }
    // The other commands compare strict paths.
    options->fresnel = !options->noFresnel && (command == vt_commandRender || command == vt_commandView);
    const vtResult result =
        vtCheckDrawn(options->frame.width, options->frame.height, &options->limits, error);
    return result == vt_ok ? vtCheckGroundOptions(&options->ground, error) : result;
}

bool vtIsReference(const vtOptions* options)
{
    return strcmp(options->technique, "reference") == 0;
}

void vtNameModels(const vtOptions* options, char* text, size_t size)
{
    snprintf(text, size, "%s", options->model != NULL ? options->model : "");
    for (int i = 0; i < options->objectCount; ++i) {
        const size_t used = strlen(text);
        snprintf(text + used, size - used, "%s%s", used > 0 ? " + " : "", options->objects[i]);
    }
}

void vtPrintOptions(vtCommand command)
{
    bool objects = false;
    for (int i = 0; i < OPTION_COUNT; ++i) {
        const Option* option = &table[i];
        if ((option->commands & (1u << command)) == 0) {
            continue;
        }
        objects = objects || option->kind == kindList;
        char left[64], range[48] = "", letter[5] = "    ";
        if (option->letter != 0) {
            snprintf(letter, sizeof letter, "-%c, ", option->letter);
        }
        if (option->kind == kindSetting) {
            vtPrintSetting(vtFindSetting(option->name));
            continue;
        }
        const char* argument = option->argument != NULL ? option->argument : "";
        snprintf(left, sizeof left, argument[0] == '=' ? "%s--%s[%s]" : "%s--%s %s", letter, option->name,
                 argument);
        if (option->high > option->low) {
            snprintf(range, sizeof range, ", %g to %g", option->low, option->high);
        }
        printf(VT_OPTION_LINE, left, option->help, range);
    }
    if (objects) {
        vtPrintObjectHelp();
    }
}
