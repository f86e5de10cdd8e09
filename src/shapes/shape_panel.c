// A pane with rounded corners and a rounded edge.
#include "base/error.h"
#include "base/math.h"
#include "shapes/shapes.h"

enum {
    cornerParts = 16,                 // of a corner's quarter circle
    bevelParts = 12,                  // of the edge's quarter ellipse
    columns = 4 * (cornerParts + 1),  // of a ring about the pane
    ringCount = 2 * (bevelParts + 1), // from the front's flat middle to the back's
};

vtPanelDef vtDefaultPanelDef(void)
{
    return (vtPanelDef){.width = 2.0f, .height = 1.25f, .radius = 0.25f, .bevel = 0.12f, .thickness = 0.25f};
}

vtResult vtCheckPanel(const vtPanelDef* def, vtError* error)
{
    const struct {
        const char* name;
        float value, least;
    } numbers[] = {{"width", def->width, VT_MIN_PANEL},
                   {"height", def->height, VT_MIN_PANEL},
                   {"radius", def->radius, 0.0f},
                   {"bevel", def->bevel, 0.0f},
                   {"thickness", def->thickness, VT_MIN_PANEL}};
    for (int i = 0; i < 5; ++i) {
        if (!(numbers[i].value >= numbers[i].least && numbers[i].value <= VT_MAX_PANEL)) { // NaN fails
            return vtFail(error, vt_errorArgument, "panel: %s is %g; it must be from %g to %g",
                          numbers[i].name, (double)numbers[i].value, (double)numbers[i].least,
                          (double)VT_MAX_PANEL);
        }
    }
    return vt_ok;
}

/// A ring about the pane: `inset` from its outline, at height z, normals turned from the outline by `out` and
/// `up`.
static void addRing(vtShapeData* shape, const vtPanelDef* def, float radius, float inset, float z, float out,
                    float up)
{
    const float within = fmaxf(radius, inset), round = fmaxf(radius - inset, 0.0f);
    for (int i = 0; i < columns; ++i) {
        const int corner = i / (cornerParts + 1), part = i % (cornerParts + 1);
        const float angle = 0.5f * VT_PI * (float)part / cornerParts;
        // Along the sides exactly: where they have no length the corners' ends are one.
        const float c = part == cornerParts ? 0.0f : cosf(angle),
                    s = part == cornerParts ? 1.0f : sinf(angle);
        const float x = corner == 0 ? c : corner == 1 ? -s : corner == 2 ? -c : s;
        const float y = corner == 0 ? s : corner == 1 ? c : corner == 2 ? -s : -c;
        const float right = corner == 0 || corner == 3 ? 1.0f : -1.0f, above = corner < 2 ? 1.0f : -1.0f;
        const vtVec3 position = {right * (0.5f * def->width - within) + round * x,
                                 above * (0.5f * def->height - within) + round * y, z};
        vtShape_AddVertex(shape, position, vtNormalize((vtVec3){out * x, out * y, up}));
    }
}

static bool same(const vtShapeData* shape, uint32_t a, uint32_t b)
{
    const float *p = shape->positions + 3 * a, *q = shape->positions + 3 * b;
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

/// Where a corner is sharp or there is no bevel some have no area.
static void addTriangle(vtShapeData* shape, uint32_t a, uint32_t b, uint32_t c)
{
    if (!same(shape, a, b) && !same(shape, b, c) && !same(shape, c, a)) {
        vtShape_AddTriangle(shape, a, b, c);
    }
}

bool vtBuildPanelOf(vtShapeData* shape, const vtPanelDef* def)
{
    if (!vtShape_Reserve(shape, ringCount * columns + 2, 2 * ringCount * columns)) {
        return false;
    }
    const float most = 0.5f * fminf(def->width, def->height), half = 0.5f * def->thickness;
    const float radius = fminf(def->radius, most), bevel = fminf(def->bevel, most);
    const float drop = fminf(bevel, half);
    for (int ring = 0; ring < ringCount; ++ring) {
        const int part = ring <= bevelParts ? ring : ringCount - 1 - ring;
        const float side = ring <= bevelParts ? 1.0f : -1.0f, turn = 0.5f * VT_PI * (float)part / bevelParts;
        // Normals turn evenly. The wall is upright, exactly.
        const float out = part == bevelParts ? 1.0f : sinf(turn), up = part == bevelParts ? 0.0f : cosf(turn);
        const float length = bevel > 0.0f ? sqrtf(bevel * bevel * out * out + drop * drop * up * up) : 1.0f;
        addRing(shape, def, radius, bevel * (1.0f - bevel * out / length),
                side * (half - drop * (1.0f - drop * up / length)), out, side * up);
    }
    const uint32_t front = vtShape_AddVertex(shape, (vtVec3){0.0f, 0.0f, half}, (vtVec3){0.0f, 0.0f, 1.0f});
    const uint32_t back = vtShape_AddVertex(shape, (vtVec3){0.0f, 0.0f, -half}, (vtVec3){0.0f, 0.0f, -1.0f});
    const uint32_t last = (ringCount - 1) * columns;
    for (uint32_t i = 0; i < columns; ++i) {
        const uint32_t next = (i + 1) % columns;
        addTriangle(shape, front, i, next);
        for (uint32_t ring = 0; ring < last; ring += columns) {
            addTriangle(shape, ring + i, ring + columns + i, ring + next);
            addTriangle(shape, ring + columns + i, ring + columns + next, ring + next);
        }
        addTriangle(shape, back, last + next, last + i);
    }
    return true;
}

bool vtBuildPanel(vtShapeData* shape)
{
    const vtPanelDef def = vtDefaultPanelDef();
    return vtBuildPanelOf(shape, &def);
}
