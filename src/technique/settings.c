#include "technique/settings.h"

#include <assert.h>
#include <limits.h>
#include <string.h>

#include "base/error.h"

static_assert(sizeof(vtFrame) <= UINT8_MAX, "the table has offsets of a byte");
static_assert(sizeof(vtTechnique) == sizeof(int) && sizeof(vtOutput) == sizeof(int) &&
                  sizeof(vtPreset) == sizeof(int) && sizeof(vtMulti) == sizeof(int) &&
                  sizeof(vtSearch) == sizeof(int) && sizeof(vtBackSurface) == sizeof(int) &&
                  sizeof(vtToneMapping) == sizeof(int) && sizeof(vtBackground) == sizeof(int),
              "the table takes enums for integers");

#ifdef VT_WITH_ABOUT
#define FIELD(title) .field = #title, .offset = offsetof(vtFrame, title)
#define ABOUT(...) __VA_ARGS__
#else
#define FIELD(title) .offset = offsetof(vtFrame, title)
#define ABOUT(...)
#endif
#define RANGE(low, high) .least = (low), .most = (high)
#define ONLY(technique) (1u << vt_technique##technique)
#define KAY (ONLY(KayLinear) | ONLY(KayNonlinear) | ONLY(KayThickness))
#define TRACED (ONLY(Exact) | ONLY(HeightField))

static const char* const presetWords[] = {"low", "medium", "high", NULL};
static_assert(sizeof presetWords / sizeof presetWords[0] == vt_presetCount + 1, "a name for each preset");
#ifdef VT_WITH_ABOUT
static const char
    *const outputWords[] = {"picture", "analysis", "layer-depth", "layer-normal", NULL},
           *const flagWords[] = {"off", "on", NULL}, *const multiWords[] = {"any", "ordered", NULL},
           *const searchWords[] = {"steps", "cells", NULL}, *const backWords[] = {"second", "farthest", NULL},
           *const toneWords[] = {"none", "neutral", "aces", "agx", NULL},
           *const backgroundWords[] = {"environment", "transparent", "color", "blurred", "picture", NULL};
#endif

// In vtFrame's order; those of no kind are integers.
static const vtSetting table[] = {
    {.name = "camera",
     FIELD(view.eye),
     .kind = vt_settingVector,
     ABOUT(.zero = "the object framed", .help = "position of the eye")},
    {.name = "target",
     FIELD(view.target),
     .kind = vt_settingVector,
     ABOUT(.zero = "the object's centre", .help = "what it looks at")},
    {.name = "fov",
     FIELD(view.fovY),
     .kind = vt_settingNumber,
     .standard = 45,
     RANGE(1, 170),
     ABOUT(.unit = "degrees", .help = "vertical field of view")},
    {.name = "orthographic-height",
     FIELD(orthographicHeight),
     .kind = vt_settingNumber,
     RANGE(0, 2000000000),
     ABOUT(.zero = "perspective",
           .help = "world units from the lower to the upper edge, with parallel rays")},
    {.name = "technique",
     FIELD(technique),
     .standard = vt_techniqueExact,
     RANGE(0, vt_techniqueCount - 1),
     ABOUT(.help = "how the glass is computed")},
    {.name = "output",
     FIELD(output),
     RANGE(vt_outputPicture, vt_outputLayerNormal),
     ABOUT(.words = outputWords, .help = "what is shown")},
    {.name = "layer",
     FIELD(layer),
     RANGE(0, VT_MAX_LAYERS - 1),
     ABOUT(.help = "which layer is shown, 0 the nearest")}, // and below the layers there are
    {.name = "ior",
     FIELD(ior),
     .kind = vt_settingNumber,
     RANGE(1, 4),
     .takesZero = true,
     ABOUT(.zero = "each object's own", .help = "index of refraction of all glass")},
    {.name = "roughness",
     FIELD(roughness),
     .kind = vt_settingNumber,
     .standard = -1,
     RANGE(0, 1),
     .ofObjects = true,
     ABOUT(.zero = "each object's own", .help = "of all glass; alpha of GGX is its square")},
    {.name = "dispersion",
     FIELD(dispersion),
     .kind = vt_settingNumber,
     .standard = -1,
     RANGE(0, 20),
     .ofObjects = true,
     ABOUT(.zero = "each object's own", .help = "of all glass: 20 over its Abbe number, or abbe:NUMBER")},
    {.name = "fresnel",
     FIELD(fresnel),
     .kind = vt_settingFlag,
     .standard = 1,
     ABOUT(.words = flagWords, .help = "Fresnel reflection")},
    {.name = "branches",
     FIELD(branches),
     RANGE(-1, VT_MAX_BRANCHES),
     .ofPreset = {-1, 1, 2},
     ABOUT(.techniques = TRACED, .help = "how often light that left a path is followed, -1 never")},
    {.name = "wavelengths",
     FIELD(wavelengths),
     RANGE(1, VT_MAX_WAVELENGTHS),
     .ofPreset = {1, 3, 3},
     ABOUT(.techniques = TRACED, .help = "that the first sample follows through glass that disperses")},
    {.name = "multi",
     FIELD(multi),
     RANGE(vt_multiAny, vt_multiOrdered),
     ABOUT(.words = multiWords, .techniques = ONLY(Layered),
           .help = "several objects: as paths meet them, or one after the other")},
    {.name = "search",
     FIELD(search),
     RANGE(vt_searchSteps, vt_searchCells),
     ABOUT(.words = searchWords, .techniques = ONLY(Layered),
           .help = "by linear and binary steps, or from cell to cell")},
    {.name = "preset",
     FIELD(preset),
     .standard = vt_presetMedium,
     RANGE(0, vt_presetCount - 1),
     ABOUT(.words = presetWords, .help = "settings that are not given")},
    {.name = "layers",
     FIELD(layers),
     RANGE(1, VT_MAX_LAYERS),
     .ofPreset = {2, 4, 8},
     ABOUT(.techniques = KAY | ONLY(Layered), .help = "depth layers peeled")},
    {.name = "steps",
     FIELD(steps),
     RANGE(1, VT_MAX_STEPS),
     .ofPreset = {25, 50, 100},
     ABOUT(.techniques = ONLY(Layered) | ONLY(Oliveira), .help = "linear search steps a segment")},
    {.name = "refine",
     FIELD(refine),
     .standard = 8,
     RANGE(0, VT_MAX_REFINE),
     ABOUT(.techniques = ONLY(Layered) | ONLY(Oliveira), .help = "binary search steps after them")},
    {.name = "max-events",
     FIELD(maxEvents),
     RANGE(1, VT_MAX_EVENTS),
     .ofPreset = {4, 8, 8},
     ABOUT(.help = "refractions and internal reflections of a path")},
    {.name = "layer-size",
     FIELD(layerSize),
     RANGE(16, 8192),
     .takesZero = true,
     ABOUT(.zero = "that of the picture", .unit = "texels", .help = "longer side of the layer textures")},
    {.name = "back-surface",
     FIELD(backSurface),
     RANGE(vt_backSecond, vt_backFarthest),
     ABOUT(.words = backWords, .techniques = ONLY(Wyman), .help = "the back side")},
    {.name = "transmittance",
     FIELD(transmittance),
     .kind = vt_settingNumber,
     .standard = 0.8f,
     RANGE(0, 1),
     ABOUT(.techniques = ONLY(KayLinear) | ONLY(KayThickness),
           .help = "of a surface, of a wall straight through")},
    {.name = "max-transmittance",
     FIELD(maxTransmittance),
     .kind = vt_settingNumber,
     .standard = 0.95f,
     RANGE(0, 1),
     ABOUT(.techniques = ONLY(KayNonlinear), .help = "of a surface seen straight on")},
    {.name = "min-transmittance",
     FIELD(minTransmittance),
     .kind = vt_settingNumber,
     .standard = 0.2f,
     RANGE(0, 1),
     ABOUT(.techniques = ONLY(KayNonlinear), .help = "of a surface seen from its side")},
    {.name = "power",
     FIELD(power),
     .kind = vt_settingNumber,
     .standard = 3,
     RANGE(0, 100),
     ABOUT(.techniques = ONLY(KayNonlinear), .help = "how late it falls from the one to the other")},
    {.name = "wall-thickness",
     FIELD(wallThickness),
     .kind = vt_settingNumber,
     RANGE(0, 1000000),
     .takesZero = true,
     ABOUT(.zero = "6 % of the object's largest extent", .techniques = ONLY(KayThickness),
           .help = "of glass, in the model's unit")},
    {.name = "width",
     FIELD(width),
     .standard = 512,
     RANGE(1, 16384),
     ABOUT(.unit = "pixels", .help = "of the picture")},
    {.name = "height",
     FIELD(height),
     .standard = 512,
     RANGE(1, 16384),
     ABOUT(.unit = "pixels", .help = "of the picture")},
    {.name = "exposure",
     FIELD(exposure),
     .kind = vt_settingNumber,
     RANGE(-20, 20),
     ABOUT(.unit = "EV", .help = "brightens by a factor of 2 each")},
    {.name = "tone-mapping",
     FIELD(toneMapping),
     RANGE(0, vt_toneMappingCount - 1),
     ABOUT(.words = toneWords, .help = "from light to what a display shows")},
    {.name = "background-kind",
     FIELD(background),
     RANGE(0, VT_BACKGROUND_PICTURE),
     ABOUT(.words = backgroundWords, .help = "what is behind the scene")},
    {.name = "background-color",
     FIELD(backgroundColor),
     .kind = vt_settingVector,
     ABOUT(.help = "sRGB, 0 to 1")},
    {.name = "background-blur",
     FIELD(backgroundBlur),
     .kind = vt_settingNumber,
     .standard = 6,
     RANGE(1, 90),
     ABOUT(.unit = "degrees", .help = "standard deviation of the blurred environment")},
    {.name = "samples",
     FIELD(samples),
     .standard = 1,
     RANGE(1, VT_MAX_SAMPLES),
     .continues = true,
     ABOUT(.help = "a pixel, for smooth edges")},
    {.name = "first-sample",
     FIELD(firstSample),
     RANGE(0, 1000000),
     .continues = true,
     ABOUT(.help = "number of the first of them")},
    {.name = "moving",
     FIELD(moving),
     .kind = vt_settingFlag,
     .continues = true,
     ABOUT(.words = flagWords, .help = "what has changed since the sample before is motion")},
    {.name = "count-reads",
     FIELD(countReads),
     .kind = vt_settingFlag,
     .continues = true,
     ABOUT(.words = flagWords, .help = "texture reads are counted")},
};
enum { settingCount = sizeof table / sizeof table[0] };

const vtSetting* vtSetting_At(int index)
{
    return index >= 0 && index < settingCount ? &table[index] : NULL;
}

const vtSetting* vtFindSetting(const char* name)
{
    int index = 0;
    while (index < settingCount && strcmp(table[index].name, name) != 0) {
        ++index;
    }
    return vtSetting_At(index);
}

bool vtSetting_IsOfPreset(const vtSetting* setting)
{
    return setting->ofPreset[vt_presetLow] != 0;
}

double vtSetting_Get(const vtSetting* setting, const vtFrame* frame)
{
    const char* field = (const char*)frame + setting->offset;
    int integer;
    float number;
    switch (setting->kind) {
    case vt_settingInteger:
        memcpy(&integer, field, sizeof integer);
        return integer;
    case vt_settingNumber:
        memcpy(&number, field, sizeof number);
        return (double)number;
    default:
        assert(setting->kind == vt_settingFlag);
        return *(const bool*)field;
    }
}

void vtSetting_Set(const vtSetting* setting, vtFrame* frame, double value)
{
    char* field = (char*)frame + setting->offset;
    const bool fits = value >= -1e9 && value <= 1e9; // else, or not a number, no int holds it
    const int integer = fits ? (int)value : INT_MAX;
    const float number = (float)value;
    switch (setting->kind) {
    case vt_settingInteger:
        memcpy(field, &integer, sizeof integer);
        break;
    case vt_settingNumber:
        memcpy(field, &number, sizeof number);
        break;
    default:
        assert(setting->kind == vt_settingFlag);
        *(bool*)field = value != 0.0;
        break;
    }
}

vtFrame vtDefaultFrame(void)
{
    vtFrame frame = {.view = {.eye = {0.36f, 0.3f, 3.05f}}};
    for (int i = 0; i < settingCount; ++i) {
        if (table[i].kind != vt_settingVector) {
            vtSetting_Set(&table[i], &frame, (double)table[i].standard);
        }
    }
    return frame;
}

const char* vtPresetName(int index)
{
    return index >= 0 && index < vt_presetCount ? presetWords[index] : NULL;
}

vtFrame vtResolveFrame(const vtFrame* frame)
{
    vtFrame resolved = frame != NULL ? *frame : vtDefaultFrame();
    frame = &resolved;
    if ((int)frame->preset < 0 || frame->preset >= vt_presetCount) {
        return resolved; // vtValidateFrame says so
    }
    for (int i = 0; i < settingCount; ++i) {
        if (vtSetting_IsOfPreset(&table[i]) && vtSetting_Get(&table[i], frame) == 0.0) {
            vtSetting_Set(&table[i], &resolved, table[i].ofPreset[frame->preset]);
        }
    }
    return resolved;
}

void vtFrame_Lessen(vtFrame* frame, vtPreset preset)
{
    *frame = vtResolveFrame(frame);
    for (int i = 0; i < settingCount; ++i) {
        const int most = table[i].ofPreset[preset];
        if (vtSetting_IsOfPreset(&table[i]) && vtSetting_Get(&table[i], frame) > most) {
            vtSetting_Set(&table[i], frame, most);
        }
    }
}

vtResult vtCheckSettings(const vtFrame* frame, vtError* error)
{
    for (int i = 0; i < settingCount; ++i) {
        const vtSetting* setting = &table[i];
        if (setting->kind > vt_settingNumber) {
            continue;
        }
        const double value = vtSetting_Get(setting, frame);
        const double least = setting->least;
        const double most = setting->offset == offsetof(vtFrame, minTransmittance)
                                ? (double)frame->maxTransmittance
                                : setting->most;
        const bool takesZero = setting->takesZero || vtSetting_IsOfPreset(setting);
        // Written so that NaN fails.
        if (!(value >= least && value <= most) && !(takesZero && value == 0.0) &&
            !(setting->ofObjects && value == -1.0)) {
            return vtFail(error, vt_errorArgument, "%s is %g; it must be from %g to %g%s", setting->name,
                          value, least, most,
                          setting->ofObjects         ? ", or -1"
                          : takesZero && least > 0.0 ? ", or 0"
                                                     : "");
        }
    }
    return vtSucceed(error);
}

bool vtFrame_Same(const vtFrame* a, const vtFrame* b)
{
    static const size_t sizes[] = {[vt_settingInteger] = sizeof(int),
                                   [vt_settingNumber] = sizeof(float),
                                   [vt_settingFlag] = sizeof(bool),
                                   [vt_settingVector] = sizeof(vtVec3)};
    bool same = true;
    for (int i = 0; i < settingCount; ++i) {
        const size_t at = table[i].offset;
        same = same && (table[i].continues ||
                        memcmp((const char*)a + at, (const char*)b + at, sizes[table[i].kind]) == 0);
    }
    return same;
}
