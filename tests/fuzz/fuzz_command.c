// libFuzzer target: whatever the words of a command, they become options and a plan, or a sentence; `inspect`
// and `compare` run to their end. The input is a word a line, and behind "\n==\n" each, the files that are
// read, whatever their names. Nothing is drawn or written.
#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/camera_path.h"
#include "cli/commands.h"
#include "cli/files.h"
#include "cli/output_name.h"
#include "cli/picture_output.h"
#include "cli/series.h"
#include "cli/series_plan.h"
#include "fuzz.h"
#include "scene/object_spec.h"
#include "technique/background.h"

enum { mostWords = 40, mostSize = 4096 };

// ------------------------------------------------------------------------------- files (linked with --wrap)

vtResult __wrap_vtReadFile(const char* path, uint8_t** bytes, size_t* size, vtError* error);
vtResult __wrap_vtReadText(const char* path, char** text, vtError* error);
vtResult __wrap_vtWriteFile(const char* path, const void* bytes, size_t size, vtError* error);

/// Of this run.
static FuzzFile files[4];
static int fileCount, filesRead;

vtResult __wrap_vtReadFile(const char* path, uint8_t** bytes, size_t* size, vtError* error)
{
    (void)path;
    (void)error;
    const FuzzFile file = fileCount > 1 ? files[1 + filesRead++ % (fileCount - 1)] : (FuzzFile){NULL, 0};
    *bytes = vtAllocate(file.size, 1);
    require(*bytes != NULL);
    if (file.size > 0) {
        memcpy(*bytes, file.bytes, file.size);
    }
    *size = file.size;
    return vt_ok;
}

vtResult __wrap_vtReadText(const char* path, char** text, vtError* error)
{
    uint8_t* bytes;
    size_t size;
    __wrap_vtReadFile(path, &bytes, &size, error);
    *text = calloc(size + 1, 1);
    require(*text != NULL);
    memcpy(*text, bytes, size);
    vtFree(bytes);
    return vt_ok;
}

vtResult __wrap_vtWriteFile(const char* path, const void* bytes, size_t size, vtError* error)
{
    (void)path;
    (void)bytes;
    (void)size;
    (void)error;
    return vt_ok;
}

// --------------------------------------------------------------------------------------------------- words

/// What becomes of a series' names and views.
static void checkPlan(const vtOptions* options)
{
    vtPlan plan;
    vtError error = {0};
    char path[256];
    const vtResult result = vtMakePlan(options, &plan, &error);
    requireSentence(result, &error);
    const int frames = result == vt_ok ? vtPlan_CountFrames(&plan, 2.5) : 0;
    for (size_t i = 0; result == vt_ok && i < plan.modelCount && i < 4; ++i) {
        const char* model = plan.models[i] != NULL ? plan.models[i] : "scene";
        const int number = plan.hasFrames ? plan.firstFrame : -1;
        requireSentence(vtNameOutput(options->output, model, number, path, sizeof path, &error), &error);
        require(vtPlan_CountOwn(&plan, i, frames < 64 ? frames : 64) >= 0);
    }
    plan.eye.view = options->frame.view;
    for (int i = 0; result == vt_ok && i < 4; ++i) {
        vtFrame frame = options->frame;
        vtCameraPath_SetView(&plan.eye, (double)plan.firstFrame + 0.3 * i, &frame);
        requireFinite(&frame.view.eye.x, sizeof frame.view / sizeof(float));
    }
    vtDestroyPlan(&plan);
}

static void checkOptions(vtCommand command, int count, char** words)
{
    vtOptions options;
    vtError error = {0};
    vtResult result = vtParseOptions(command, count, words, &options, &error);
    requireSentence(result, &error);
    if (result != vt_ok) {
        return;
    }
    vtObjectSpec spec;
    vtPictureFormat format;
    vtFrame frame = options.frame;
    for (int i = 0; i < options.objectCount; ++i) {
        requireSentence(vtParseObject(options.objects[i], "--object", false, &spec, &error), &error);
    }
    requireSentence(vtValidateFrame(&frame, &error), &error);
    if (options.background != NULL) {
        requireSentence(vtFrame_SetBackground(&frame, options.background, &error), &error);
    }
    requireSentence(vtChoosePictureFormat(&options, &format, &error), &error);
    char names[100];
    vtNameModels(&options, names, sizeof names);
    if (options.help) {
        vtPrintOptions(command);
    } else if (command == vt_commandInspect) {
        error.message[0] = '\0';
        requireSentence(vtRunInspect(&options, &error), &error);
    } else if (command == vt_commandRender && vtIsSeries(&options)) {
        checkPlan(&options);
    }
}

static void runWords(int count, char** words)
{
    static const struct {
        const char* name;
        vtCommand command;
    } commands[] = {{"render", vt_commandRender}, {"view", vt_commandView}, {"ladder", vt_commandLadder},
                    {"bench", vt_commandBench},   {"rays", vt_commandRays}, {"inspect", vt_commandInspect}};
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; ++i) {
        if (strcmp(words[0], commands[i].name) == 0) {
            checkOptions(commands[i].command, count, words);
        }
    }
    vtError error = {0};
    if (strcmp(words[0], "compare") == 0) {
        requireSentence(vtRunCompare(count, words, &error), &error);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size)
{
    char text[mostSize + 1], nothing[] = "";
    char *words[mostWords + 1] = {text}, *none[] = {nothing, NULL};
    fileCount = cutInput(bytes, size, files, 4);
    filesRead = 0;
    const size_t length = files[0].size < mostSize ? files[0].size : mostSize;
    memcpy(text, files[0].bytes, length);
    text[length] = '\0';
    int count = 1;
    for (char* end = strchr(text, '\n'); end != NULL && count < mostWords; end = strchr(end + 1, '\n')) {
        *end = '\0';
        words[count++] = end + 1;
    }
    words[count] = NULL;
    optind = 0; // getopt forgets the words of the run before
    (void)getopt(1, none, "");
    runWords(count, words);
    return 0;
}
