#include "scene/objects.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "mesh/height_field.h"
#include "scene/boxes.h"
#include "scene/material.h"

/// "object 3 ('cube')", for sentences.
static void nameObject(const vtScene* scene, uint32_t index, char* text, size_t size)
{
    const char* name = scene->objects[index].name;
    snprintf(text, size, name[0] != '\0' ? "object %u ('%s')" : "object %u", index, name);
}

/// In double: the product of three scales that are floats is none.
static double determinant(const vtTransform* t)
{
    const float(*r)[4] = t->rows;
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
        const int k = (i + 1) % 3, l = (i + 2) % 3;
        sum += (double)r[0][i] * ((double)r[1][k] * (double)r[2][l] - (double)r[1][l] * (double)r[2][k]);
    }
    return sum;
}

static vtTransform invert(const vtTransform* t)
{
    const double scale = determinant(t);
    vtTransform inverse;
    for (int row = 0; row < 3; ++row) {
        double moved = 0.0;
        for (int column = 0; column < 3; ++column) {
            const float *a = t->rows[(column + 1) % 3], *b = t->rows[(column + 2) % 3];
            const int k = (row + 1) % 3, l = (row + 2) % 3;
            const double part = ((double)a[k] * (double)b[l] - (double)a[l] * (double)b[k]) / scale;
            inverse.rows[row][column] = (float)part;
            moved -= part * (double)t->rows[column][3];
        }
        inverse.rows[row][3] = (float)moved;
    }
    return inverse;
}

static bool isFinite(const vtTransform* t)
{
    bool finite = true;
    for (int i = 0; i < 12; ++i) {
        finite = finite && isfinite(t->rows[i / 4][i % 4]);
    }
    return finite;
}

/// Six times the volume, without sign.
static double volumeOf(const vtPlacedObject* placed)
{
    return 6.0 * fabs(placed->mesh->volume) * fabs(determinant(&placed->toWorld));
}

static float absorb(float color, float distance)
{
    return distance > 0.0f ? -logf(vtClamp(color, 1e-6f, 1.0f)) / distance : 0.0f;
}

vtResult vtCheckObject(const vtObject* object, const vtMaterial* material, const char* name, vtError* error)
{
    const vtTransform* t = &object->toWorld;
    double size = 1.0; // of a box as long as the rows
    for (int row = 0; row < 3; ++row) {
        const float* r = t->rows[row];
        size *= sqrt((double)r[0] * (double)r[0] + (double)r[1] * (double)r[1] + (double)r[2] * (double)r[2]);
    }
    const double volume = fabs(determinant(t));
    if (!isFinite(t) || !(volume > 1e-6 * size) || !(volume > 0.9e-54)) {
        return vtFail(error, vt_errorGeometry,
                      "scene: %s is scaled to nothing along an axis; give it a scale other than 0", name);
    }
    const char* what;
    float value, least, most;
    if (!vtMaterial_Check(material, &what, &value, &least, &most)) {
        return vtFail(error, vt_errorArgument, "scene: %s has %s of %g; it must be from %g to %g", name, what,
                      (double)value, (double)least, (double)most);
    }
    return vt_ok;
}

static bool hasImage(const vtScene* scene, int image)
{
    return image == -1 || (image >= 0 && (uint32_t)image < scene->imageCount && scene->images != NULL);
}

/// Its mesh has something to draw, and its images are there.
static vtResult checkContents(const vtScene* scene, uint32_t index, vtError* error)
{
    const vtObject* object = vtScene_Object(scene, index);
    char name[96];
    nameObject(scene, index, name, sizeof name);
    if (object == NULL) {
        return vt_ok; // placeObject says so
    }
    const vtMesh* mesh = &scene->meshes[object->mesh];
    if (mesh->heights == NULL && (mesh->indexCount == 0 || mesh->indices == NULL || mesh->positions == NULL ||
                                  mesh->normals == NULL)) {
        return vtFail(error, vt_errorGeometry, "scene: %s has a mesh without triangles; create it first",
                      name);
    }
    const vtMaterial* material = &scene->materials[object->material];
    for (int use = 0; use < vt_mapCount; ++use) {
        if (!hasImage(scene, material->maps[use].image)) {
            return vtFail(error, vt_errorGeometry, "scene: %s has an image %d, but there are %u", name,
                          material->maps[use].image, scene->imageCount);
        }
    }
    return vt_ok;
}

static vtResult checkReach(const vtPlacedObject* placed, const char* name, vtError* error)
{
    const float ends[] = {placed->low.x,  placed->low.y,  placed->low.z,
                          placed->high.x, placed->high.y, placed->high.z};
    for (int i = 0; i < 6; ++i) {
        if (!(fabsf(ends[i]) <= VT_MOST_COORDINATE)) { // written so that NaN fails
            return vtFail(
                error, vt_errorGeometry,
                "scene: %s reaches %g from the origin; it must be %g at most; scale it down or move it "
                "nearer",
                name, (double)fabsf(ends[i]), (double)VT_MOST_COORDINATE);
        }
    }
    return vt_ok;
}

static vtResult placeObject(const vtScene* scene, uint32_t index, vtPlacedObject* placed, vtError* error)
{
    const vtObject* object = &scene->objects[index];
    char name[96];
    nameObject(scene, index, name, sizeof name);
    if (vtScene_Object(scene, index) == NULL) {
        return vtFail(error, vt_errorGeometry,
                      "scene: %s has mesh %u and material %u, but there are %u and %u", name, object->mesh,
                      object->material, scene->meshCount, scene->materialCount);
    }
    const vtMaterial* material = &scene->materials[object->material];
    const vtResult result = vtCheckObject(object, material, name, error);
    if (result != vt_ok) {
        return result;
    }
    const vtVec3 color = material->attenuationColor;
    const float distance = material->attenuationDistance;
    *placed = (vtPlacedObject){
        .mesh = &scene->meshes[object->mesh],
        .material = material,
        .meshIndex = object->mesh,
        .object = index,
        .own = vtOuterSpace(),
        .toWorld = object->toWorld,
        .toObject = invert(&object->toWorld),
        .absorption = {absorb(color.x, distance), absorb(color.y, distance), absorb(color.z, distance)},
        .mirrored = determinant(&object->toWorld) < 0.0,
        .plain = scene->lightCount == 0 &&
                 vtMaterial_IsPlain(material, scene->meshes[object->mesh].colors != NULL),
    };
    vtBoundBox(&placed->toWorld, placed->mesh->boundsMin, placed->mesh->boundsMax, &placed->low,
               &placed->high);
    return checkReach(placed, name, error);
}

/// What objects are sorted by; the last ones only so that no order of the scene's matters.
typedef struct Rank {
    bool opaque;
    int priority;
    double volume; // steps of a logarithm
    vtVec3 low, high;
    float ior;
    vtPlacedObject placed;
} Rank;

/// Instances turned another way have the same volume but for rounding: it counts in steps of 0.03 %.
static double roundVolume(double volume)
{
    return volume > 0.0 ? round(2048.0 * log2(volume)) : -HUGE_VAL;
}

static int compareNumbers(double a, double b)
{
    return (a > b) - (a < b);
}

static int compareRanks(const void* left, const void* right)
{
    const Rank *a = left, *b = right;
    const double differences[] = {
        (double)(a->opaque - b->opaque),
        compareNumbers((double)b->priority, (double)a->priority),
        compareNumbers(a->volume, b->volume),
        compareNumbers((double)a->low.x, (double)b->low.x),
        compareNumbers((double)a->low.y, (double)b->low.y),
        compareNumbers((double)a->low.z, (double)b->low.z),
        compareNumbers((double)a->high.x, (double)b->high.x),
        compareNumbers((double)a->high.y, (double)b->high.y),
        compareNumbers((double)a->high.z, (double)b->high.z),
        compareNumbers((double)a->ior, (double)b->ior),
        (double)a->placed.object - (double)b->placed.object,
    };
    size_t i = 0;
    while (i + 1 < sizeof differences / sizeof differences[0] && differences[i] == 0.0) {
        ++i;
    }
    return compareNumbers(differences[i], 0.0);
}

static bool liesInside(const vtPlacedObject* inner, const vtPlacedObject* outer)
{
    return inner->low.x > outer->low.x && inner->low.y > outer->low.y && inner->low.z > outer->low.z &&
           inner->high.x < outer->high.x && inner->high.y < outer->high.y && inner->high.z < outer->high.z;
}

/// Of objects of one body the first stands for all.
static void findBodies(const vtScene* scene, vtPlacedObject* placed, uint32_t glassCount)
{
    for (uint32_t i = 0; i < glassCount; ++i) {
        const uint32_t body = scene->objects[placed[i].object].body;
        uint32_t first = body == 0 ? i : 0;
        while (first < i && scene->objects[placed[first].object].body != body) {
            ++first;
        }
        placed[i].body = first;
    }
}

static void findThinWalls(const vtScene* scene, vtPlacedObject* placed, uint32_t glassCount)
{
    for (uint32_t i = 0; i < glassCount; ++i) {
        placed[i].thin = placed[i].material->thin;
        const bool open = placed[i].mesh->openEdgeCount > 0 && scene->objects[placed[i].object].body == 0;
        for (uint32_t k = 0; k < glassCount && open && !placed[i].thin; ++k) {
            placed[i].thin = k != i && !placed[k].material->thin && liesInside(&placed[i], &placed[k]);
        }
    }
}

/// What has no extent cannot be seen, and no eye can be placed before it.
static vtResult checkExtent(const vtScene* scene, vtPlacedObject** placed, vtError* error)
{
    bool any = false, anyOwn = false;
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        const vtPlacedObject* object = &(*placed)[i];
        const vtVec3 size = vtSub(object->high, object->low),
                     own = vtSub(object->mesh->boundsMax, object->mesh->boundsMin),
                     apart = vtSub(object->low, (*placed)[0].low);
        any = any || size.x + size.y + size.z > 0.0f || vtDot(apart, apart) > 0.0f;
        anyOwn = anyOwn || own.x + own.y + own.z > 0.0f;
    }
    if (any) {
        return vt_ok;
    }
    const vtVec3 at = (*placed)[0].low;
    vtFree(*placed);
    *placed = NULL;
    return anyOwn
               ? vtFail(
                     error, vt_errorGeometry,
                     "scene: it is so small and lies so far from the origin, at (%g, %g, %g), that all its "
                     "points are the same; move it nearer, or scale it up",
                     (double)at.x, (double)at.y, (double)at.z)
               : vtFail(error, vt_errorGeometry,
                        "scene: all its points are the same, (%g, %g, %g), so there is nothing to see; give "
                        "its meshes an extent",
                        (double)at.x, (double)at.y, (double)at.z);
}

vtResult vtPlaceObjects(const vtScene* scene, vtPlacedObject** placed, uint32_t* glassCount, vtError* error)
{
    *placed = NULL;
    *glassCount = 0;
    if (scene == NULL) {
        return vtFailMissing(error, "vtValidateScene", "scene");
    }
    vtResult result = vt_ok;
    for (uint32_t i = 0; scene->objects != NULL && i < scene->objectCount && result == vt_ok; ++i) {
        result = checkContents(scene, i, error);
    }
    result = result == vt_ok ? vtPlaceShapes(scene, placed, glassCount, error) : result;
    return result == vt_ok ? checkExtent(scene, placed, error) : result;
}

vtResult vtPlaceShapes(const vtScene* scene, vtPlacedObject** placed, uint32_t* glassCount, vtError* error)
{
    *placed = NULL;
    *glassCount = 0;
    const uint32_t count = scene->objects != NULL ? scene->objectCount : 0;
    if (count == 0 || count > VT_MAX_OBJECTS) {
        return vtFail(error, vt_errorGeometry, "scene: it has %u objects; it must have 1 to %d", count,
                      VT_MAX_OBJECTS);
    }
    Rank* ranks = vtAllocateZeroed(count, sizeof *ranks);
    *placed = vtAllocateZeroed(count, sizeof **placed);
    vtResult result = ranks != NULL && *placed != NULL
                          ? vt_ok
                          : vtFail(error, vt_errorMemory, "scene: out of memory for %u objects", count);
    for (uint32_t i = 0; i < count && result == vt_ok; ++i) {
        Rank* rank = &ranks[i];
        result = placeObject(scene, i, &rank->placed, error);
        if (result == vt_ok) {
            rank->opaque = rank->placed.material->opaque;
            rank->priority = scene->objects[i].priority;
            rank->volume = roundVolume(rank->opaque ? 0.0 : volumeOf(&rank->placed));
            rank->low = rank->placed.low;
            rank->high = rank->placed.high;
            rank->ior = rank->placed.material->ior;
            *glassCount += !rank->opaque;
        }
    }
    if (result == vt_ok) {
        qsort(ranks, count, sizeof *ranks, compareRanks);
        for (uint32_t i = 0; i < count; ++i) {
            (*placed)[i] = ranks[i].placed;
            (*placed)[i].body = i;
        }
        findBodies(scene, *placed, *glassCount);
        findThinWalls(scene, *placed, *glassCount);
    }
    vtFree(ranks);
    if (result != vt_ok) {
        vtFree(*placed);
        *placed = NULL;
    }
    return result;
}

bool vtScene_Uses(const vtScene* scene, uint32_t mesh, bool opaque)
{
    bool used = false;
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        const vtObject* object = vtScene_Object(scene, i);
        used = used || (object != NULL && object->mesh == mesh &&
                        scene->materials[object->material].opaque == opaque);
    }
    return used;
}

bool vtScene_UsesSolid(const vtScene* scene, uint32_t mesh)
{
    bool used = false;
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        const vtObject* object = vtScene_Object(scene, i);
        used =
            used || (object != NULL && object->mesh == mesh && object->body == 0 &&
                     !scene->materials[object->material].opaque && !scene->materials[object->material].thin);
    }
    return used;
}

vtSpace vtSpaceOfObjects(const vtPlacedObject* placed, uint32_t count)
{
    vtVec3 low = {FLT_MAX, FLT_MAX, FLT_MAX}, high = {-FLT_MAX, -FLT_MAX, -FLT_MAX};
    for (uint32_t i = 0; i < count; ++i) {
        const vtVec3 a = placed[i].low, b = placed[i].high;
        low = (vtVec3){fminf(low.x, a.x), fminf(low.y, a.y), fminf(low.z, a.z)};
        high = (vtVec3){fmaxf(high.x, b.x), fmaxf(high.y, b.y), fmaxf(high.z, b.z)};
    }
    return vtSpaceOfBox(low, high);
}

void vtPlacedObject_Enter(vtPlacedObject* placed, const vtSpace* own, const vtSpace* world)
{
    const double to[3] = {(double)world->origin.x, (double)world->origin.y, (double)world->origin.z};
    const double unit = (double)world->unit;
    for (int row = 0; row < 3; ++row) {
        float* r = placed->toWorld.rows[row];
        r[3] = (float)(unit * ((double)r[0] * (double)own->origin.x + (double)r[1] * (double)own->origin.y +
                               (double)r[2] * (double)own->origin.z + (double)r[3] - to[row]));
        for (int column = 0; column < 3; ++column) {
            r[column] = (float)((double)r[column] * unit / (double)own->unit);
        }
    }
    placed->own = *own;
    placed->toObject = invert(&placed->toWorld);
    placed->absorption = vtScale(placed->absorption, 1.0f / world->unit);
    vtBoundBox(&placed->toWorld, vtSpace_Enter(own, placed->mesh->boundsMin),
               vtSpace_Enter(own, placed->mesh->boundsMax), &placed->low, &placed->high);
}

vtLight vtLight_Enter(const vtLight* light, const vtSpace* space)
{
    vtLight entered = *light;
    entered.position = vtSpace_Enter(space, light->position);
    entered.range *= space->unit;
    if (light->kind != vt_lightDirectional) { // falls with the square of the distance
        entered.color = vtScale(vtScale(light->color, space->unit), space->unit);
    }
    return entered;
}

uint32_t vtScene_Relief(const vtScene* scene)
{
    uint32_t glass = scene->meshCount, opaque = scene->meshCount;
    for (uint32_t i = scene->meshCount; i > 0 && scene->meshes != NULL; --i) {
        const bool isRelief = scene->meshes[i - 1].heights != NULL;
        glass = isRelief && vtScene_Uses(scene, i - 1, false) ? i - 1 : glass;
        opaque = isRelief && vtScene_Uses(scene, i - 1, true) ? i - 1 : opaque;
    }
    return glass < scene->meshCount ? glass : opaque;
}

static vtVec3 ownVertex(const vtPlacedObject* placed, uint32_t corner)
{
    const vtMesh* mesh = placed->mesh;
    return vtSpace_Enter(&placed->own, vtMakeVec3(mesh->positions + 3 * (size_t)mesh->indices[corner]));
}

bool vtPlacedObject_Contains(const vtPlacedObject* placed, vtVec3 point)
{
    const vtVec3 low = placed->low, high = placed->high;
    if (point.x < low.x || point.y < low.y || point.z < low.z || point.x > high.x || point.y > high.y ||
        point.z > high.z) {
        return false;
    }
    const vtMesh* mesh = placed->mesh;
    const vtVec3 p = vtTransformPoint(&placed->toObject, point);
    if (mesh->heights != NULL) {
        return vtHeightField_Contains(mesh->heights, vtSpace_Leave(&placed->own, p));
    }
    // The winding number, by the triangles' solid angles (van Oosterom & Strackee 1983).
    double sum = 0.0;
    for (uint32_t i = 0; i < mesh->indexCount; i += 3) {
        const vtVec3 a = vtSub(ownVertex(placed, i), p);
        const vtVec3 b = vtSub(ownVertex(placed, i + 1), p);
        const vtVec3 c = vtSub(ownVertex(placed, i + 2), p);
        const float la = vtLength(a), lb = vtLength(b), lc = vtLength(c);
        const float across = la * lb * lc + vtDot(a, b) * lc + vtDot(b, c) * la + vtDot(c, a) * lb;
        sum += 2.0 * (double)atan2f(vtDot(a, vtCross(b, c)), across);
    }
    return sum > 2.0 * (double)VT_PI; // half of a full turn's 4 pi
}

bool vtScene_HasLooks(const vtScene* scene)
{
    bool any = scene->lightCount > 0;
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        const vtObject* object = vtScene_Object(scene, i);
        any = any || (object != NULL && !vtMaterial_IsPlain(&scene->materials[object->material],
                                                            scene->meshes[object->mesh].colors != NULL));
    }
    return any;
}

bool vtScene_HasGlass(const vtScene* scene)
{
    bool any = false;
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        const vtObject* object = vtScene_Object(scene, i);
        any = any || (object != NULL && !scene->materials[object->material].opaque);
    }
    return any;
}

void vtScene_Bounds(const vtScene* scene, vtVec3* boundsMin, vtVec3* boundsMax)
{
    if (boundsMin == NULL || boundsMax == NULL) {
        return;
    }
    *boundsMin = *boundsMax = (vtVec3){0.0f, 0.0f, 0.0f};
    if (scene == NULL) {
        return;
    }
    const bool anyGlass = vtScene_HasGlass(scene);
    vtVec3 low = {FLT_MAX, FLT_MAX, FLT_MAX}, high = {-FLT_MAX, -FLT_MAX, -FLT_MAX};
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        const vtObject* object = vtScene_Object(scene, i);
        if (object == NULL || (anyGlass && scene->materials[object->material].opaque)) {
            continue;
        }
        vtVec3 a, b;
        const vtMesh* mesh = &scene->meshes[object->mesh];
        vtBoundBox(&object->toWorld, mesh->boundsMin, mesh->boundsMax, &a, &b);
        low = (vtVec3){fminf(low.x, a.x), fminf(low.y, a.y), fminf(low.z, a.z)};
        high = (vtVec3){fmaxf(high.x, b.x), fmaxf(high.y, b.y), fmaxf(high.z, b.z)};
    }
    if (low.x <= high.x) { // else it has no object
        *boundsMin = low;
        *boundsMax = high;
    }
}
