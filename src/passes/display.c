#include "passes/display.h"

#include "shaders.h"

const vtChunk* vtDisplay_ToneChunk(vtToneMapping toneMapping)
{
    static const vtChunk* const chunks[vt_toneMappingCount] = {
        [vt_toneMappingNeutral] = &vtChunk_tone_neutral,
        [vt_toneMappingAces] = &vtChunk_tone_aces,
        [vt_toneMappingAgx] = &vtChunk_tone_agx,
    };
    return chunks[toneMapping];
}

const vtProgram* vtDisplay_Start(vtDisplay display, const char* name, const vtChunk* last, const vtGL* gl,
                                 vtProgramList* programs)
{
    vtProgramDef def = {.name = name, .vertex = {&vtChunk_screen_vert}, .uniforms = {"u_behind"}};
    const vtChunk* const chunks[] = {
        display.toFloats ? &vtChunk_to_floats : NULL,
        &vtChunk_octahedral,
        &vtChunk_srgb,
        vtDisplay_ToneChunk(display.toneMapping),
        display.hasBackground ? &vtChunk_environment : NULL,
        display.hasBackground ? &vtChunk_background : NULL,
        &vtChunk_display,
        last,
    };
    vtProgramDef_SetFragment(&def, chunks, sizeof chunks / sizeof chunks[0]);
    return vtProgramList_Start(programs, gl, &def);
}

void vtDisplay_Bind(vtDisplay display, const vtProgram* program, const vtBehind* behind, const vtGL* gl)
{
    if (display.hasBackground) {
        gl->Uniform4fv(program->uniforms[0], 1, behind->color);
        const vtBinding binding = {vt_samplerBackground, behind->texture};
        vtBindTextures(gl, &binding, 1);
    }
}
