// Tone mapping in C, for pictures that the CPU makes; shaders_es3/shade/tone_*.glsl hold the same formulas
// and must give the same numbers. This work is based on:
//   neutral: Khronos Group. Khronos PBR Neutral Tone Mapper. Specification, 2024. A hyperbola above a knee,
//   for photographs of products: colours below it stay. aces: Stephen Hill's fit of ACES's RRT and ODT for
//   sRGB, in Matt Pettineo. BakingLab. 2016; agx: Troy Sobotka. AgX. 2022, with Rec. 2020 primaries as
//   Blender 4 and Filament have it, its curve Benjamin Wrensch's polynomial (Minimal AgX Implementation,
//   2023).
// Departures: aces divides light by 0.6 first, so that a middle grey stays about as bright as without it, as
// users of three.js and model-viewer know it. agx has its base look alone. Colours out of gamut are cut, not
// moved into it.
#include <math.h>

#include "base/about.h"
#include "base/math.h"

static const struct {
    const char *name, *summary;
} rows[] = {
    {"none", VT_ABOUT("cut at white")},
    {"neutral", VT_ABOUT("Khronos PBR Neutral: colours stay, highlights are compressed")},
    {"aces",
     VT_ABOUT("the filmic curve of ACES, Hill's fit: contrast, and highlights that lose their colour")},
    {"agx", VT_ABOUT("Sobotka's AgX, base look: softer, and bright colours turn pale")},
};
enum { rowCount = sizeof rows / sizeof rows[0] };

const char* vtToneMappingName(int index)
{
    return index >= 0 && index < rowCount ? rows[index].name : NULL;
}

const char* vtToneMappingSummary(int index)
{
    return index >= 0 && index < rowCount ? rows[index].summary : NULL;
}

/// A matrix's columns, as GLSL has them.
typedef struct Matrix {
    vtVec3 columns[3];
} Matrix;

static vtVec3 transform(const Matrix* matrix, vtVec3 v)
{
    return vtMulAdd(vtMulAdd(vtScale(matrix->columns[0], v.x), v.y, matrix->columns[1]), v.z,
                    matrix->columns[2]);
}

static vtVec3 each(float (*curve)(float), vtVec3 v)
{
    return (vtVec3){curve(v.x), curve(v.y), curve(v.z)};
}

static float cut(float x)
{
    return vtClamp(x, 0.0f, 1.0f);
}

// ------------------------------------------------------------- twins of tone_*.glsl

static vtVec3 neutral(vtVec3 light)
{
    const float base = 0.04f, knee = 0.8f - base, desaturation = 0.15f;
    const float least = fminf(light.x, fminf(light.y, light.z));
    const float offset = least < 2.0f * base ? least - least * least / (4.0f * base) : base;
    light = vtSub(light, (vtVec3){offset, offset, offset});
    const float peak = fmaxf(light.x, fmaxf(light.y, light.z));
    if (peak < knee) {
        return light;
    }
    const float room = 1.0f - knee;
    const float shown = 1.0f - room * room / (peak - knee + room);
    const float grey = 1.0f - 1.0f / (1.0f + desaturation * (peak - shown));
    return vtMulAdd(vtScale(light, (1.0f - grey) * shown / peak), grey * shown, (vtVec3){1.0f, 1.0f, 1.0f});
}

static float acesCurve(float x)
{
    return (x * (x + 0.0245786f) - 0.000090537f) / (x * (0.983729f * x + 0.4329510f) + 0.238081f);
}

static vtVec3 aces(vtVec3 light)
{
    static const Matrix fromSrgb = {
        {{0.59719f, 0.07600f, 0.02840f}, {0.35458f, 0.90834f, 0.13383f}, {0.04823f, 0.01566f, 0.83777f}}};
    static const Matrix toSrgb = {{{1.60475f, -0.10208f, -0.00327f},
                                   {-0.53108f, 1.10813f, -0.07276f},
                                   {-0.07367f, -0.00605f, 1.07602f}}};
    const vtVec3 c = each(acesCurve, transform(&fromSrgb, vtScale(light, 1.0f / 0.6f)));
    return each(cut, transform(&toSrgb, c));
}

static float agxCurve(float light)
{
    const float least = -12.47393f, most = 4.026069f; // log2 of 0.18, 10 stops below and 6.5 above
    const float x = cut((log2f(fmaxf(light, 1e-10f)) - least) / (most - least)), x2 = x * x, x4 = x2 * x2;
    return 15.5f * x4 * x2 - 40.14f * x4 * x + 31.96f * x4 - 6.868f * x2 * x + 0.4298f * x2 + 0.1191f * x -
           0.00232f;
}

static float agxDecoded(float x)
{
    return powf(fmaxf(x, 0.0f), 2.2f);
}

static vtVec3 agx(vtVec3 light)
{
    static const Matrix toRec2020 = {
        {{0.6274f, 0.0691f, 0.0164f}, {0.3293f, 0.9195f, 0.0880f}, {0.0433f, 0.0113f, 0.8956f}}};
    static const Matrix fromRec2020 = {
        {{1.6605f, -0.1246f, -0.0182f}, {-0.5876f, 1.1329f, -0.1006f}, {-0.0728f, -0.0083f, 1.1187f}}};
    static const Matrix inset = {{{0.856627153f, 0.137318973f, 0.111898213f},
                                  {0.0951212405f, 0.761241991f, 0.0767994186f},
                                  {0.0482516061f, 0.101439036f, 0.811302368f}}};
    static const Matrix outset = {{{1.12710058f, -0.141329763f, -0.141329763f},
                                   {-0.110606643f, 1.15782370f, -0.110606643f},
                                   {-0.0164939387f, -0.0164939387f, 1.25193641f}}};
    const vtVec3 c = each(agxCurve, transform(&inset, transform(&toRec2020, light)));
    return each(cut, transform(&fromRec2020, each(agxDecoded, transform(&outset, c))));
}

vtVec3 vtToneMap(vtToneMapping toneMapping, vtVec3 light)
{
    switch (toneMapping) {
    case vt_toneMappingNeutral:
        return neutral(light);
    case vt_toneMappingAces:
        return aces(light);
    case vt_toneMappingAgx:
        return agx(light);
    default:
        return each(cut, light);
    }
}
