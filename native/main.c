#include <stdio.h>
#include <string.h>

#include "commands.h"

static void printUsage(void)
{
    printf("vitrine: glass through OpenGL ES 3.0, with every refraction and internal reflection\n"
           "\n"
           "  vitrine render MODEL -o OUT.png [options]   draw a picture, no screen needed\n"
           "  vitrine view MODEL [options]                turn the object in a window\n"
           "  vitrine list                                techniques, shapes, environments\n"
           "  vitrine render --help, vitrine view --help  the options of each\n"
           "  vitrine --version\n"
           "\n"
           "MODEL is a .glb or .gltf file (- reads a .glb from standard input) or a built-in shape.\n");
}

static void printList(void)
{
    printf("techniques:\n");
    for (int i = 0; i < vt_techniqueCount; ++i) {
        const vtTechniqueInfo* info = vtTechnique_Info((vtTechnique)i);
        printf("  %-14s %s\n  %-14s %s, %d\n", info->id, info->summary, "", info->source, info->year);
    }
    printf("shapes:\n");
    for (int i = 0; vtShapeName(i) != NULL; ++i) {
        printf("  %-14s %s\n", vtShapeName(i), vtShapeSummary(i));
    }
    printf("environments:\n");
    for (int i = 0; vtEnvironmentName(i) != NULL; ++i) {
        printf("  %-14s %s\n", vtEnvironmentName(i), vtEnvironmentSummary(i));
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

static int runCommand(vtCommand command, int count, char** words)
{
    vtOptions options;
    vtError error = {0};
    vtResult result = vtParseOptions(command, count, words, &options, &error);
    if (result != vt_ok) {
        return report(result, &error);
    }
    if (options.help) {
        printf("vitrine %s MODEL [options]; MODEL is a .glb or .gltf file or a built-in shape\n\n", words[0]);
        vtPrintOptions(command);
        return 0;
    }
    result = command == vt_commandRender ? vtRunRender(&options, &error) : vtRunView(&options, &error);
    return report(result, &error);
}

int main(int argc, char** argv)
{
    const char* command = argc > 1 ? argv[1] : "";
    if (strcmp(command, "render") == 0) {
        return runCommand(vt_commandRender, argc - 1, argv + 1);
    }
    if (strcmp(command, "view") == 0) {
        return runCommand(vt_commandView, argc - 1, argv + 1);
    }
    if (strcmp(command, "list") == 0) {
        printList();
        return 0;
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
