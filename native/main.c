#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "cli/commands.h"
#include "cli/setting_options.h"
#include "gltf/features.h"

static void printUsage(void)
{
    printf(
        "vitrine: glass through OpenGL ES 3.0, with every refraction and internal reflection\n"
        "\n"
        "  vitrine render MODEL -o OUT.png [options]   draw a picture, no screen needed; or many: a film of "
        "what\n"
        "                                              moves, all frames of it, a picture of each of many "
        "models\n"
        "  vitrine ladder MODEL [options]              every technique beside the reference, with its error\n"
        "  vitrine bench MODEL [options]               time, memory and accuracy beside the reference\n"
        "  vitrine rays RELIEF [options]               its heights traced beside Embree's triangles\n"
        "  vitrine compare A B [options]               measure a picture or directions against the truth\n"
        "  vitrine view MODEL [options]                turn the object in a window\n"
        "  vitrine inspect FILE [--json]               what is in a glTF file, and what of it is drawn\n"
        "  vitrine list                                techniques, shapes, reliefs, kinds of glass, "
        "environments, tone mappings\n"
        "  vitrine list --settings                     the settings of a frame, as JSON\n"
        "  vitrine list --gltf                         what of glTF is drawn, as a Markdown table\n"
        "  vitrine COMMAND --help                      the options of each\n"
        "  vitrine --version\n"
        "\n"
        "MODEL is a .glb or .gltf file, a built-in shape, or a relief: a picture of heights (.png, .jpg, "
        ".hdr, .pfm)\n"
        "or a built-in pattern. - reads a file from standard input.\n"
        "Further objects: --object, see 'vitrine render --help'.\n");
}

static void printList(void)
{
    printf("techniques:\n");
    for (int i = 0; i < vt_techniqueCount; ++i) {
        const vtTechniqueInfo* info = vtTechnique_Info((vtTechnique)i);
        printf("  %-14s %s\n  %-14s %s, %d\n", info->id, info->summary, "", info->source, info->year);
    }
    printf("  %-14s %s\n  %-14s %s, %d\n", "reference", "CPU ray tracer, the yardstick (Embree)", "",
           "Whitted, An Improved Illumination Model for Shaded Display", 1980);
    printf("shapes:\n");
    for (int i = 0; vtShapeName(i) != NULL; ++i) {
        printf("  %-14s %s\n", vtShapeName(i), vtShapeSummary(i));
    }
    printf("reliefs:\n");
    for (int i = 0; vtReliefPatternName(i) != NULL; ++i) {
        printf("  %-14s %s\n", vtReliefPatternName(i), vtReliefPatternSummary(i));
    }
    printf("kinds of glass:\n");
    const vtGlassInfo* glass;
    for (int i = 0; (glass = vtGlass_Info(i)) != NULL; ++i) {
        printf("  %-14s index %g, Abbe number %g; %s\n", glass->name, (double)glass->ior, (double)glass->abbe,
               glass->source);
    }
    printf("environments:\n");
    for (int i = 0; vtEnvironmentName(i) != NULL; ++i) {
        printf("  %-14s %s\n", vtEnvironmentName(i), vtEnvironmentSummary(i));
    }
    printf("tone mappings:\n");
    for (int i = 0; vtToneMappingName(i) != NULL; ++i) {
        printf("  %-14s %s\n", vtToneMappingName(i), vtToneMappingSummary(i));
    }
}

static void printGltf(void)
{
    printf("| glTF | here | |\n|---|---|---|\n");
    const vtGltfFeature* feature;
    for (int i = 0; (feature = vtGltfFeature_At(i)) != NULL; ++i) {
        const char* quote = feature->isExtension ? "`" : "";
        printf("| %s%s%s | %s | %s |\n", quote, feature->name, quote, vtGltfSupport_Name(feature->support),
               feature->how);
    }
}

static int report(vtResult result, const vtError* error)
{
    if (result == vt_ok) {
        return 0;
    }
    fprintf(stderr, "vitrine: %s\n", error->message);
    return 1;
}

typedef vtResult vtRunFcn(const vtOptions* options, vtError* error);

static const struct {
    const char* name;
    vtCommand command;
    vtRunFcn* run;
} commands[] = {
    {"render", vt_commandRender, vtRunRender}, {"view", vt_commandView, vtRunView},
    {"ladder", vt_commandLadder, vtRunLadder}, {"bench", vt_commandBench, vtRunBench},
    {"rays", vt_commandRays, vtRunRays},       {"inspect", vt_commandInspect, vtRunInspect},
};

static int runCommand(int index, int count, char** words)
{
    vtOptions options;
    vtError error = {0};
    vtResult result = vtParseOptions(commands[index].command, count, words, &options, &error);
    if (result == vt_ok && options.help) {
        if (commands[index].command == vt_commandInspect) {
            printf("vitrine inspect FILE [options]; FILE is a .glb or .gltf file, - is standard input\n\n");
            vtPrintOptions(commands[index].command);
            return 0;
        }
        printf("vitrine %s MODEL [options]; MODEL is a .glb or .gltf file, a picture of heights or a "
               "built-in shape or relief, or left out where --object names what is drawn\n\n",
               words[0]);
        vtPrintOptions(commands[index].command);
        return 0;
    }
    if (result == vt_ok) {
        result = commands[index].run(&options, &error);
    }
    return report(result, &error);
}

static int runList(int count, char** words)
{
    if (count == 0) {
        printList();
        return 0;
    }
    if (count == 1 && strcmp(words[0], "--settings") == 0) {
        vtPrintSettings();
        return 0;
    }
    if (count == 1 && strcmp(words[0], "--gltf") == 0) {
        printGltf();
        return 0;
    }
    fprintf(stderr, "vitrine: list takes --settings, --gltf or nothing; '%s' is none of them\n",
            words[count - 1]);
    return 1;
}

static int run(int argc, char** argv)
{
    const char* command = argc > 1 ? argv[1] : "";
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; ++i) {
        if (strcmp(command, commands[i].name) == 0) {
            return runCommand((int)i, argc - 1, argv + 1);
        }
    }
    if (strcmp(command, "compare") == 0) {
        vtError error = {0};
        return report(vtRunCompare(argc - 1, argv + 1, &error), &error);
    }
    if (strcmp(command, "list") == 0) {
        return runList(argc - 2, argv + 2);
    }
    if (strcmp(command, "--version") == 0) {
        printf("vitrine %s\n", VT_VERSION);
        return 0;
    }
    if (strcmp(command, "--help") == 0 || strcmp(command, "-h") == 0 || strcmp(command, "help") == 0) {
        printUsage();
        return 0;
    }
    if (*command == '\0') {
        fprintf(stderr, "vitrine: no command given; see 'vitrine --help'\n");
    } else {
        fprintf(stderr, "vitrine: unknown command '%s'; see 'vitrine --help'\n", command);
    }
    return 1;
}

int main(int argc, char** argv)
{
    // What can no longer be written is an error with its reason, not the end of the program.
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    const int code = run(argc, argv);
    if (fflush(stdout) != 0 || ferror(stdout)) {
        fprintf(stderr, "vitrine: standard output cannot be written: %s\n", strerror(errno));
        return 1;
    }
    return code;
}
