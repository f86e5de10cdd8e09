#include "passes/refract.h"

#include <string.h>

#include "base/error.h"
#include "shaders.h"

/// The technique's program with a chunk more behind path.glsl.
static vtResult createVariant(const vtGL* gl, vtTechnique technique, const vtChunk* chunk, GLuint* program,
                              vtError* error)
{
    vtProgramDef def = vtTechnique_Row(technique)->refract;
    memmove(def.fragment + 3, def.fragment + 2, (VT_MAX_CHUNKS - 3) * sizeof *def.fragment);
    def.fragment[2] = chunk;
    return vtCreateProgram(gl, &def, program, error);
}

vtResult vtRefractPass_Prepare(vtRefractPass* pass, const vtGL* gl, vtTechnique technique, bool countReads,
                               bool branches, vtError* error)
{
    vtResult result = vtSucceed(error);
    if (countReads && pass->counters[technique] == 0) {
        result = createVariant(gl, technique, &vtChunk_count_reads, &pass->counters[technique], error);
    }
    if (result == vt_ok && branches && pass->branchPrograms[technique] == 0) {
        result = createVariant(gl, technique, &vtChunk_start_branch, &pass->branchPrograms[technique], error);
    }
    if (result == vt_ok && pass->programs[technique] == 0) {
        result = vtCreateProgram(gl, &vtTechnique_Row(technique)->refract, &pass->programs[technique], error);
    }
    return result;
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
        vtDestroyFramebuffers(gl, &pass->glassFramebuffers[set], 1);
        result = vtMakeFramebuffer(gl, "refract", colors, 4, NULL, &pass->framebuffers[set], error);
    }
    if (result == vt_ok && surfaceDepth != NULL && pass->glassFramebuffers[set] == 0) {
        result = vtMakeFramebuffer(gl, "refract glass", colors, 4, surfaceDepth,
                                   &pass->glassFramebuffers[set], error);
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

void vtRefractPass_Draw(const vtRefractPass* pass, const vtGL* gl, vtTechnique technique,
                        const vtRefractInputs* inputs, int set, const vtPathTargets* before)
{
    const bool onlyGlass = vtTechnique_Row(technique)->surface;
    const vtPathTargets* targets = &pass->targets[set];
    vtBindFramebuffer(gl, (onlyGlass ? pass->glassFramebuffers : pass->framebuffers)[set],
                      targets->paths.width, targets->paths.height);
    const GLuint* programs = before != NULL       ? pass->branchPrograms
                             : inputs->countReads ? pass->counters
                                                  : pass->programs;
    gl->UseProgram(programs[technique]);
    // Units as VT_REFRACT_SAMPLERS in technique.c names them.
    const vtTexture* units[] = {inputs->surface,
                                inputs->innerDistances,
                                inputs->layerDepths,
                                inputs->layerNormals,
                                inputs->mergedDepths,
                                inputs->cubeSurfaces,
                                inputs->cubeTriangles,
                                inputs->intervals,
                                inputs->triangles,
                                inputs->cubeColumns,
                                inputs->objects,
                                before != NULL ? &before->lights : NULL,
                                before != NULL ? &before->asides : NULL};
    for (int unit = 0; unit < (int)(sizeof units / sizeof units[0]); ++unit) {
        if (units[unit] != NULL && units[unit]->name != 0) {
            vtTexture_Bind(units[unit], gl, unit);
        }
    }
    if (!onlyGlass) {
        gl->DrawArrays(GL_TRIANGLES, 0, 3);
        return;
    }
    // The triangle lies farther than every surface and as far as no surface: the depth test, before the
    // shader, leaves out the background.
    const GLuint background[4] = {0, 0, 0, VT_PATH_BACKGROUND}, none[4] = {0};
    gl->ClearBufferuiv(GL_COLOR, 0, background);
    gl->ClearBufferuiv(GL_COLOR, 2,
                       none); // light aside: pixels without a path have none for branches to follow
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
        gl->DeleteProgram(pass->branchPrograms[i]);
    }
    vtDestroyFramebuffers(gl, pass->framebuffers, VT_PATH_SETS);
    vtDestroyFramebuffers(gl, pass->glassFramebuffers, VT_PATH_SETS);
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
