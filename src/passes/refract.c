#include "passes/refract.h"

#include <string.h>

#include "base/error.h"
#include "shaders.h"

// What no path has gone through.
static const GLuint background[4] = {0, 0, 0, VT_PATH_BACKGROUND}, nothing[4] = {0};

/// A program with a chunk more behind octahedral.glsl and path.glsl.
static vtResult createWith(const vtGL* gl, const vtProgramDef* base, const vtChunk* chunk, GLuint* program,
                           vtError* error)
{
    vtProgramDef def = *base;
    memmove(def.fragment + 3, def.fragment + 2, (VT_MAX_CHUNKS - 3) * sizeof *def.fragment);
    def.fragment[2] = chunk;
    return vtCreateProgram(gl, &def, program, error);
}

vtResult vtRefractPass_Prepare(vtRefractPass* pass, const vtGL* gl, vtTechnique technique, vtVariant variant,
                               bool countReads, bool branches, vtError* error)
{
    const vtProgramDef* def = &vtTechnique_Row(technique)->refract[variant];
    GLuint* program = &pass->programs[technique][variant];
    GLuint* counter = &pass->counters[technique][variant];
    GLuint* branch = &pass->branchPrograms[technique][variant];
    vtResult result = vtSucceed(error);
    if (countReads && *counter == 0) {
        result = createWith(gl, def, &vtChunk_count_reads, counter, error);
    }
    if (result == vt_ok && branches && *branch == 0) {
        result = createWith(gl, def, &vtChunk_start_branch, branch, error);
    }
    if (result == vt_ok && *program == 0) {
        result = vtCreateProgram(gl, def, program, error);
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
                        const vtRefractInputs* inputs, int set, const vtPathTargets* before)
{
    const bool onlyGlass = vtTechnique_Row(technique)->surface;
    const vtPathTargets* targets = &pass->targets[set];
    vtBindFramebuffer(gl, (onlyGlass ? pass->glassFramebuffers : pass->framebuffers)[set],
                      targets->paths.width, targets->paths.height);
    gl->UseProgram(before != NULL       ? pass->branchPrograms[technique][variant]
                   : inputs->countReads ? pass->counters[technique][variant]
                                        : pass->programs[technique][variant]);
    bindInputs(gl, inputs);
    if (vtTechnique_Row(technique)->heights) { // VT_HEIGHTS_SAMPLERS in technique.c
        vtTexture_Bind(&inputs->heights->heights, gl, 13);
        vtTexture_Bind(&inputs->heights->ranges, gl, 14);
    }
    if (before != NULL) {
        vtTexture_Bind(&before->lights, gl, 11);
        vtTexture_Bind(&before->asides, gl, 12);
    }
    if (!onlyGlass) {
        gl->DrawArrays(GL_TRIANGLES, 0, 3);
        return;
    }
    // The triangle lies farther than every surface and as far as no surface: the depth test, before the
    // shader, leaves out the background.
    gl->ClearBufferuiv(GL_COLOR, 0, background);
    gl->ClearBufferuiv(GL_COLOR, 2,
                       nothing); // pixels without a path have no light aside for branches to follow
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

void vtRefractPass_DrawOrdered(const vtRefractPass* pass, const vtGL* gl, vtTechnique technique,
                               vtVariant variant, const vtRefractInputs* inputs, uint32_t object,
                               uint32_t left)
{
    const vtPathTargets* before = &pass->targets[1 - left % 2];
    const GLuint program = (inputs->countReads ? pass->counters : pass->programs)[technique][variant];
    vtBindFramebuffer(gl, pass->framebuffers[left % 2], before->paths.width, before->paths.height);
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

void vtRefractPass_Destroy(vtRefractPass* pass, const vtGL* gl)
{
    for (int i = 0; i < vt_techniqueCount; ++i) {
        for (int variant = 0; variant < vt_variantCount; ++variant) {
            gl->DeleteProgram(pass->programs[i][variant]);
            gl->DeleteProgram(pass->counters[i][variant]);
            gl->DeleteProgram(pass->branchPrograms[i][variant]);
        }
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
