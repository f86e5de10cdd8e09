// This work is based on:
//   The Khronos Group. glTF 2.0 Specification, appendix B (metallic-roughness). 2021; and its extensions
//   KHR_materials_transmission, _volume, _ior, _specular, _iridescence, _emissive_strength, _unlit,
//   KHR_texture_transform and KHR_lights_punctual;
//   Brian Karis. Real Shading in Unreal Engine 4. 2013: blurred environment times what a surface reflects;
//   Brian Karis. Physically Based Shading on Mobile. 2014: the latter as a formula (after Lazarov 2013);
//   Laurent Belcour, Pascal Barla. A Practical Extension to Microfacet Theory for the Modeling of Varying
//   Iridescence. 2017;
//   Bruce Walter et al. Microfacet Models for Refraction through Rough Surfaces. 2007 (GGX), of lights.
// Departures: what a rough surface reflects by more than one bounce in it is missing. Reflection of smooth
// dielectrics follows Fresnel's equations where their material is not changed by _specular, Schlick's curve
// nowhere. Lights are seen in smooth surfaces as if these had a roughness of 0.0525.
#include "light/look.h"

#include <math.h>

#include "base/math.h"
#include "image/image.h"
#include "mesh/mesh_triangle.h"
#include "shaders_es3/common/constants.h"

static vtVec3 grey(float value)
{
    return (vtVec3){value, value, value};
}

// ---------------------------------------------------------------------------------------------- pictures

typedef struct Color {
    float r, g, b, a;
} Color;

static int goOn(int i, int count, vtWrap wrap)
{
    if (wrap == vt_wrapClamp) {
        return i < 0 ? 0 : i >= count ? count - 1 : i;
    }
    const int period = wrap == vt_wrapMirror ? 2 * count : count, k = (i % period + period) % period;
    return k < count ? k : period - 1 - k;
}

static Color texel(const vtImage* image, const vtMap* map, int column, int row, bool isColor)
{
    const size_t index = (size_t)goOn(row, image->height, map->wrapY) * (size_t)image->width;
    const uint8_t* p = image->pixels + 4 * (index + (size_t)goOn(column, image->width, map->wrapX));
    const Color c = {(float)p[0] / 255.0f, (float)p[1] / 255.0f, (float)p[2] / 255.0f, (float)p[3] / 255.0f};
    return isColor ? (Color){vtSrgbToLinear(c.r), vtSrgbToLinear(c.g), vtSrgbToLinear(c.b), c.a} : c;
}

static Color blend(Color a, Color b, float t)
{
    return (Color){a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b),
                   a.a + t * (b.a - a.a)};
}

/// A place along a side of `count` pixels, in pixels; repeated places are brought near first.
static float placeAt(float at, int count, vtWrap wrap)
{
    const float near = wrap == vt_wrapRepeat   ? vtFract(at)
                       : wrap == vt_wrapMirror ? 2.0f * vtFract(0.5f * at)
                                               : vtClamp(at, -1.0f, 2.0f);
    return near * (float)count;
}

/// The material's picture of that use at texture coordinates of either set; white where it has none.
static Color readMap(const vtScene* scene, const vtMaterial* material, vtMapUse use, const float at[4])
{
    const vtMap* map = &material->maps[use];
    if (map->image < 0 || (uint32_t)map->image >= scene->imageCount ||
        scene->images[map->image].pixels == NULL) {
        return (Color){1.0f, 1.0f, 1.0f, 1.0f};
    }
    const vtImage* image = &scene->images[map->image];
    const bool isColor = vtMapUse_IsColor(use);
    const float* uv = at + (map->texcoords == 1 ? 2 : 0);
    const float* const* rows = (const float* const[]){map->rows[0], map->rows[1]};
    const float x = placeAt(rows[0][0] * uv[0] + rows[0][1] * uv[1] + rows[0][2], image->width, map->wrapX);
    const float y = placeAt(rows[1][0] * uv[0] + rows[1][1] * uv[1] + rows[1][2], image->height, map->wrapY);
    if (map->nearest) {
        return texel(image, map, (int)floorf(x), (int)floorf(y), isColor);
    }
    const int left = (int)floorf(x - 0.5f), top = (int)floorf(y - 0.5f);
    const float across = x - 0.5f - (float)left, down = y - 0.5f - (float)top;
    const Color above =
        blend(texel(image, map, left, top, isColor), texel(image, map, left + 1, top, isColor), across);
    const Color below = blend(texel(image, map, left, top + 1, isColor),
                              texel(image, map, left + 1, top + 1, isColor), across);
    return blend(above, below, down);
}

// ----------------------------------------------------------------------------------------------- corners

/// What the corners say at a point.
typedef struct Corner {
    float at[4];
    Color color;
    vtVec3 tangent; ///< the object's own
    float turned;   ///< -1 where pictures are mirrored on it
} Corner;

static float weigh(const float* numbers, size_t each, size_t k, const uint32_t* corners, float u, float v)
{
    return (1.0f - u - v) * numbers[each * corners[0] + k] + u * numbers[each * corners[1] + k] +
           v * numbers[each * corners[2] + k];
}

static Corner cornerAt(const vtMesh* mesh, uint32_t triangle, float u, float v)
{
    Corner corner = {{0}, {1.0f, 1.0f, 1.0f, 1.0f}, {1.0f, 0.0f, 0.0f}, 1.0f};
    if (mesh->heights != NULL) {
        vtVec3 p[3];
        vtMesh_Corners(mesh, triangle, p);
        vtHeightField_Texcoord(mesh->heights, vtBlend(p, u, v), corner.at);
        return corner;
    }
    const uint32_t* corners = mesh->indices + 3 * (size_t)triangle;
    for (size_t k = 0; k < 2; ++k) {
        corner.at[k] = mesh->texcoords != NULL ? weigh(mesh->texcoords, 2, k, corners, u, v) : 0.0f;
        corner.at[2 + k] = mesh->texcoords1 != NULL ? weigh(mesh->texcoords1, 2, k, corners, u, v) : 0.0f;
    }
    if (mesh->colors != NULL) {
        corner.color.r = weigh(mesh->colors, 3, 0, corners, u, v);
        corner.color.g = weigh(mesh->colors, 3, 1, corners, u, v);
        corner.color.b = weigh(mesh->colors, 3, 2, corners, u, v);
    }
    corner.color.a = mesh->alphas != NULL ? weigh(mesh->alphas, 1, 0, corners, u, v) : 1.0f;
    if (mesh->tangents != NULL) {
        corner.tangent =
            (vtVec3){weigh(mesh->tangents, 4, 0, corners, u, v), weigh(mesh->tangents, 4, 1, corners, u, v),
                     weigh(mesh->tangents, 4, 2, corners, u, v)};
        corner.turned = mesh->tangents[4 * (size_t)corners[0] + 3] < 0.0f ? -1.0f : 1.0f;
    }
    return corner;
}

// ------------------------------------------------------------------- twins of looks.glsl, in the same order

static vtVec3 bentNormal(const vtPlacedObject* object, vtVec3 N, const Corner* corner, float x, float y,
                         float z)
{
    const float side = object->mirrored ? -1.0f : 1.0f;
    vtVec3 T = vtTransformVector(&object->toWorld, corner->tangent);
    T = vtMulAdd(T, -vtDot(T, N), N);
    const float length = vtLength(T);
    T = length > 0.0f ? vtScale(T, 1.0f / length) : grey(0.0f);
    const vtVec3 B = vtScale(vtCross(N, T), side * corner->turned);
    return vtNormalize(vtAdd(vtAdd(vtScale(T, x), vtScale(B, y)), vtScale(N, fmaxf(z, 0.01f))));
}

static float coverageOf(const vtMaterial* material, float alpha)
{
    return material->alphaMode == vt_alphaMask ? (alpha < fmaxf(material->alphaCutoff, 1e-6f) ? 0.0f : 1.0f)
           : material->alphaMode == vt_alphaBlend ? alpha
                                                  : 1.0f;
}

static vtVec3 least1(vtVec3 v)
{
    return (vtVec3){fminf(v.x, 1.0f), fminf(v.y, 1.0f), fminf(v.z, 1.0f)};
}

vtLook vtLookAt(const vtScene* scene, const vtPlacedObject* object, uint32_t triangle, float u, float v,
                float ior, float roughness)
{
    const vtMesh* mesh = object->mesh;
    const vtMaterial* m = object->material;
    vtVec3 p[3], normals[3];
    vtPlacedObject_Corners(object, triangle, p);
    vtMesh_Normals(mesh, triangle, normals);
    const Corner corner = cornerAt(mesh, triangle, u, v);
    const float* at = corner.at;
    const Color base = readMap(scene, m, vt_mapBaseColor, at),
                share = readMap(scene, m, vt_mapMetallicRoughness, at);
    const Color light = readMap(scene, m, vt_mapEmissive, at),
                glossy = readMap(scene, m, vt_mapSpecularColor, at);
    const float squares = floorf(m->checker * at[0]) + floorf(m->checker * at[1]);
    const vtVec3 color = m->opaque ? m->baseColor : m->tint;
    vtLook look = {
        .N = vtNormalize(vtTransformNormal(&object->toObject, vtBlend(normals, u, v))),
        .G = vtNormalize(vtTransformNormal(&object->toObject, vtCross(vtSub(p[1], p[0]), vtSub(p[2], p[0])))),
        .base = vtScale((vtVec3){color.x * base.r * corner.color.r, color.y * base.g * corner.color.g,
                                 color.z * base.b * corner.color.b},
                        2.0f * vtFract(0.5f * squares) > 0.5f ? 0.15f : 1.0f), // odd
        .coverage = coverageOf(m, m->alpha * base.a * corner.color.a),
        .emissive = vtMultiply(m->emissive, (vtVec3){light.r, light.g, light.b}),
        .specularColor = vtMultiply(m->specularColor, (vtVec3){glossy.r, glossy.g, glossy.b}),
        .specular = m->specular * readMap(scene, m, vt_mapSpecular, at).a,
        .metallic = m->metallic * share.b,
        .roughness = vtMaterial_Roughness(m, roughness) * share.g,
        .occlusion = 1.0f + m->occlusionStrength * (readMap(scene, m, vt_mapOcclusion, at).r - 1.0f),
        .film = m->iridescence * readMap(scene, m, vt_mapIridescence, at).r,
        .filmIor = m->iridescenceIor,
        .thin = object->thin,
        .unlit = m->unlit && m->opaque,
        .mirror = m->ior == 0.0f,
        .ior = ior,
    };
    const float thickness = readMap(scene, m, vt_mapIridescenceThickness, at).g;
    look.filmThickness = m->iridescenceMin + thickness * (m->iridescenceMax - m->iridescenceMin);
    look.film = look.filmThickness > 0.0f ? look.film : 0.0f;
    look.passes =
        m->opaque ? 0.0f
                  : m->transmission * (1.0f - look.metallic) * readMap(scene, m, vt_mapTransmission, at).r;
    if (m->maps[vt_mapNormal].image >= 0) {
        const Color n = readMap(scene, m, vt_mapNormal, at);
        look.N = bentNormal(object, look.N, &corner, m->normalScale * (2.0f * n.r - 1.0f),
                            m->normalScale * (2.0f * n.g - 1.0f), 2.0f * n.b - 1.0f);
    }
    return look;
}

/// What a dielectric of that index over the one around it reflects there, straight on.
static vtVec3 reflectedAhead(const vtLook* look, float ior)
{
    const float f = look->mirror ? 1.0f : (ior - 1.0f) / (ior + 1.0f);
    return vtScale(least1(vtScale(look->specularColor, f * f)), look->specular);
}

/// Sensitivity of red, green and blue to an optical path difference of a film, in nanometres, and a phase.
static vtVec3 filmSensitivity(float difference, vtVec3 shift)
{
    const float pi2 = 2.0f * VT_PI, phase = pi2 * difference * 1e-9f;
    const float x = 5.4856e-13f * sqrtf(pi2 * 4.3278e9f) * cosf(1.6810e6f * phase + shift.x) *
                        expf(-phase * phase * 4.3278e9f) +
                    9.7470e-14f * sqrtf(pi2 * 4.5282e9f) * cosf(2.2399e6f * phase + shift.x) *
                        expf(-4.5282e9f * phase * phase);
    const float y = 4.4201e-13f * sqrtf(pi2 * 9.3046e9f) * cosf(1.7953e6f * phase + shift.y) *
                    expf(-phase * phase * 9.3046e9f);
    const float z = 5.2481e-13f * sqrtf(pi2 * 6.6121e9f) * cosf(2.2084e6f * phase + shift.z) *
                    expf(-phase * phase * 6.6121e9f);
    return vtScale((vtVec3){3.2404542f * x - 1.5371385f * y - 0.4985314f * z,
                            -0.9692660f * x + 1.8760108f * y + 0.0415560f * z,
                            0.0556434f * x - 0.2040259f * y + 1.0572252f * z},
                   1.0f / 1.0685e-7f);
}

/// Of a channel: what is below the film reflects of light in it, and whether it turns its phase.
static float belowFilm(float F0, float index, float inside, float* phase)
{
    const float root = sqrtf(vtClamp(F0, 0.0f, 0.9999f)), base = (1.0f + root) / (1.0f - root);
    float r = (base - index) / (base + index);
    r *= r;
    *phase += base < index ? VT_PI : 0.0f;
    return r + (1.0f - r) * powf(1.0f - inside, 5.0f);
}

/// What a film on a surface that reflects F0 straight on reflects, from air at that cosine.
static vtVec3 filmReflectance(float cosine, const vtLook* look, vtVec3 F0)
{
    const float t = vtClamp(look->filmThickness / 0.03f, 0.0f, 1.0f), d = look->filmThickness;
    const float index = 1.0f + t * t * (3.0f - 2.0f * t) * (look->filmIor - 1.0f);
    const float inside = sqrtf(fmaxf(1.0f - (1.0f - cosine * cosine) / (index * index), 0.0f));
    float r0 = (index - 1.0f) / (index + 1.0f);
    r0 *= r0;
    const float R12 = r0 + (1.0f - r0) * powf(1.0f - cosine, 5.0f), T12 = 1.0f - R12;
    const float first = VT_PI - (index < 1.0f ? VT_PI : 0.0f);
    vtVec3 phase = grey(first);
    const vtVec3 R23 = {belowFilm(F0.x, index, inside, &phase.x), belowFilm(F0.y, index, inside, &phase.y),
                        belowFilm(F0.z, index, inside, &phase.z)};
    const float difference = 2.0f * index * d * inside;
    float light[3], C[3], r123[3];
    const float below[3] = {R23.x, R23.y, R23.z};
    for (int c = 0; c < 3; ++c) {
        const float R123 = vtClamp(R12 * below[c], 1e-5f, 0.9999f), Rs = T12 * T12 * below[c] / (1.0f - R123);
        r123[c] = sqrtf(R123);
        light[c] = R12 + Rs;
        C[c] = Rs - T12;
    }
    for (int k = 1; k <= 2; ++k) {
        const vtVec3 s = filmSensitivity((float)k * difference, vtScale(phase, (float)k));
        const float sensitivity[3] = {s.x, s.y, s.z};
        for (int c = 0; c < 3; ++c) {
            C[c] *= r123[c];
            light[c] += 2.0f * C[c] * sensitivity[c];
        }
    }
    return (vtVec3){fmaxf(light[0], 0.0f), fmaxf(light[1], 0.0f), fmaxf(light[2], 0.0f)};
}

vtVec3 vtLook_Reflectance(const vtLook* look, float cosine, float exact, float ior, bool fromInside)
{
    const float f = (ior - 1.0f) / (ior + 1.0f);
    const float share = vtClamp((exact - f * f) / fmaxf(1.0f - f * f, 1e-6f), 0.0f, 1.0f);
    const vtVec3 F0 = reflectedAhead(look, ior);
    vtVec3 F = look->mirror ? F0 : vtMix(F0, grey(look->specular), share);
    if (look->film > 0.0f && !fromInside) {
        F = vtMix(F, filmReflectance(cosine, look, F0), look->film);
    }
    return (vtVec3){vtClamp(F.x, 0.0f, 1.0f), vtClamp(F.y, 0.0f, 1.0f), vtClamp(F.z, 0.0f, 1.0f)};
}

/// The share of light about the mirror direction that is reflected.
static vtVec3 reflectedShare(vtVec3 F0, float F90, float roughness, float cosine)
{
    const float x = 1.0f - roughness, y = 0.0425f - 0.0275f * roughness;
    const float z = 1.04f - 0.572f * roughness, w = 0.022f * roughness - 0.04f;
    const float a = fminf(x * x, exp2f(-9.28f * cosine)) * x + y;
    const float scale = z - 1.04f * a, bias = F90 * (w + 1.04f * a);
    return (vtVec3){fmaxf(F0.x * scale + bias, 0.0f), fmaxf(F0.y * scale + bias, 0.0f),
                    fmaxf(F0.z * scale + bias, 0.0f)};
}

static bool isBright(vtVec3 light)
{
    return fmaxf(light.x, fmaxf(light.y, light.z)) > 1e-5f;
}

/// Of light from the direction L, which a surface would send if nothing were in its way. G: of the triangle,
/// on the viewer's side.
static vtVec3 withShadows(const vtShadows* shadows, vtVec3 G, vtVec3 L, float distance, vtVec3 light)
{
    if (shadows == NULL || !isBright(light)) {
        return light;
    }
    return vtDot(G, L) < 1e-4f ? (vtVec3){0.0f, 0.0f, 0.0f}
                               : vtMultiply(light, shadows->arriving(shadows, L, distance));
}

/// Radiance that it sends of the sun's light. R: mirrored direction of sight; `glossy`: share about it.
static vtVec3 lightOfSun(const vtSun* sun, const vtShadows* shadows, vtVec3 N, vtVec3 G, vtVec3 R,
                         vtVec3 matt, vtVec3 glossy, float roughness)
{
    const vtVec3 L = shadows->towardsSun;
    const vtVec3 sent =
        vtMulAdd(vtScale(matt, fmaxf(vtDot(N, L), 0.0f) / VT_PI), vtSun_Glare(sun, R, roughness), glossy);
    return withShadows(shadows, G, L, INFINITY, vtMultiply(sun->irradiance, sent));
}

/// Radiance towards V of a light at a point: of a matt surface of that colour, and of a glossy one.
static vtVec3 lightOfLight(const vtLight* light, const vtShadows* shadows, vtVec3 position, vtVec3 N,
                           vtVec3 G, vtVec3 V, vtVec3 matt, vtVec3 F0, float F90, float roughness)
{
    const float r = fmaxf(roughness, 0.0525f), a = r * r, nv = fmaxf(vtDot(N, V), 1e-3f);
    const bool directional = light->kind == vt_lightDirectional;
    const vtVec3 to = directional ? vtScale(light->direction, -1.0f) : vtSub(light->position, position);
    const float distance = fmaxf(vtLength(to), 1e-6f);
    const vtVec3 L = vtScale(to, 1.0f / distance);
    const float near = light->range > 0.0f ? distance / light->range : 0.0f;
    const float fade =
        directional ? 1.0f : vtClamp(1.0f - near * near * near * near, 0.0f, 1.0f) / (distance * distance);
    const float inner = cosf(light->innerCone), outer = cosf(light->outerCone);
    const float cone =
        light->kind != vt_lightSpot
            ? 1.0f
            : vtClamp((-vtDot(L, light->direction) - outer) / fmaxf(inner - outer, 1e-4f), 0.0f, 1.0f);
    const float nl = fmaxf(vtDot(N, L), 0.0f);
    const vtVec3 H = vtNormalize(vtAdd(L, V));
    const float nh = fmaxf(vtDot(N, H), 0.0f), vh = fmaxf(vtDot(V, H), 0.0f);
    const float d = nh * nh * (a * a - 1.0f) + 1.0f, D = a * a / (VT_PI * d * d);
    const float shadowing = 0.5f / (nl * sqrtf(nv * nv * (1.0f - a * a) + a * a) +
                                    nv * sqrtf(nl * nl * (1.0f - a * a) + a * a) + 1e-6f);
    const vtVec3 F = vtMix(F0, grey(F90), powf(1.0f - vh, 5.0f));
    const vtVec3 sent = vtMulAdd(vtScale(matt, 1.0f / VT_PI), D * shadowing, F);
    return withShadows(shadows, G, L, directional ? INFINITY : distance,
                       vtScale(vtMultiply(light->color, sent), fade * cone * cone * nl));
}

vtVec3 vtLook_SentLight(const vtLook* look, const vtIllumination* illumination, const vtShadows* shadows,
                        vtVec3 N, vtVec3 I, vtVec3 position, float exposure)
{
    if (look->unlit) { // as it is, whatever the exposure
        return vtScale(look->base, 1.0f / exposure);
    }
    const float cosine = -vtDot(N, I);
    const float matt = (1.0f - look->metallic) * (1.0f - look->passes / fmaxf(1.0f - look->metallic, 1e-6f));
    const float glossy = look->metallic + matt;
    const vtVec3 metal = vtScale(look->base, look->metallic), dielectric = reflectedAhead(look, look->ior);
    const vtVec3 G = vtScale(look->G, vtDot(look->G, I) > 0.0f ? -1.0f : 1.0f);
    vtVec3 light = look->emissive;
    if (glossy > 0.0f) {
        const vtVec3 F0 = vtScale(vtMulAdd(metal, matt, dielectric), 1.0f / glossy);
        const float F90 = (look->metallic + matt * look->specular) / glossy;
        const vtVec3 R = vtNormalize(vtMulAdd(I, 2.0f * cosine, N));
        vtVec3 share = reflectedShare(F0, F90, look->roughness, cosine);
        if (look->film > 0.0f) {
            share = vtMix(share, filmReflectance(cosine, look, F0), look->film);
        }
        const vtVec3 diffuse =
            vtScale(vtMultiply(look->base, vtLighting_Diffuse(illumination->lighting, N)), matt);
        const vtVec3 specular = vtScale(
            vtMultiply(vtLighting_Specular(illumination->lighting, R, look->roughness), share), glossy);
        light = vtMulAdd(light, look->occlusion, vtAdd(diffuse, specular));
        if (shadows != NULL && illumination->sun != NULL) {
            light = vtAdd(light, lightOfSun(illumination->sun, shadows, N, G, R, vtScale(look->base, matt),
                                            vtScale(share, glossy), look->roughness));
        }
    }
    if (shadows != NULL) {
        const vtVec3 color = vtScale(look->base, matt / VT_PI);
        light = vtAdd(light, vtMultiply(color, shadows->gathered));
    }
    const float smooth = matt + look->passes;
    for (uint32_t i = 0; i < illumination->lightCount && i < VT_MOST_LIGHTS; ++i) {
        light =
            vtAdd(light, lightOfLight(&illumination->lights[i], shadows, position, N, G, vtScale(I, -1.0f),
                                      vtScale(look->base, matt), vtMulAdd(metal, smooth, dielectric),
                                      look->metallic + smooth * look->specular, look->roughness));
    }
    return light;
}
