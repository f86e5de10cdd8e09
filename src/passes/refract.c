#include "passes/refract.h"

#include <string.h>

#include "base/error.h"
#include "shaders.h"

#ifdef VT_WITH_BVH
static vtResult prepareCounter(vtRefractPass* pass, const vtGL* gl, vtTechnique technique, vtError* error)
{
    vtProgramDef def = vtTechnique_Row(technique)->refract;
    memmove(def.fragment + 2, def.fragment + 1, (VT_MAX_CHUNKS - 2) * sizeof *def.fragment);
    def.fragment[1] = &vtChunk_count_reads; // behind path.glsl
    return vtCreateProgram(gl, &def, &pass->counters[technique], error);
}
#endif

vtResult vtRefractPass_Prepare(vtRefractPass* pass, const vtGL* gl, vtTechnique technique, bool countReads,
                               vtError* error)
{
#ifdef VT_WITH_BVH
    if (countReads && pass->counters[technique] == 0) {
        vtResult result = prepareCounter(pass, gl, technique, error);
        if (result != vt_ok) {
            return result;
        }
    }
#else
    (void)countReads;
#endif
    if (pass->programs[technique] != 0) {
        return vtSucceed(error);
    }
    return vtCreateProgram(gl, &vtTechnique_Row(technique)->refract, &pass->programs[technique], error);
}

vtResult vtRefractPass_Resize(vtRefractPass* pass, const vtGL* gl, int width, int height,
                              const vtTexture* surfaceDepth, vtError* error)
{
    vtPathTargets* t = &pass->targets;
    bool changed = vtTexture_Resize(&t->paths, gl, GL_RGBA32UI, width, height, 0);
    changed |= vtTexture_Resize(&t->ends, gl, GL_RGBA32UI, width, height, 0);
    changed |= vtTexture_Resize(&t->lights, gl, GL_RGBA32UI, width, height, 0);
    changed |= vtTexture_Resize(&t->asides, gl, GL_RGBA32UI, width, height, 0);
    vtAttachment colors[] = {{&t->paths, 0}, {&t->ends, 0}, {&t->lights, 0}, {&t->asides, 0}};
    vtResult result = vtSucceed(error);
    if (changed) {
        vtDestroyFramebuffers(gl, &pass->glassFramebuffer, 1);
        result = vtMakeFramebuffer(gl, "refract", colors, 4, NULL, &pass->framebuffer, error);
    }
    if (result == vt_ok && surfaceDepth != NULL && pass->glassFramebuffer == 0) {
        result =
            vtMakeFramebuffer(gl, "refract glass", colors, 4, surfaceDepth, &pass->glassFramebuffer, error);
    }
    return result;
}

void vtRefractPass_Draw(const vtRefractPass* pass, const vtGL* gl, vtTechnique technique,
                        const vtRefractInputs* inputs)
{
    const bool onlyGlass = vtTechnique_Row(technique)->surface;
    vtBindFramebuffer(gl, onlyGlass ? pass->glassFramebuffer : pass->framebuffer, pass->targets.paths.width,
                      pass->targets.paths.height);
    gl->UseProgram((inputs->countReads ? pass->counters : pass->programs)[technique]);
    // Units as VT_REFRACT_SAMPLERS in technique.c names them.
    const vtTexture* units[] = {inputs->surface,       inputs->innerDistances, inputs->layerDepths,
                                inputs->layerNormals,  inputs->mergedDepths,   inputs->cubeSurfaces,
                                inputs->cubeTriangles, inputs->intervals,      inputs->triangles,
                                inputs->cubeColumns,   inputs->objects};
    for (int unit = 0; unit < (int)(sizeof units / sizeof units[0]); ++unit) {
        if (units[unit]->name != 0) {
            vtTexture_Bind(units[unit], gl, unit);
        }
    }
    if (!onlyGlass) {
        gl->DrawArrays(GL_TRIANGLES, 0, 3);
        return;
    }
    // The triangle lies farther than every surface and as far as no surface: the depth test, before the
    // shader, leaves out the background.
    const GLuint background[4] = {0, 0, 0, VT_PATH_BACKGROUND};
    gl->ClearBufferuiv(GL_COLOR, 0, background);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthFunc(GL_GREATER);
    gl->DepthMask(GL_FALSE);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->DepthMask(GL_TRUE);
    gl->DepthFunc(GL_LESS);
    gl->Disable(GL_DEPTH_TEST);
}

void vtRefractPass_Destroy(vtRefractPass* pass, const vtGL* gl)
{
    for (int i = 0; i < vt_techniqueCount; ++i) {
        gl->DeleteProgram(pass->programs[i]);
        gl->DeleteProgram(pass->counters[i]);
    }
    vtDestroyFramebuffers(gl, &pass->framebuffer, 1);
    vtDestroyFramebuffers(gl, &pass->glassFramebuffer, 1);
    vtTexture_Destroy(&pass->targets.paths, gl);
    vtTexture_Destroy(&pass->targets.ends, gl);
    vtTexture_Destroy(&pass->targets.lights, gl);
    vtTexture_Destroy(&pass->targets.asides, gl);
    *pass = (vtRefractPass){0};
}

size_t vtRefractPass_Bytes(const vtRefractPass* pass)
{
    return 4 * vtTexture_Bytes(&pass->targets.paths);
}
