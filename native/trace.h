// The reference tracer as the commands use it.
#pragma once

#include "load.h"
#include "reference.h"

/// True where --technique names the CPU reference rather than a row of the table.
bool vtIsReference(const vtOptions* options);

/// A scene of one mesh that stays the caller's: clear glass around which there is air. Not to be destroyed.
typedef struct vtBorrowedScene {
    vtScene scene;
    vtMesh mesh;
    vtMaterial material;
    vtObject object;
} vtBorrowedScene;

/// The scene, filled in.
const vtScene* vtBorrowMesh(const vtMesh* mesh, vtBorrowedScene* borrowed);

/// Traces the frame, with a progress line on standard error where that is a terminal.
vtResult vtTrace(const vtOptions* options, const vtInput* input, const vtFrame* frame,
                 vtReferenceImage* image, vtError* error);

/// The frame's output (picture or analysis) of a traced image: RGBA, allocated by malloc.
vtResult vtTracePixels(const vtReferenceImage* image, const vtFrame* frame, uint8_t** pixels, vtError* error);
