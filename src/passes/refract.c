#include "passes/refract.h"

#include <string.h>

#include "base/error.h"
#include "shaders.h"

// What no path has gone through.
static const GLuint background[4] = {0, 0, 0, VT_PATH_BACKGROUND};

void vtRefractPass_Start(vtRefractPass* pass, const vtGL* gl, vtTechnique technique, vtVariant variant,
                         bool countReads, vtProgramList* programs)
{
    vtProgramDef def = vtTechnique_Row(technique)->refract[variant];
    if (countReads) { // first of all, so that all that follows is counted
        memmove(def.fragment + 1, def.fragment, (VT_MAX_CHUNKS - 1) * sizeof *def.fragment);
        def.fragment[0] = &vtChunk_count_reads;
    }
    pass->program = vtProgramList_Start(programs, gl, &def);
}

static vtResult resizeSet(vtRefractPass* pass, const vtGL* gl, int set, int width, int height,
                          const vtTexture* surfaceDepth, vtError* error)
{
    vtPathTargets* t = &pass->targets[set];
    bool changed = vtTexture_Resize(&t->paths, gl, GL_RGBA32UI, width, height, 0);
    changed |= vtTexture_Resize(&t->ends, gl, GL_RGBA32UI, width, height, 0);
    changed |= vtTexture_Resize(&t->lights, gl, GL_RGBA32UI, width, height, 0);
    changed |= vtTexture_Resize(&t->asides, gl, GL_RGBA32UI, width, height, 0);
    vtAttachment colors[] = {{&t->paths, 0}, {&t->ends, 0}, {&t->lights, 0}, {&t->asides, 0}};
    vtResult result = vtSucceed(error);
    if (changed) {
        if (set == 0) {
            vtDestroyFramebuffers(gl, &pass->glassFramebuffer, 1); // it holds what is gone
        }
        result = vtMakeFramebuffer(gl, "refract", colors, 4, NULL, &pass->framebuffers[set], error);
    }
    if (result == vt_ok && set == 0 && surfaceDepth != NULL && pass->glassFramebuffer == 0) {
        result =
            vtMakeFramebuffer(gl, "refract glass", colors, 4, surfaceDepth, &pass->glassFramebuffer, error);
    }
    return result;
}

vtResult vtRefractPass_Resize(vtRefractPass* pass, const vtGL* gl, int width, int height, int sets,
                              const vtTexture* surfaceDepth, vtError* error)
{
    vtResult result = vtSucceed(error);
    for (int set = 0; set < sets && result == vt_ok; ++set) {
        result = resizeSet(pass, gl, set, width, height, surfaceDepth, error);
    }
    return result;
}

static void useProgram(const vtRefractPass* pass, const vtGL* gl, const vtRefractInputs* inputs)
{
    const vtSceneBuffer* scene = inputs->scene;
    gl->UseProgram(pass->program->name);
    const vtBinding bindings[] = {
        {vt_samplerSurface, inputs->surface},           {vt_samplerInnerDistances, inputs->innerDistances},
        {vt_samplerLayerDepths, inputs->layerDepths},   {vt_samplerLayerNormals, inputs->layerNormals},
        {vt_samplerMergedDepths, inputs->mergedDepths}, {vt_samplerObjects, &scene->table},
        {vt_samplerRecords, &scene->geometry.records},  {vt_samplerObjectTree, &scene->tree}};
    vtBindTextures(gl, bindings, sizeof bindings / sizeof bindings[0]);
}

void vtRefractPass_Draw(const vtRefractPass* pass, const vtGL* gl, vtTechnique technique,
                        const vtRefractInputs* inputs)
{
    const bool onlyGlass = vtTechnique_Row(technique)->surface;
    const vtTexture* paths = &pass->targets[0].paths;
    vtBindFramebuffer(gl, onlyGlass ? pass->glassFramebuffer : pass->framebuffers[0], paths->width,
                      paths->height);
    useProgram(pass, gl, inputs);
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
    const vtTexture* paths = &pass->targets[0].paths;
    vtBindFramebuffer(gl, pass->framebuffers[count % 2], paths->width, paths->height);
    gl->ClearBufferuiv(GL_COLOR, 0, background);
}

void vtRefractPass_DrawOrdered(const vtRefractPass* pass, const vtGL* gl, const vtRefractInputs* inputs,
                               uint32_t object, uint32_t left)
{
    const vtPathTargets* before = &pass->targets[1 - left % 2];
    vtBindFramebuffer(gl, pass->framebuffers[left % 2], before->paths.width, before->paths.height);
    gl->ClearBufferuiv(GL_COLOR, 0, background);
    useProgram(pass, gl, inputs);
    gl->Uniform1i(pass->program->uniforms[0], (GLint)object);
    vtTexture_Bind(&before->paths, gl, vt_samplerPaths);
    vtTexture_Bind(&before->ends, gl, vt_samplerEnds);
    vtTexture_Bind(&before->lights, gl, vt_samplerLights);
    vtTexture_Bind(&before->asides, gl, vt_samplerAsides);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

void vtRefractPass_Destroy(vtRefractPass* pass, const vtGL* gl)
{
    vtDestroyFramebuffers(gl, pass->framebuffers, VT_PATH_SETS);
    vtDestroyFramebuffers(gl, &pass->glassFramebuffer, 1);
    for (int set = 0; set < VT_PATH_SETS; ++set) {
        vtTexture_Destroy(&pass->targets[set].paths, gl);
        vtTexture_Destroy(&pass->targets[set].ends, gl);
        vtTexture_Destroy(&pass->targets[set].lights, gl);
        vtTexture_Destroy(&pass->targets[set].asides, gl);
    }
    *pass = (vtRefractPass){0};
}

size_t vtRefractPass_Bytes(const vtRefractPass* pass)
{
    size_t bytes = 0;
    for (int set = 0; set < VT_PATH_SETS; ++set) {
        bytes += 4 * vtTexture_Bytes(&pass->targets[set].paths);
    }
    return bytes;
}
