#include "passes/surface.h"

#include "base/error.h"
#include "shaders.h"

// By whether inner distances are drawn.
static const vtProgramDef glassDefs[2] = {
    {.name = "surface",
     .vertex = {&vtChunk_picture, &vtChunk_mesh_vert},
     .fragment = {&vtChunk_octahedral, &vtChunk_surface_attributes, &vtChunk_surface_frag}},
    {.name = "surface with inner distance",
     .vertex = {&vtChunk_inner_distance, &vtChunk_picture, &vtChunk_mesh_vert},
     .fragment = {&vtChunk_inner_distance, &vtChunk_octahedral, &vtChunk_surface_attributes,
                  &vtChunk_surface_frag}},
};

static const vtProgramDef opaqueDefs[2] = {
    {.name = "opaque surface",
     .vertex = {&vtChunk_triangles, &vtChunk_surface_opaque_vert},
     .fragment = {&vtChunk_surface_opaque_frag},
     .samplers = {"u_triangles"}},
    {.name = "opaque surface without inner distance",
     .vertex = {&vtChunk_triangles, &vtChunk_surface_opaque_vert},
     .fragment = {&vtChunk_inner_distance, &vtChunk_surface_opaque_frag},
     .samplers = {"u_triangles"}},
};

static const vtProgramDef heightsDef = {
    .name = "surface of heights",
    .vertex = {&vtChunk_objects, &vtChunk_surface_heights_vert},
    .fragment = {&vtChunk_octahedral, &vtChunk_objects, &vtChunk_grid_walk, &vtChunk_search_heights,
                 &vtChunk_surface_heights_frag},
    .samplers = {"u_objects", "u_heights", "u_heightRanges"},
};

static vtResult createPrograms(vtSurfacePass* pass, const vtGL* gl, int kind, vtError* error)
{
    vtResult result = vtCreateProgram(gl, &glassDefs[kind], &pass->glassPrograms[kind], error);
    if (result == vt_ok) {
        result = vtCreateProgram(gl, &opaqueDefs[kind], &pass->opaquePrograms[kind], error);
    }
    if (result == vt_ok) {
        pass->glassUniforms[kind] = vtFindObjectUniforms(gl, pass->glassPrograms[kind]);
        pass->opaqueUniforms[kind] = vtFindObjectUniforms(gl, pass->opaquePrograms[kind]);
    }
    return result;
}

vtResult vtSurfacePass_Create(vtSurfacePass* pass, const vtGL* gl, vtError* error)
{
    *pass = (vtSurfacePass){0};
    return createPrograms(pass, gl, 0, error);
}

vtResult vtSurfacePass_Resize(vtSurfacePass* pass, const vtGL* gl, int width, int height, vtSurfaceKind kind,
                              vtError* error)
{
    bool changed = vtTexture_Resize(&pass->depth, gl, GL_DEPTH_COMPONENT32F, width, height, 0);
    changed |= vtTexture_Resize(&pass->attributes, gl, GL_RGBA32UI, width, height, 0);
    vtResult result = vtSucceed(error);
    vtAttachment colors[] = {{&pass->attributes, 0}, {&pass->distances, 0}};
    if (changed) {
        vtDestroyFramebuffers(gl, &pass->framebuffers[1], 1); // it holds the depth that is gone
        result = vtMakeFramebuffer(gl, "surface", colors, 1, &pass->depth, &pass->framebuffers[0], error);
    }
    if (result == vt_ok && kind == vt_surfaceHeights && pass->heightsProgram == 0) {
        result = vtCreateProgram(gl, &heightsDef, &pass->heightsProgram, error);
        pass->heightsUniforms =
            result == vt_ok ? vtFindObjectUniforms(gl, pass->heightsProgram) : pass->heightsUniforms;
    }
    if (result != vt_ok || kind != vt_surfaceDistances) {
        return result;
    }
    if (pass->glassPrograms[1] == 0) {
        result = createPrograms(pass, gl, 1, error);
    }
    changed = vtTexture_Resize(&pass->distances, gl, GL_R16UI, width, height, 0);
    if (result == vt_ok && (changed || pass->framebuffers[1] == 0)) {
        result = vtMakeFramebuffer(gl, "surface with inner distance", colors, 2, &pass->depth,
                                   &pass->framebuffers[1], error);
    }
    return result;
}

void vtSurfacePass_Draw(const vtSurfacePass* pass, const vtGL* gl, const vtSceneBuffer* scene, uint32_t first,
                        uint32_t last, vtSurfaceKind kind, GLuint emptyVertexArray)
{
    const bool distances = kind == vt_surfaceDistances, heights = kind == vt_surfaceHeights;
    const float far = 1.0f;
    const GLuint none[4] = {0};
    vtBindFramebuffer(gl, pass->framebuffers[distances], pass->depth.width, pass->depth.height);
    gl->Enable(GL_DEPTH_TEST);
    gl->ClearBufferfv(GL_DEPTH, 0, &far);
    gl->ClearBufferuiv(GL_COLOR, 0, none);
    if (distances) {
        gl->ClearBufferuiv(GL_COLOR, 1, none);
    }
    gl->UseProgram(pass->glassPrograms[distances]);
    vtSceneBuffer_Draw(scene, gl, &pass->glassUniforms[distances], first, last, heights);
    if (heights) {
        gl->UseProgram(pass->heightsProgram);
        vtTexture_Bind(&scene->table, gl, 0);
        vtTexture_Bind(&scene->heights.heights, gl, 1);
        vtTexture_Bind(&scene->heights.ranges, gl, 2);
        gl->BindVertexArray(emptyVertexArray);
        vtSceneBuffer_DrawHeights(scene, gl, &pass->heightsUniforms, first, last);
    }
    if (scene->objectCount > scene->glassCount) {
        gl->UseProgram(pass->opaquePrograms[distances]);
        vtTexture_Bind(&scene->triangles, gl, 0);
        gl->BindVertexArray(emptyVertexArray);
        vtSceneBuffer_DrawTriangles(scene, gl, &pass->opaqueUniforms[distances], scene->glassCount,
                                    scene->objectCount);
    }
    gl->Disable(GL_DEPTH_TEST);
}

void vtSurfacePass_Destroy(vtSurfacePass* pass, const vtGL* gl)
{
    vtDestroyFramebuffers(gl, pass->framebuffers, 2);
    vtTexture_Destroy(&pass->distances, gl);
    vtTexture_Destroy(&pass->depth, gl);
    vtTexture_Destroy(&pass->attributes, gl);
    gl->DeleteProgram(pass->heightsProgram);
    for (int i = 0; i < 2; ++i) {
        gl->DeleteProgram(pass->glassPrograms[i]);
        gl->DeleteProgram(pass->opaquePrograms[i]);
    }
    *pass = (vtSurfacePass){0};
}

size_t vtSurfacePass_Bytes(const vtSurfacePass* pass)
{
    return vtTexture_Bytes(&pass->depth) + vtTexture_Bytes(&pass->attributes) +
           vtTexture_Bytes(&pass->distances);
}
