// This work is based on:
//   The Khronos Group. glTF 2.0 Specification, appendix B (metallic-roughness). 2021.
//   Brian Karis. Real Shading in Unreal Engine 4. 2013: blurred environment times what a surface reflects.
//   Brian Karis. Physically Based Shading on Mobile. 2014: the latter as a formula (after Lazarov 2013).
// Departures: none. What a rough surface reflects by more than one bounce in it is missing, as there.
#include "light/shading.h"

#include <math.h>

#include "base/math.h"
#include "image/image.h"
#include "mesh/mesh_triangle.h"

static vtVec3 multiply(vtVec3 a, vtVec3 b)
{
    return (vtVec3){a.x * b.x, a.y * b.y, a.z * b.z};
}

// ---------------------------------------------------------------------------------------------- pictures

static int wrap(int i, int count)
{
    return (i % count + count) % count;
}

static vtVec3 texel(const vtImage* image, int column, int row, bool isSrgb)
{
    const size_t index = (size_t)wrap(row, image->height) * (size_t)image->width;
    const uint8_t* p = image->pixels + 4 * (index + (size_t)wrap(column, image->width));
    const vtVec3 c = {(float)p[0] / 255.0f, (float)p[1] / 255.0f, (float)p[2] / 255.0f};
    return isSrgb ? (vtVec3){vtSrgbToLinear(c.x), vtSrgbToLinear(c.y), vtSrgbToLinear(c.z)} : c;
}

/// The scene's image at texture coordinates; white where there is none.
static vtVec3 readImage(const vtScene* scene, int index, const float at[2], bool isSrgb)
{
    if (index < 0 || (uint32_t)index >= scene->imageCount || scene->images[index].pixels == NULL) {
        return (vtVec3){1.0f, 1.0f, 1.0f};
    }
    const vtImage* image = &scene->images[index];
    const float x = vtFract(at[0]) * (float)image->width - 0.5f;
    const float y = vtFract(at[1]) * (float)image->height - 0.5f;
    const int left = (int)floorf(x), top = (int)floorf(y);
    const float across = x - (float)left, down = y - (float)top;
    const vtVec3 above = vtMulAdd(vtScale(texel(image, left, top, isSrgb), 1.0f - across), across,
                                  texel(image, left + 1, top, isSrgb));
    const vtVec3 below = vtMulAdd(vtScale(texel(image, left, top + 1, isSrgb), 1.0f - across), across,
                                  texel(image, left + 1, top + 1, isSrgb));
    return vtMulAdd(vtScale(above, 1.0f - down), down, below);
}

// ----------------------------------------------------------------- twins of shading.glsl, in the same order

/// The interpolated normal on the viewer's side, or the triangle's own where that one faces away.
static vtVec3 normalTowardsEye(const vtPlacedObject* object, uint32_t triangle, float u, float v, vtVec3 I)
{
    vtVec3 p[3], normals[3];
    vtMesh_Corners(object->mesh, triangle, p);
    vtMesh_Normals(object->mesh, triangle, normals);
    const vtTransform* toObject = &object->toObject;
    vtVec3 G = vtNormalize(vtTransformNormal(toObject, vtCross(vtSub(p[1], p[0]), vtSub(p[2], p[0]))));
    vtVec3 N = vtNormalize(vtTransformNormal(toObject, vtBlend(normals, u, v)));
    const float side = vtDot(G, I) > 0.0f ? -1.0f : 1.0f;
    G = vtScale(G, side);
    N = vtScale(N, side);
    return vtDot(N, I) < 0.0f ? N : G;
}

/// The share of light about the mirror direction that is reflected.
static vtVec3 reflectedShare(vtVec3 F0, float roughness, float cosine)
{
    const float x = 1.0f - roughness, y = 0.0425f - 0.0275f * roughness;
    const float z = 1.04f - 0.572f * roughness, w = 0.022f * roughness - 0.04f;
    const float a = fminf(x * x, exp2f(-9.28f * cosine)) * x + y;
    const float scale = z - 1.04f * a, bias = w + 1.04f * a;
    return (vtVec3){fmaxf(F0.x * scale + bias, 0.0f), fmaxf(F0.y * scale + bias, 0.0f),
                    fmaxf(F0.z * scale + bias, 0.0f)};
}

/// Texture coordinates and colour, where the mesh has them.
static void readCorners(const vtMesh* mesh, uint32_t triangle, float u, float v, float at[2], vtVec3* color)
{
    const uint32_t* corners = mesh->indices + 3 * (size_t)triangle;
    for (int k = 0; k < 2 && mesh->texcoords != NULL; ++k) {
        at[k] = (1.0f - u - v) * mesh->texcoords[2 * (size_t)corners[0] + (size_t)k] +
                u * mesh->texcoords[2 * (size_t)corners[1] + (size_t)k] +
                v * mesh->texcoords[2 * (size_t)corners[2] + (size_t)k];
    }
    if (mesh->colors != NULL) {
        vtVec3 colors[3];
        for (size_t i = 0; i < 3; ++i) {
            colors[i] = vtMakeVec3(mesh->colors + 3 * (size_t)corners[i]);
        }
        *color = vtBlend(colors, u, v);
    }
}

vtVec3 vtShadeSurface(const vtScene* scene, const vtPlacedObject* object, const vtLighting* lighting,
                      uint32_t triangle, float u, float v, vtVec3 I)
{
    const vtMesh* mesh = object->mesh;
    const vtMaterial* material = object->material;
    float at[2] = {0.0f, 0.0f};
    vtVec3 color = {1.0f, 1.0f, 1.0f};
    if (mesh->indexCount > 0) { // reliefs have neither
        readCorners(mesh, triangle, u, v, at, &color);
    }
    vtVec3 base = multiply(material->baseColor, readImage(scene, material->baseColorImage, at, true));
    base = multiply(base, color);
    const float squares = floorf(material->checker * at[0]) + floorf(material->checker * at[1]);
    if (2.0f * vtFract(0.5f * squares) > 0.5f) { // odd
        base = vtScale(base, 0.15f);
    }
    const vtVec3 share = readImage(scene, material->metallicRoughnessImage, at, false);
    const float roughness = material->roughness * share.y, metallic = material->metallic * share.z;

    const vtVec3 N = normalTowardsEye(object, triangle, u, v, I);
    const float cosine = -vtDot(N, I);
    const vtVec3 R = vtNormalize(vtMulAdd(I, 2.0f * cosine, N));
    const vtVec3 dielectric = {0.04f, 0.04f, 0.04f};
    const vtVec3 F0 = vtMulAdd(vtScale(dielectric, 1.0f - metallic), metallic, base);
    const vtVec3 diffuse = vtScale(multiply(base, vtLighting_Diffuse(lighting, N)), 1.0f - metallic);
    const vtVec3 specular =
        multiply(vtLighting_Specular(lighting, R, roughness), reflectedShare(F0, roughness, cosine));
    return vtAdd(vtAdd(diffuse, specular), material->emissive);
}
