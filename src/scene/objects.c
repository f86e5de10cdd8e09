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

static float determinant(const vtTransform* t)
{
    const vtVec3 x = vtMakeVec3(t->rows[0]), y = vtMakeVec3(t->rows[1]), z = vtMakeVec3(t->rows[2]);
    return vtDot(vtCross(x, y), z);
}

static vtTransform invert(const vtTransform* t, float scale)
{
    const vtVec3 x = vtMakeVec3(t->rows[0]), y = vtMakeVec3(t->rows[1]), z = vtMakeVec3(t->rows[2]);
    const vtVec3 columns[3] = {vtScale(vtCross(y, z), 1.0f / scale), vtScale(vtCross(z, x), 1.0f / scale),
                               vtScale(vtCross(x, y), 1.0f / scale)};
    vtTransform inverse;
    for (int row = 0; row < 3; ++row) {
        float* r = inverse.rows[row];
        for (int column = 0; column < 3; ++column) {
            const vtVec3 c = columns[column];
            r[column] = row == 0 ? c.x : row == 1 ? c.y : c.z;
        }
        r[3] = -(r[0] * t->rows[0][3] + r[1] * t->rows[1][3] + r[2] * t->rows[2][3]);
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
    return 6.0 * fabs(placed->mesh->volume) * fabs((double)determinant(&placed->toWorld));
}

static float absorb(float color, float distance)
{
    return distance > 0.0f ? -logf(vtClamp(color, 1e-6f, 1.0f)) / distance : 0.0f;
}

vtResult vtCheckObject(const vtObject* object, const vtMaterial* material, const char* name, vtError* error)
{
    const vtTransform* t = &object->toWorld;
    const float scale = determinant(t);
    const float size = vtLength(vtMakeVec3(t->rows[0])) * vtLength(vtMakeVec3(t->rows[1])) *
                       vtLength(vtMakeVec3(t->rows[2]));
    if (!isFinite(t) || !(fabsf(scale) > 1e-6f * size) || !isnormal(scale)) {
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
    const float scale = determinant(&object->toWorld);
    const vtVec3 color = material->attenuationColor;
    const float distance = material->attenuationDistance;
    *placed = (vtPlacedObject){
        .mesh = &scene->meshes[object->mesh],
        .material = material,
        .meshIndex = object->mesh,
        .object = index,
        .toWorld = object->toWorld,
        .toObject = invert(&object->toWorld, scale),
        .absorption = {absorb(color.x, distance), absorb(color.y, distance), absorb(color.z, distance)},
        .mirrored = scale < 0.0f,
        .plain = scene->lightCount == 0 &&
                 vtMaterial_IsPlain(material, scene->meshes[object->mesh].colors != NULL),
    };
    vtBoundBox(&placed->toWorld, placed->mesh->boundsMin, placed->mesh->boundsMax, &placed->low,
               &placed->high);
    return vt_ok;
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
    return result == vt_ok ? vtPlaceShapes(scene, placed, glassCount, error) : result;
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

void vtPlacedObject_Recentre(vtPlacedObject* placed, vtVec3 own, vtVec3 world)
{
    const float to[3] = {world.x, world.y, world.z};
    for (int row = 0; row < 3; ++row) {
        float* r = placed->toWorld.rows[row];
        r[3] = (float)((double)r[0] * (double)own.x + (double)r[1] * (double)own.y +
                       (double)r[2] * (double)own.z + (double)r[3] - (double)to[row]);
    }
    placed->toObject = invert(&placed->toWorld, determinant(&placed->toWorld));
    vtBoundBox(&placed->toWorld, vtSub(placed->mesh->boundsMin, own), vtSub(placed->mesh->boundsMax, own),
               &placed->low, &placed->high);
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
        return vtHeightField_Contains(mesh->heights, p);
    }
    // The winding number, by the triangles' solid angles (van Oosterom & Strackee 1983).
    double sum = 0.0;
    for (uint32_t i = 0; i < mesh->indexCount; i += 3) {
        const vtVec3 a = vtSub(vtMakeVec3(mesh->positions + 3 * (size_t)mesh->indices[i]), p);
        const vtVec3 b = vtSub(vtMakeVec3(mesh->positions + 3 * (size_t)mesh->indices[i + 1]), p);
        const vtVec3 c = vtSub(vtMakeVec3(mesh->positions + 3 * (size_t)mesh->indices[i + 2]), p);
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
