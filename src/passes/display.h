// How the passes that end a frame turn light into a picture: their programs' chunks, and what lies behind.
#pragma once

#include "gl/program.h"
#include "gl/target.h"

/// What such a program is chosen by.
typedef struct vtDisplay {
    vtToneMapping toneMapping;
    bool hasBackground; ///< something of vt_background* is put behind the light
    bool toFloats;      ///< RGBA32UI is drawn to, bits of floats
} vtDisplay;

/// What lies behind, where the display has a background.
typedef struct vtBehind {
    const vtTexture* texture; ///< the picture, or the blurred environment; NULL: a colour
    float color[4];           ///< linear
} vtBehind;

/// The chunk that defines toneMap; NULL: there is none.
const vtChunk* vtDisplay_ToneChunk(vtToneMapping toneMapping);

/// Starts the program of that display: `last` is the fragment shader, display.glsl and what it takes go
/// before it.
const vtProgram* vtDisplay_Start(vtDisplay display, const char* name, const vtChunk* last, const vtGL* gl,
                                 vtProgramList* programs);

/// Binds what lies behind for the program in use.
void vtDisplay_Bind(vtDisplay display, const vtProgram* program, const vtBehind* behind, const vtGL* gl);
