// This work is based on:
//   Dani Lischinski, Ari Rappoport. Image-Based Rendering for Non-Diffuse Synthetic Scenes. EGWR 1998: the
//   layered depth cube, layers along three axes;
//   Cass Everitt. Interactive Order-Independent Transparency. NVIDIA, 2001: how they are peeled;
//   the pyramids of Tevs 2008 and Hofmann 2017 (shaders_es3/search_exact.glsl).
// Departures: a surface is its depth, the side it shows and the number of its triangle; the cube is turned so
// that it sees little of the mesh edge-on (scene/cube.c); its pyramid holds intervals
// (shaders_es3/intervals.*).
#include "passes/cube.h"

#include "base/error.h"
#include "shaders.h"

static const vtProgramDef peelDef = {
    .name = "peel cube",
    .vertex = {&vtChunk_triangles, &vtChunk_cube, &vtChunk_peel_cube_vert},
    .fragment = {&vtChunk_peel_cube_frag},
    .samplers = {"u_triangles", "u_previousDepth"},
};

static const vtProgramDef firstDef = {
    .name = "intervals of columns",
    .vertex = {&vtChunk_screen_vert},
    .fragment = {&vtChunk_first_level, &vtChunk_intervals, &vtChunk_intervals_frag},
    .samplers = {"u_cubeSurfaces"},
};

static const vtProgramDef levelDef = {
    .name = "intervals",
    .vertex = {&vtChunk_screen_vert},
    .fragment = {&vtChunk_cube, &vtChunk_intervals, &vtChunk_intervals_frag},
    .samplers = {"u_intervals"},
};

vtResult vtCubePass_Create(vtCubePass* pass, const vtGL* gl, vtError* error)
{
    *pass = (vtCubePass){0};
    vtResult result = vtCreateProgram(gl, &peelDef, &pass->peelProgram, error);
    if (result == vt_ok) {
        result = vtCreateProgram(gl, &firstDef, &pass->firstProgram, error);
    }
    if (result == vt_ok) {
        result = vtCreateProgram(gl, &levelDef, &pass->levelProgram, error);
    }
    if (result == vt_ok) {
        pass->peelAxis = gl->GetUniformLocation(pass->peelProgram, "u_axis");
        pass->peelLayers = gl->GetUniformLocation(pass->peelProgram, "u_layers");
        pass->peelFrom = gl->GetUniformLocation(pass->peelProgram, "u_from");
        pass->peelFirstTriangle = gl->GetUniformLocation(pass->peelProgram, "u_firstTriangle");
        pass->firstSide = gl->GetUniformLocation(pass->firstProgram, "u_side");
        pass->firstOpaque = gl->GetUniformLocation(pass->firstProgram, "u_opaque");
        pass->levelSide = gl->GetUniformLocation(pass->levelProgram, "u_side");
        pass->levelBelow = gl->GetUniformLocation(pass->levelProgram, "u_level");
    }
    return result;
}

vtResult vtCubePass_Resize(vtCubePass* pass, const vtGL* gl, int size, int layers, int sides, int slots,
                           bool* changed, vtError* error)
{
    const int groups = (layers + 3) / 4, slices = slots * sides;
    GLint most = 0;
    gl->GetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most);
    *changed = false;
    if (slices * (groups > 3 ? groups : 3) > most) {
        return vtFail(
            error, vt_errorContext,
            "scene: %d different meshes are more than this GPU has room for (%d); join some of them", slots,
            most / (sides * (groups > 3 ? groups : 3)));
    }
    *changed = pass->layers != layers || pass->sides != sides;
    pass->layers = layers;
    pass->sides = sides;
    *changed |= vtTexture_Resize(&pass->surfaces, gl, GL_RGBA16UI, size, size, slices * groups);
    *changed |= vtTexture_Resize(&pass->triangles, gl, GL_RGBA32UI, size, size, slices * groups);
    // Half as high again: the levels above the first stand side by side on top of it.
    *changed |= vtTexture_Resize(&pass->intervals, gl, GL_RGBA16UI, size, size + size / 2, 3 * slices);
    for (int i = 0; i < 2; ++i) {
        *changed |= vtTexture_Resize(&pass->depthBuffers[i], gl, GL_DEPTH_COMPONENT32F, size, size, 0);
    }
    for (int i = 0; i < 4; ++i) {
        *changed |= vtTexture_Resize(&pass->scratch[i], gl, i < 3 ? GL_RGBA16UI : GL_R16UI, size, size, 0);
    }
    *changed |= vtTexture_Resize(&pass->columns, gl, GL_R16UI, size, size, slices);
    if (!*changed) {
        return vtSucceed(error);
    }
    vtAttachment scratch[] = {
        {&pass->scratch[0], 0}, {&pass->scratch[1], 0}, {&pass->scratch[2], 0}, {&pass->scratch[3], 0}};
    vtResult result = vtMakeFramebuffer(gl, "cells", scratch, 4, NULL, &pass->firstFramebuffer, error);
    if (result == vt_ok) {
        result = vtMakeFramebuffer(gl, "intervals", scratch, 2, NULL, &pass->levelFramebuffer, error);
    }
    if (result == vt_ok) {
        result = vtMakeFramebuffer(gl, "cube start", NULL, 0, &pass->depthBuffers[1], &pass->startFramebuffer,
                                   error);
    }
    for (int i = 0; i < 2 && result == vt_ok; ++i) {
        vtAttachment colors[] = {{&pass->surfaces, 0}, {&pass->triangles, 0}};
        result = vtMakeFramebuffer(gl, "cube", colors, 2, &pass->depthBuffers[i], &pass->peelFramebuffers[i],
                                   error);
    }
    return result;
}

static void peelSide(const vtCubePass* pass, const vtGL* gl, const vtCubeSlot* what, int slot, int axis)
{
    const float near = 0.0f, far = 1.0f;
    const GLuint none[4] = {VT_CUBE_NONE, VT_CUBE_NONE, VT_CUBE_NONE, VT_CUBE_NONE};
    const int size = pass->surfaces.width, groups = (pass->layers + 3) / 4;
    const float along[4] = {what->layers[axis][0], what->layers[axis][1], what->layers[axis][2], 0.0f};
    gl->Uniform1i(pass->peelAxis, axis);
    gl->Uniform4fv(pass->peelFrom, 1, what->eye[3] != 0.0f ? what->eye : along);
    vtBindFramebuffer(gl, pass->startFramebuffer, size, size);
    gl->ClearBufferfv(GL_DEPTH, 0, &near);
    for (int layer = 0; layer < pass->layers; ++layer) {
        const int channel = layer % 4, slice = (slot * pass->sides + axis) * groups + layer / 4;
        vtBindFramebuffer(gl, pass->peelFramebuffers[layer % 2], size, size);
        gl->FramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, pass->surfaces.name, 0, slice);
        gl->FramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, pass->triangles.name, 0, slice);
        if (channel == 0) {
            gl->ClearBufferuiv(GL_COLOR, 0, none);
            gl->ClearBufferuiv(GL_COLOR, 1, none);
        }
        gl->ClearBufferfv(GL_DEPTH, 0, &far);
        gl->ColorMask(channel == 0, channel == 1, channel == 2, channel == 3);
        vtTexture_Bind(&pass->depthBuffers[(layer + 1) % 2], gl, 1);
        gl->DrawArrays(GL_TRIANGLES, 0, what->mesh->indexCount);
        gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }
}

/// Copies what was drawn into the scratch textures to its place in the pyramid: WebGL draws into no texture
/// that is read.
static void keepLevel(const vtCubePass* pass, const vtGL* gl, int side, int level)
{
    const int size = pass->surfaces.width;
    const int x = level == 0 ? 0 : size - (size >> (level - 1)), y = level == 0 ? 0 : size;
    vtTexture_Bind(&pass->intervals, gl, 0);
    for (int i = 0; i < (level == 0 ? 3 : 2); ++i) {
        gl->ReadBuffer(GL_COLOR_ATTACHMENT0 + (GLenum)i);
        gl->CopyTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, x, y, 3 * side + i, 0, 0, size >> level, size >> level);
    }
    gl->ReadBuffer(GL_COLOR_ATTACHMENT0);
}

void vtCubePass_Draw(const vtCubePass* pass, const vtGL* gl, const vtTexture* triangles, int slot,
                     const vtCubeSlot* what)
{
    const int size = pass->surfaces.width, firstSide = slot * pass->sides, lastSide = firstSide + pass->sides;
    gl->Enable(GL_DEPTH_TEST);
    gl->UseProgram(pass->peelProgram);
    gl->Uniform4fv(pass->peelLayers, 4, &what->layers[0][0]);
    gl->Uniform1i(pass->peelFirstTriangle, (GLint)what->mesh->firstTriangle);
    vtTexture_Bind(triangles, gl, 0);
    for (int axis = 0; axis < pass->sides; ++axis) {
        peelSide(pass, gl, what, slot, axis);
    }
    gl->Disable(GL_DEPTH_TEST);
    gl->UseProgram(pass->firstProgram);
    gl->Uniform1i(pass->firstOpaque, what->opaque);
    for (int side = firstSide; side < lastSide; ++side) {
        vtTexture_Bind(&pass->surfaces, gl, 0);
        vtBindFramebuffer(gl, pass->firstFramebuffer, size, size);
        gl->Uniform1i(pass->firstSide, side);
        gl->DrawArrays(GL_TRIANGLES, 0, 3);
        keepLevel(pass, gl, side, 0);
        vtTexture_Bind(&pass->columns, gl, 0);
        gl->ReadBuffer(GL_COLOR_ATTACHMENT3);
        gl->CopyTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, side, 0, 0, size, size);
        gl->ReadBuffer(GL_COLOR_ATTACHMENT0);
    }
    gl->UseProgram(pass->levelProgram);
    vtTexture_Bind(&pass->intervals, gl, 0);
    for (int level = 1; size >> level > 0; ++level) {
        vtBindFramebuffer(gl, pass->levelFramebuffer, size >> level, size >> level);
        gl->Uniform1i(pass->levelBelow, level - 1);
        for (int side = firstSide; side < lastSide; ++side) {
            gl->Uniform1i(pass->levelSide, side);
            gl->DrawArrays(GL_TRIANGLES, 0, 3);
            keepLevel(pass, gl, side, level);
        }
    }
}

void vtCubePass_Destroy(vtCubePass* pass, const vtGL* gl)
{
    vtDestroyFramebuffers(gl, &pass->startFramebuffer, 1);
    vtDestroyFramebuffers(gl, &pass->firstFramebuffer, 1);
    vtDestroyFramebuffers(gl, &pass->levelFramebuffer, 1);
    vtDestroyFramebuffers(gl, pass->peelFramebuffers, 2);
    vtTexture_Destroy(&pass->surfaces, gl);
    vtTexture_Destroy(&pass->triangles, gl);
    vtTexture_Destroy(&pass->intervals, gl);
    vtTexture_Destroy(&pass->columns, gl);
    for (int i = 0; i < 2; ++i) {
        vtTexture_Destroy(&pass->depthBuffers[i], gl);
    }
    for (int i = 0; i < 4; ++i) {
        vtTexture_Destroy(&pass->scratch[i], gl);
    }
    gl->DeleteProgram(pass->peelProgram);
    gl->DeleteProgram(pass->firstProgram);
    gl->DeleteProgram(pass->levelProgram);
    *pass = (vtCubePass){0};
}

size_t vtCubePass_Bytes(const vtCubePass* pass)
{
    return vtTexture_Bytes(&pass->surfaces) + vtTexture_Bytes(&pass->triangles) +
           vtTexture_Bytes(&pass->intervals) + vtTexture_Bytes(&pass->depthBuffers[0]) +
           vtTexture_Bytes(&pass->depthBuffers[1]) + vtTexture_Bytes(&pass->scratch[0]) +
           vtTexture_Bytes(&pass->scratch[1]) + vtTexture_Bytes(&pass->scratch[2]) +
           vtTexture_Bytes(&pass->scratch[3]) + vtTexture_Bytes(&pass->columns);
}

size_t vtCubeBytes(int size, int layers, int sides)
{
    const size_t side = (size_t)size * (size_t)size, groups = (size_t)(layers + 3) / 4;
    const size_t perSide = groups * (8 + 16) + 3 * 12 + 2; // surfaces, triangles, intervals, columns
    return side * ((size_t)sides * perSide + 2 * 4 + 3 * 8 + 2);
}
