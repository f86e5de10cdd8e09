// A command's options as a table: it drives parsing, ranges and --help.
#pragma once

#include "cli/ground_options.h"
#include "context/context.h"
#include "vitrine.h"

#define VT_MAX_OBJECT_OPTIONS 64

/// What `render` and `view` draw a scene with that has reliefs, unless told otherwise.
#define VT_RELIEF_TECHNIQUE "heightfield"

/// What `bench` measures unless told otherwise.
#define VT_BENCH_TECHNIQUES "exact,layered,single"

/// All that `render` and `view` can be told. Zero or NULL means "not given" where a default depends on the
/// model.
typedef struct vtOptions {
    vtFrame frame; ///< the settings, as given; vtMakeFrame adds what is told otherwise
    vtGroundOptions ground;
    vtLimits limits;           ///< of one file, as given
    const char* model;         ///< the first of the models; NULL: there is none
    const char* const* models; ///< of `render`, all of them
    int modelCount;
    const char* list;       ///< a file that names the models
    const char* frameRange; ///< "A:B"
    const char* cameraKeys; ///< a file
    const char* part;       ///< "I/N" or "auto/N"
    int turntable;          ///< frames of a turn; 0: it does not turn
    float fps, shutter;     ///< frames a second; the share of a frame's time that light is gathered
    bool redraw;            ///< a series' pictures, though they are there
    uint64_t stamp;         ///< hash of the options that the picture depends on, as they are written
    const char* output;
    const char* environment;
    const char* background; ///< NULL: the environment
    const char* backdrop;   ///< a picture's file; NULL: none
    float backdropDistance; ///< 0: not given
    const char* technique;
    const char* root; ///< a folder around the models'
    const char *walls, *variant;
    float time;            ///< seconds; -1: not given
    const char* animation; ///< its name or number; NULL: each file's first
    bool asksForFrames;    ///< of something that moves, whatever that is
    bool plays;            ///< files are opened for their animations
    const char* glass;     ///< a kind of glass
    const char* backend;
    const char* directions;
    const char* layerSheet;
    const char* events;
    const char* reference;
    const char* table;
    const char* sweep;
    const char* objects[VT_MAX_OBJECT_OPTIONS]; ///< of --object, as given
    int objectCount;
    bool hasCamera, hasTarget, hasFov; ///< of frame.view, given
    const char* cameraOfFile;          ///< its number or name; NULL: none of them
    int samples;                       ///< a pixel; of the reference, more than a frame can have
    float referenceThreshold;
    float relief, slab, smooth; ///< of MODEL; -1: not given
    int reliefSize;             ///< samples along a side of a built-in relief
    int triangles;              ///< of the knot or the torus; 0: as built in
    int rounds, threads;
    int bits;   ///< of a PNG; 0: not given
    int frames; ///< view: close after so many, 0: never
    bool json;
    bool analysis, verbose, help;
    bool fresnelGiven, noFresnel; ///< as given
    bool fresnel;                 ///< what follows from them; never where strict paths are measured
    bool hasTechnique;            ///< given, or a list of them
    bool triangulates;   ///< several techniques are drawn: reliefs get triangles whatever the option says
    bool innerDistances; ///< set by commands that draw `wyman` whatever the technique option says
} vtOptions;

typedef enum vtCommand {
    vt_commandRender,
    vt_commandView,
    vt_commandLadder,
    vt_commandBench,
    vt_commandRays,
    vt_commandInspect
} vtCommand;

/// Parses the words after the command. Fails with a sentence on an unknown option, a missing or malformed
/// value or one out of range.
vtResult vtParseOptions(vtCommand command, int count, char** words, vtOptions* options, vtError* error);

/// True where --technique names the CPU reference rather than a row of the table.
bool vtIsReference(const vtOptions* options);

/// What is drawn, for reports: the model and the objects, " + " between them.
void vtNameModels(const vtOptions* options, char* text, size_t size);

/// Prints the table.
void vtPrintOptions(vtCommand command);
