#pragma once

#include "gl/gl.h"

/// A named piece of GLSL without #version, made from shaders_es3/ at build time.
typedef struct vtChunk {
    const char* name;
    const char* source;
} vtChunk;

#define VT_MAX_CHUNKS 24
#define VT_MAX_SAMPLERS 16

/// What a program is made of: its chunks in order, after {version, precision, constants, frame}.
typedef struct vtProgramDef {
    const char* name;
    const vtChunk* vertex[VT_MAX_CHUNKS];   ///< NULL-terminated
    const vtChunk* fragment[VT_MAX_CHUNKS]; ///< NULL-terminated
    const char* samplers[VT_MAX_SAMPLERS];  ///< NULL-terminated; sampler i reads texture unit i
} vtProgramDef;

/// Compiles and links. On failure the sentence holds the driver's first lines; with `verbose` builds the
/// chunk names tell where its line numbers lie.
vtResult vtCreateProgram(const vtGL* gl, const vtProgramDef* def, GLuint* program, vtError* error);
