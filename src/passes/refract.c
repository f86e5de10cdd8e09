#include "passes/refract.h"

#include <string.h>

#include "base/error.h"
#include "shaders.h"

// What no path has gone through.
static const GLuint background[4] = {0, 0, 0, VT_PATH_BACKGROUND};

#ifdef VT_WITH_BVH
static vtResult prepareCounter(vtRefractPass* pass, const vtGL* gl, vtTechnique technique, vtVariant variant,
                               vtError* error)
{
    vtProgramDef def = vtTechnique_Row(technique)->refract[variant];
    memmove(def.fragment + 3, def.fragment + 2, (VT_MAX_CHUNKS - 3) * sizeof *def.fragment);
    def.fragment[2] = &vtChunk_count_reads; // behind octahedral.glsl and path.glsl
    return vtCreateProgram(gl, &def, &pass->counters[technique][variant], error);
}
#endif

vtResult vtRefractPass_Prepare(vtRefractPass* pass, const vtGL* gl, vtTechnique technique, vtVariant variant,
                               bool countReads, vtError* error)
{
#ifdef VT_WITH_BVH
    if (countReads && pass->counters[technique][variant] == 0) {
        vtResult result = prepareCounter(pass, gl, technique, variant, error);
        if (result != vt_ok) {
            return result;
        }
    }
#else
    (void)countReads;
#endif
    if (pass->programs[technique][variant] != 0) {
        return vtSucceed(error);
    }
    return vtCreateProgram(gl, &vtTechnique_Row(technique)->refract[variant],
                           &pass->programs[technique][variant], error);
}

/// True where they were made anew.
static bool resizeTargets(vtPathTargets* t, const vtGL* gl, int width, int height)
{
    bool changed = vtTexture_Resize(&t->paths, gl, GL_RGBA32UI, width, height, 0);
    changed |= vtTexture_Resize(&t->ends, gl, GL_RGBA32UI, width, height, 0);
    changed |= vtTexture_Resize(&t->lights, gl, GL_RGBA32UI, width, height, 0);
    changed |= vtTexture_Resize(&t->asides, gl, GL_RGBA32UI, width, height, 0);
    return changed;
}

static vtResult makeFramebuffer(const vtPathTargets* t, const vtGL* gl, const char* name,
                                const vtTexture* depth, GLuint* framebuffer, vtError* error)
{
    vtAttachment colors[] = {{&t->paths, 0}, {&t->ends, 0}, {&t->lights, 0}, {&t->asides, 0}};
    return vtMakeFramebuffer(gl, name, colors, 4, depth, framebuffer, error);
}

vtResult vtRefractPass_Resize(vtRefractPass* pass, const vtGL* gl, int width, int height,
                              const vtTexture* surfaceDepth, vtVariant variant, vtError* error)
{
    vtResult result = vtSucceed(error);
    if (resizeTargets(&pass->targets, gl, width, height)) {
        vtDestroyFramebuffers(gl, &pass->glassFramebuffer, 1);
        result = makeFramebuffer(&pass->targets, gl, "refract", NULL, &pass->framebuffer, error);
    }
    if (result == vt_ok && surfaceDepth != NULL && pass->glassFramebuffer == 0) {
        result = makeFramebuffer(&pass->targets, gl, "refract glass", surfaceDepth, &pass->glassFramebuffer,
                                 error);
    }
    if (result == vt_ok && variant == vt_variantOrdered &&
        resizeTargets(&pass->otherTargets, gl, width, height)) {
        result =
            makeFramebuffer(&pass->otherTargets, gl, "refract ordered", NULL, &pass->otherFramebuffer, error);
    }
    return result;
}

static void bindInputs(const vtGL* gl, const vtRefractInputs* inputs)
{
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
}

void vtRefractPass_Draw(const vtRefractPass* pass, const vtGL* gl, vtTechnique technique, vtVariant variant,
                        const vtRefractInputs* inputs)
{
    const bool onlyGlass = vtTechnique_Row(technique)->surface;
    vtBindFramebuffer(gl, onlyGlass ? pass->glassFramebuffer : pass->framebuffer, pass->targets.paths.width,
                      pass->targets.paths.height);
    gl->UseProgram((inputs->countReads ? pass->counters : pass->programs)[technique][variant]);
    bindInputs(gl, inputs);
    if (!onlyGlass) {
        gl->DrawArrays(GL_TRIANGLES, 0, 3);
        return;
    }
    // The triangle lies farther than every surface and as far as no surface: the depth test, before the
    // shader, leaves out the background.
    gl->ClearBufferuiv(GL_COLOR, 0, background);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthFunc(GL_GREATER);
    gl->DepthMask(GL_FALSE);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->DepthMask(GL_TRUE);
    gl->DepthFunc(GL_LESS);
    gl->Disable(GL_DEPTH_TEST);
}

void vtRefractPass_ClearOrdered(const vtRefractPass* pass, const vtGL* gl, uint32_t count)
{
    vtBindFramebuffer(gl, count % 2 == 0 ? pass->framebuffer : pass->otherFramebuffer,
                      pass->targets.paths.width, pass->targets.paths.height);
    gl->ClearBufferuiv(GL_COLOR, 0, background);
}

void vtRefractPass_DrawOrdered(const vtRefractPass* pass, const vtGL* gl, vtTechnique technique,
                               const vtRefractInputs* inputs, uint32_t object, uint32_t left)
{
    const bool isOther = left % 2 != 0;
    const vtPathTargets* before = isOther ? &pass->targets : &pass->otherTargets;
    const GLuint program =
        (inputs->countReads ? pass->counters : pass->programs)[technique][vt_variantOrdered];
    vtBindFramebuffer(gl, isOther ? pass->otherFramebuffer : pass->framebuffer, pass->targets.paths.width,
                      pass->targets.paths.height);
    gl->ClearBufferuiv(GL_COLOR, 0, background);
    gl->UseProgram(program);
    gl->Uniform1i(gl->GetUniformLocation(program, "u_object"), (GLint)object);
    bindInputs(gl, inputs);
    vtTexture_Bind(&before->paths, gl, 11); // VT_ORDERED_SAMPLERS in technique.c
    vtTexture_Bind(&before->ends, gl, 12);
    vtTexture_Bind(&before->lights, gl, 13);
    vtTexture_Bind(&before->asides, gl, 14);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

static void destroyTargets(vtPathTargets* t, const vtGL* gl)
{
    vtTexture_Destroy(&t->paths, gl);
    vtTexture_Destroy(&t->ends, gl);
    vtTexture_Destroy(&t->lights, gl);
    vtTexture_Destroy(&t->asides, gl);
}

void vtRefractPass_Destroy(vtRefractPass* pass, const vtGL* gl)
{
    for (int i = 0; i < vt_techniqueCount * vt_variantCount; ++i) {
        gl->DeleteProgram(pass->programs[i / vt_variantCount][i % vt_variantCount]);
        gl->DeleteProgram(pass->counters[i / vt_variantCount][i % vt_variantCount]);
    }
    vtDestroyFramebuffers(gl, &pass->framebuffer, 1);
    vtDestroyFramebuffers(gl, &pass->glassFramebuffer, 1);
    vtDestroyFramebuffers(gl, &pass->otherFramebuffer, 1);
    destroyTargets(&pass->targets, gl);
    destroyTargets(&pass->otherTargets, gl);
    *pass = (vtRefractPass){0};
}

size_t vtRefractPass_Bytes(const vtRefractPass* pass)
{
    return 4 * (vtTexture_Bytes(&pass->targets.paths) + vtTexture_Bytes(&pass->otherTargets.paths));
}
