// Scenes on the GPU whose shading is compared with that of its twins in C, point by point.
#pragma once

#include <math.h>

#include "base/math.h"
#include "base/optics.h"
#include "cases.h"
#include "context/context.h"
#include "gl/image_array.h"
#include "gl/lighting_texture.h"
#include "gl/program.h"
#include "gl/scene_buffer.h"
#include "gl/uniforms.h"
#include "light/lighting.h"
#include "mesh/hierarchy.h"
#include "mesh/mesh_triangle.h"
#include "render/object_table.h"
#include "shaders.h"
#include "shaders_es3/common/constants.h"
#include "testing.h"

enum { caseSide = 64 };

/// Of the channel that differs most.
static inline float difference(vtVec3 a, vtVec3 b)
{
    return fmaxf(fabsf(a.x - b.x), fmaxf(fabsf(a.y - b.y), fabsf(a.z - b.z)));
}

static inline vtEnvironment imageEnvironment(int width, int height, bool isSmooth)
{
    vtEnvironment environment;
    vtError error;
    uint8_t* pixels = malloc(4 * (size_t)width * (size_t)height);
    for (int i = 0; i < width * height; ++i) {
        const int x = i % width, y = i / width;
        for (int k = 0; k < 4; ++k) {
            const float wave = 0.5f + 0.4f * sinf(6.2831853f * (float)((k + 1) * x) / (float)width +
                                                  3.0f * (float)y / (float)height);
            pixels[4 * i + k] = isSmooth ? (uint8_t)(255.0f * wave) : 255;
        }
    }
    assert_ok(vtCreateImageEnvironment(pixels, width, height, "test", &environment, &error), error);
    free(pixels);
    return environment;
}

static inline vtEnvironment builtIn(const char* name)
{
    vtEnvironment environment;
    vtError error;
    assert_ok(vtCreateEnvironment(name, &environment, &error), error);
    return environment;
}

static inline vtLighting lightingOf(const vtEnvironment* environment)
{
    vtLighting lighting;
    vtError error;
    assert_ok(vtCreateLighting(environment, NULL, &lighting, &error), error);
    return lighting;
}

/// A square in the plane z = 0 that faces +z, texture coordinates as in a picture.
static inline vtScene squareScene(const vtMaterial* material, const float* colors)
{
    static const float positions[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    static const float texcoords[] = {0, 1, 1, 1, 1, 0, 0, 0};
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    const vtMeshDef def = {.positions = positions,
                           .indices = indices,
                           .vertexCount = 4,
                           .indexCount = 6,
                           .texcoords = texcoords,
                           .colors = colors};
    vtMesh mesh;
    vtScene scene;
    vtError error;
    assert_ok(vtCreateMesh(&def, "square", &mesh, &error), error);
    if (mesh.texcoords == NULL) { // where the mesh does not take them over yet
        mesh.texcoords = malloc(sizeof texcoords);
        memcpy(mesh.texcoords, texcoords, sizeof texcoords);
    }
    if (mesh.colors == NULL && colors != NULL) {
        mesh.colors = malloc(12 * sizeof *colors);
        memcpy(mesh.colors, colors, 12 * sizeof *colors);
    }
    assert_ok(vtCreateMeshScene(&mesh, material, &scene, &error), error);
    return scene;
}

static inline vtMaterial opaque(float metallic, float roughness)
{
    vtMaterial material = vtDefaultMaterial();
    material.opaque = true;
    material.metallic = metallic;
    material.roughness = roughness;
    return material;
}

typedef struct Gpu {
    vtContext context;
    vtGL gl;
    vtSceneBuffer scene;
    vtTexture cases, lighting, environment;
    vtMesh leaves[3];    ///< the scene's meshes, whose triangles are those of the records, two a record
    uint32_t records[3]; ///< of each mesh
    GLuint vertexArray, uniforms;
    float exposure; ///< factor
} Gpu;

static inline void createGpu(Gpu* gpu)
{
    vtError error;
    *gpu = (Gpu){.exposure = 1.0f};
    assert_ok(vtCreateContext(vt_backendAuto, &gpu->context, &error), error);
    assert_ok(vtLoadGL(gpu->context.getProcAddress, &gpu->gl, &error), error);
    gpu->gl.GenVertexArrays(1, &gpu->vertexArray);
    gpu->gl.GenBuffers(1, &gpu->uniforms);
}

static inline void destroyGpu(Gpu* gpu)
{
    vtSceneBuffer_Destroy(&gpu->scene, &gpu->gl);
    vtTexture_Destroy(&gpu->cases, &gpu->gl);
    vtTexture_Destroy(&gpu->lighting, &gpu->gl);
    vtTexture_Destroy(&gpu->environment, &gpu->gl);
    for (int m = 0; m < 3; ++m) {
        free(gpu->leaves[m].indices);
    }
    gpu->gl.DeleteVertexArrays(1, &gpu->vertexArray);
    gpu->gl.DeleteBuffers(1, &gpu->uniforms);
    vtDestroyContext(&gpu->context);
}

/// As the renderer does; and what the records hold, for the twin on the CPU.
static inline void uploadScene(Gpu* gpu, const vtScene* scene)
{
    vtError error;
    const vtFrame frame = vtDefaultFrame();
    vtSceneBuffer_Destroy(&gpu->scene, &gpu->gl);
    assert_ok(vtSceneBuffer_Create(&gpu->scene, &gpu->gl, scene, &error), error);
    const vtCamera camera = vtMakeCamera(&frame);
    vtWriteObjectTable(&gpu->scene, &frame, &camera);
    vtSceneBuffer_SetTable(&gpu->scene, &gpu->gl);
    for (int m = 0; m < 3; ++m) {
        vtHierarchy hierarchy;
        vtMesh* leaves = &gpu->leaves[m];
        assert_ok(vtCreateHierarchy(&scene->meshes[m], &hierarchy, &error), error);
        free(leaves->indices);
        *leaves = scene->meshes[m];
        gpu->records[m] = hierarchy.recordCount;
        leaves->indexCount = 6 * hierarchy.recordCount;
        leaves->indices = malloc(leaves->indexCount * sizeof *leaves->indices);
        for (uint32_t i = 0; i < leaves->indexCount; ++i) {
            static const uint32_t corners[6] = {0, 1, 2, 0, 2, 3};
            leaves->indices[i] = hierarchy.corners[i / 6 * 4 + corners[i % 6]];
        }
        vtDestroyHierarchy(&hierarchy);
    }
}

/// One of its triangles that have an area; 2 * record, plus one for the second of a pair.
static inline uint32_t pickTriangle(const Gpu* gpu, uint32_t mesh, uint32_t number)
{
    uint32_t triangle = number % (2 * gpu->records[mesh]);
    const uint32_t* indices = gpu->leaves[mesh].indices;
    while (indices[3 * triangle] == VT_NO_TRIANGLE ||
           indices[3 * triangle + 1] == indices[3 * triangle + 2]) {
        triangle = (triangle + 1) % (2 * gpu->records[mesh]);
    }
    return triangle;
}

/// An object and its triangle for each case.
static inline void uploadCases(Gpu* gpu, const vtPlacedObject* placed, uint32_t (*cases)[4])
{
    for (uint32_t i = 0; i < caseSide * caseSide; ++i) {
        const uint32_t mesh = placed[i % gpu->scene.objectCount].meshIndex;
        cases[i][0] = i % gpu->scene.objectCount;
        cases[i][1] = pickTriangle(gpu, mesh, hash(i + 300000u));
        cases[i][2] = 2 * gpu->scene.geometry.items[mesh].records.first + cases[i][1];
    }
    vtTexture_Resize(&gpu->cases, &gpu->gl, GL_RGBA32UI, caseSide, caseSide, 0);
    vtTexture_Bind(&gpu->cases, &gpu->gl, vt_samplerNone);
    gpu->gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, caseSide, caseSide, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                          cases);
}

/// As src/passes/present.c does.
static inline void uploadEnvironment(Gpu* gpu, const vtEnvironment* environment, const vtLighting* lighting)
{
    const vtGL* gl = &gpu->gl;
    vtError error;
    const bool isImage = environment->kind == vt_environmentImage;
    vtTexture_Destroy(&gpu->environment, gl);
    vtTexture_Resize(&gpu->environment, gl, GL_RGB16F, isImage ? environment->width : 1,
                     isImage ? environment->height : 1, 0);
    if (isImage) {
        gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, environment->width, environment->height, GL_RGB, GL_FLOAT,
                          environment->pixels);
    }
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    assert_ok(vtLightingTexture_Upload(&gpu->lighting, gl, lighting, &error), error);
    const vtFrameUniforms uniforms = {
        .optics = {0.0f, 0.0f, gpu->exposure, 0.0f},
        .scene = {(int32_t)gpu->scene.glassCount, (int32_t)gpu->scene.objectCount, 0, 0},
        .output = {0, 0, (int)environment->kind, 0}};
    gl->BindBufferBase(GL_UNIFORM_BUFFER, VT_FRAME_BINDING, gpu->uniforms);
    gl->BufferData(GL_UNIFORM_BUFFER, sizeof uniforms, &uniforms, GL_STATIC_DRAW);
}

/// Runs the last of the chunks, which fills o_result, over `times` times all cases, one above the other.
static inline void evaluateChunks(Gpu* gpu, const vtChunk* const* chunks, size_t count, int times,
                                  uint32_t* results)
{
    const vtGL* gl = &gpu->gl;
    vtError error;
    const int rows = times * caseSide;
    vtProgramDef def = {.name = "test", .vertex = {&vtChunk_screen_vert}};
    vtProgramDef_SetFragment(&def, chunks, count);
    GLuint framebuffer = 0;
    vtProgram program = {0};
    vtTexture target = {0};
    vtTexture_Resize(&target, gl, GL_RGBA32UI, caseSide, rows, 0);
    const vtAttachment color = {&target, 0};
    vtProgram_Start(&program, gl, &def);
    assert_ok(vtProgram_Finish(&program, gl, &error), error);
    assert_ok(vtMakeFramebuffer(gl, "test", &color, 1, NULL, &framebuffer, &error), error);
    vtBindFramebuffer(gl, framebuffer, caseSide, rows);
    gl->UseProgram(program.name);
    gl->BindVertexArray(gpu->vertexArray);
    const vtBinding bindings[] = {{vt_samplerObjects, &gpu->scene.table},
                                  {vt_samplerRecords, &gpu->scene.geometry.records},
                                  {vt_samplerAttributes, &gpu->scene.geometry.attributes},
                                  {vt_samplerImages, &gpu->scene.images.texture},
                                  {vt_samplerMaterials, &gpu->scene.looks},
                                  {vt_samplerLighting, &gpu->lighting},
                                  {vt_samplerEnvironment, &gpu->environment},
                                  {vt_samplerNone, &gpu->cases}}; // u_cases, which is the test's own
    vtBindTextures(gl, bindings, sizeof bindings / sizeof bindings[0]);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->ReadPixels(0, 0, caseSide, rows, GL_RGBA_INTEGER, GL_UNSIGNED_INT, results);
    assert_ok(vtCheckGL(gl, "evaluating", &error), error);
    vtProgram_Destroy(&program, gl);
    vtDestroyFramebuffers(gl, &framebuffer, 1);
    vtTexture_Destroy(&target, gl);
}
