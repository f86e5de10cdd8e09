// Scenes of shapes and lights, for tests of light.
#pragma once

#include "base/memory.h"
#include "rendering.h"

static inline vtMaterial mattOf(vtVec3 color)
{
    vtMaterial material = vtDefaultMaterial();
    material.opaque = true;
    material.baseColor = color;
    return material;
}

/// A shape in the scene, scaled and then moved.
static inline void addShape(vtScene* scene, const char* shape, const vtMaterial* material, vtVec3 scale,
                            vtVec3 at)
{
    const vtTransform toWorld = {{{scale.x, 0, 0, at.x}, {0, scale.y, 0, at.y}, {0, 0, scale.z, at.z}}};
    vtMesh mesh;
    vtScene one;
    vtError error;
    assert_ok(vtCreateShape(shape, &mesh, &error), error);
    assert_ok(vtCreateMeshScene(&mesh, material, &one, &error), error);
    assert_ok(vtScene_Append(scene, &one, &toWorld, &error), error);
}

/// A box of those half sides; the shape's are 0.6.
static inline void addBox(vtScene* scene, const vtMaterial* material, vtVec3 half, vtVec3 at)
{
    addShape(scene, "cube", material, vtScale(half, 1.0f / 0.6f), at);
}

static inline void addLight(vtScene* scene, vtLight light)
{
    scene->lights = vtReallocate(scene->lights, scene->lightCount + 1, sizeof *scene->lights);
    assert_non_null(scene->lights);
    scene->lights[scene->lightCount++] = light;
}

/// No light from anywhere, but for one bright texel where `sun` is above 0.
static inline void setNight(vtRenderer* renderer, float sun, vtEnvironment* night)
{
    enum { wide = 128 };
    static float pixels[3 * wide * wide / 2];
    vtError error;
    for (int i = 0; i < 3 * wide * wide / 2; ++i) {
        pixels[i] = 0.0f;
    }
    for (int k = 0; k < 3; ++k) {
        pixels[3 * (wide / 8 * wide + wide / 4) + k] = sun; // half way up
    }
    *night =
        (vtEnvironment){.kind = vt_environmentImage, .width = wide, .height = wide / 2, .pixels = pixels};
    assert_ok(vtRenderer_SetEnvironment(renderer, night, &error), error);
}
