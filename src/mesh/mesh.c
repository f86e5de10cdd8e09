// Checks the caller's triangles, completes their normals and counts their flaws.
//
// The normals are based on: G. Thurmer, C. A. Wuthrich. Computing Vertex Normals from Polygonal Facets.
// Journal of Graphics Tools 3(1), 1998: the unit normals of the triangles around a vertex, weighted by
// the angle of each at that vertex, which does not depend on how the surface was cut into triangles.
// Departure: vertices at one position share one normal, however many times the file repeats them.
//
// Geometry is computed in double: the products of two finite floats neither overflow nor vanish there.
#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "mesh/height_field.h"
#include "mesh/hierarchy.h"
#include "mesh/weld.h"

#include <string.h>

typedef struct Double3 {
    double x, y, z;
} Double3;

/// An undirected edge, low < high; an unused slot has low == high. `balance` counts its triangles, those
/// that run from low to high as +1 and the others as -1, so that twins cancel.
typedef struct EdgeSlot {
    uint32_t low, high;
    int64_t balance;
} EdgeSlot;

/// What is known of one triangle.
typedef struct Triangle {
    uint32_t corners[3]; ///< welded
    Double3 normal;      ///< unit, or zero where the triangle has no area
    Double3 edges[3];    ///< from corner i to corner i + 1
} Triangle;

static Double3 subtract(const float* a, const float* b)
{
    return (Double3){(double)a[0] - b[0], (double)a[1] - b[1], (double)a[2] - b[2]};
}

static double dot(Double3 a, Double3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static Double3 cross(Double3 a, Double3 b)
{
    return (Double3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Writes the unit vector along `a` and returns true, or returns false where `a` is no longer than `least`.
static bool writeUnit(Double3 a, double least, float* unit)
{
    double length = sqrt(dot(a, a));
    if (!(length > least)) {
        return false;
    }
    unit[0] = (float)(a.x / length);
    unit[1] = (float)(a.y / length);
    unit[2] = (float)(a.z / length);
    return true;
}

// ------------------------------------------------------------------------------------------- validation

static vtResult checkCounts(const vtMeshDef* def, const char* name, vtError* error)
{
    if (def->vertexCount == 0) {
        return vtFail(error, vt_errorGeometry, "mesh '%.300s': it has no vertices; export it with geometry",
                      name);
    }
    if (def->indexCount == 0) {
        return vtFail(error, vt_errorGeometry, "mesh '%.300s': it has no triangles; export it with faces",
                      name);
    }
    if (def->indexCount % 3 != 0) {
        return vtFail(error, vt_errorGeometry,
                      "mesh '%.300s': its %u indices are not a multiple of 3; export it as triangles", name,
                      (unsigned)def->indexCount);
    }
    return vt_ok;
}

/// Numbers of vertices as the caller has them.
typedef struct Numbers {
    const float* first; ///< NULL: none
    size_t components;
    uint32_t given; ///< the stride as the caller says it
} Numbers;

static size_t strideOf(const Numbers* numbers)
{
    return numbers->given != 0 ? numbers->given : numbers->components * sizeof(float);
}

static const float* numbersAt(const Numbers* numbers, size_t vertex)
{
    return (const float*)((const char*)numbers->first + vertex * strideOf(numbers));
}

static Numbers positionsOf(const vtMeshDef* def)
{
    return (Numbers){def->positions, 3, def->positionStride};
}

static Numbers normalsOf(const vtMeshDef* def)
{
    return (Numbers){def->normals, 3, def->normalStride};
}

static Numbers texcoordsOf(const vtMeshDef* def)
{
    return (Numbers){def->texcoords, 2, def->texcoordStride};
}

static Numbers colorsOf(const vtMeshDef* def)
{
    return (Numbers){def->colors, 3, def->colorStride};
}

static uint32_t indexAt(const vtMeshDef* def, size_t i)
{
    return def->indices != NULL ? def->indices[i] : def->indices16 != NULL ? def->indices16[i] : (uint32_t)i;
}

static vtResult checkLayout(const vtMeshDef* def, const char* name, vtError* error)
{
    const Numbers all[] = {positionsOf(def), normalsOf(def), texcoordsOf(def), colorsOf(def)};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i) {
        const size_t stride = strideOf(&all[i]), least = all[i].components * sizeof(float);
        if (stride < least || stride % sizeof(float) != 0) {
            return vtFail(error, vt_errorArgument,
                          "mesh '%.300s': a stride is %zu bytes; it must be a multiple of 4 and %zu or more",
                          name, stride, least);
        }
    }
    if (def->indices != NULL && def->indices16 != NULL) {
        return vtFail(error, vt_errorArgument,
                      "mesh '%.300s': it has indices of 32 and of 16 bits; give one kind", name);
    }
    return vt_ok;
}

static vtResult checkVectors(Numbers vectors, uint32_t count, const char* kind, const char* name,
                             vtError* error)
{
    for (size_t i = 0; i < count; ++i) {
        const float* v = numbersAt(&vectors, i);
        if (!isfinite(v[0]) || !isfinite(v[1]) || !isfinite(v[2])) {
            return vtFail(
                error, vt_errorGeometry,
                "mesh '%.300s': vertex %zu has a %s that is not finite (%g, %g, %g); export it again", name,
                i, kind, (double)v[0], (double)v[1], (double)v[2]);
        }
    }
    return vt_ok;
}

static vtResult checkIndices(const vtMeshDef* def, const char* name, vtError* error)
{
    if (def->indices == NULL && def->indices16 == NULL) {
        if (def->indexCount > def->vertexCount) {
            return vtFail(
                error, vt_errorGeometry,
                "mesh '%.300s': it has no index list, and %u triangle corners but only %u vertices; "
                "give three vertices for each triangle",
                name, (unsigned)def->indexCount, (unsigned)def->vertexCount);
        }
        return vt_ok;
    }
    for (size_t i = 0; i < def->indexCount; ++i) {
        if (indexAt(def, i) >= def->vertexCount) {
            return vtFail(error, vt_errorGeometry,
                          "mesh '%.300s': index %zu (triangle %zu) is %u, but there are only %u vertices; "
                          "export it again",
                          name, i, i / 3, (unsigned)indexAt(def, i), (unsigned)def->vertexCount);
        }
    }
    return vt_ok;
}

static Triangle getTriangle(const vtMesh* mesh, const uint32_t* welded, size_t firstIndex)
{
    Triangle triangle = {0};
    for (size_t i = 0; i < 3; ++i) {
        triangle.corners[i] = welded[mesh->indices[firstIndex + i]];
    }
    for (int i = 0; i < 3; ++i) {
        triangle.edges[i] = subtract(mesh->positions + 3 * (size_t)triangle.corners[(i + 1) % 3],
                                     mesh->positions + 3 * (size_t)triangle.corners[i]);
    }
    Double3 normal = cross(triangle.edges[0], triangle.edges[1]);
    double length = sqrt(dot(normal, normal));
    if (length > 0.0) {
        triangle.normal = (Double3){normal.x / length, normal.y / length, normal.z / length};
    }
    return triangle;
}

static bool isDegenerate(const Triangle* triangle)
{
    return dot(triangle->normal, triangle->normal) == 0.0;
}

// ---------------------------------------------------------------------------------------------- normals

/// Scales the given normals to unit length; false where one of them has none.
static bool normalizeGiven(vtMesh* mesh)
{
    bool complete = true;
    for (size_t i = 0; i < mesh->vertexCount; ++i) {
        float* n = mesh->normals + 3 * i;
        complete &= writeUnit((Double3){n[0], n[1], n[2]}, 0.0, n);
    }
    return complete;
}

static bool isMissing(const float* normal)
{
    return normal[0] == 0.0f && normal[1] == 0.0f && normal[2] == 0.0f;
}

/// Adds to each corner the triangle's normal times its angle there.
static void addWeighted(const Triangle* triangle, Double3* sums)
{
    for (int i = 0; i < 3; ++i) {
        Double3 forward = triangle->edges[i];
        Double3 back = triangle->edges[(i + 2) % 3]; // runs towards the corner, hence the minus below
        Double3 turn = cross(forward, back);
        double angle = atan2(sqrt(dot(turn, turn)), -dot(forward, back));
        Double3* sum = &sums[triangle->corners[i]];
        sum->x += angle * triangle->normal.x;
        sum->y += angle * triangle->normal.y;
        sum->z += angle * triangle->normal.z;
    }
}

/// Computes every normal that is zero.
static bool completeNormals(vtMesh* mesh, const uint32_t* welded)
{
    Double3* sums = vtAllocateZeroed(mesh->vertexCount, sizeof *sums);
    if (sums == NULL) {
        return false;
    }
    for (size_t i = 0; i < mesh->indexCount; i += 3) {
        Triangle triangle = getTriangle(mesh, welded, i);
        if (!isDegenerate(&triangle)) {
            addWeighted(&triangle, sums);
        }
    }
    for (size_t i = 0; i < mesh->vertexCount; ++i) {
        float* normal = mesh->normals + 3 * i;
        if (isMissing(normal)) {
            // 1e-9 radian: what is left where the two sides of a sheet cancel is rounding, not a direction.
            writeUnit(sums[welded[i]], 1e-9, normal);
        }
    }
    vtFree(sums);
    // Where the sides cancelled, each side keeps the normal of a triangle of its own.
    for (size_t i = 0; i < mesh->indexCount; ++i) {
        float* normal = mesh->normals + 3 * (size_t)mesh->indices[i];
        if (isMissing(normal)) {
            writeUnit(getTriangle(mesh, welded, i - i % 3).normal, 0.0, normal);
        }
    }
    // Vertices that no visible triangle uses still get a unit normal, as the header promises.
    for (size_t i = 0; i < mesh->vertexCount; ++i) {
        if (isMissing(mesh->normals + 3 * i)) {
            mesh->normals[3 * i + 1] = 1.0f;
        }
    }
    return true;
}

// ---------------------------------------------------------------------------------------------- measures

/// Counts one triangle side. A side of no length has no twin and needs none.
static void addEdge(EdgeSlot* slots, size_t capacity, uint32_t from, uint32_t to)
{
    if (from == to) {
        return;
    }
    uint32_t low = from < to ? from : to;
    uint32_t high = from < to ? to : from;
    size_t slot = (size_t)vtMixBits(low | (uint64_t)high << 32) & (capacity - 1);
    while (slots[slot].low != slots[slot].high && (slots[slot].low != low || slots[slot].high != high)) {
        slot = (slot + 1) & (capacity - 1);
    }
    slots[slot].low = low;
    slots[slot].high = high;
    slots[slot].balance += from == low ? 1 : -1;
}

/// Triangles collapsed onto an edge or a point cancel by themselves. Those of three different collinear
/// corners count: exporters fill T-junctions with them, and the surface is closed only with them.
static bool countOpenEdges(vtMesh* mesh, const uint32_t* welded)
{
    size_t capacity = vtTableCapacity(mesh->indexCount); // at most one edge for each index
    EdgeSlot* slots = capacity == 0 ? NULL : vtAllocateZeroed(capacity, sizeof *slots);
    if (slots == NULL) {
        return false;
    }
    for (size_t i = 0; i < mesh->indexCount; i += 3) {
        uint32_t a = welded[mesh->indices[i]];
        uint32_t b = welded[mesh->indices[i + 1]];
        uint32_t c = welded[mesh->indices[i + 2]];
        addEdge(slots, capacity, a, b);
        addEdge(slots, capacity, b, c);
        addEdge(slots, capacity, c, a);
    }
    for (size_t slot = 0; slot < capacity; ++slot) {
        int64_t balance = slots[slot].balance;
        mesh->openEdgeCount += (uint32_t)(balance < 0 ? -balance : balance);
    }
    vtFree(slots);
    return true;
}

static void countDegenerate(vtMesh* mesh, const uint32_t* welded)
{
    for (size_t i = 0; i < mesh->indexCount; i += 3) {
        Triangle triangle = getTriangle(mesh, welded, i);
        mesh->degenerateCount += isDegenerate(&triangle) ? 1 : 0;
    }
}

/// Of the vertices that triangles use: a stray vertex must not push the camera away.
static void findBounds(vtMesh* mesh)
{
    const float* first = mesh->positions + 3 * (size_t)mesh->indices[0];
    float low[3] = {first[0], first[1], first[2]}, high[3] = {first[0], first[1], first[2]};
    for (size_t i = 1; i < mesh->indexCount; ++i) {
        const float* p = mesh->positions + 3 * (size_t)mesh->indices[i];
        for (int axis = 0; axis < 3; ++axis) { // comparisons, which are inlined where fminf is a call
            low[axis] = p[axis] < low[axis] ? p[axis] : low[axis];
            high[axis] = p[axis] > high[axis] ? p[axis] : high[axis];
        }
    }
    mesh->boundsMin = vtMakeVec3(low);
    mesh->boundsMax = vtMakeVec3(high);
}

/// Sums of many small parts, so in double.
static void findVolume(vtMesh* mesh)
{
    const float* origin = mesh->positions;
    double sum = 0.0;
    for (uint32_t i = 0; i < mesh->indexCount; i += 3) {
        const Double3 a = subtract(mesh->positions + 3 * (size_t)mesh->indices[i], origin);
        const Double3 b = subtract(mesh->positions + 3 * (size_t)mesh->indices[i + 1], origin);
        const Double3 c = subtract(mesh->positions + 3 * (size_t)mesh->indices[i + 2], origin);
        sum += dot(cross(a, b), c);
    }
    mesh->volume = sum / 6.0;
}

// ------------------------------------------------------------------------------------------------- calls

/// Side by side. None stay NULL.
static bool copyNumbers(Numbers from, uint32_t count, float** to)
{
    const size_t size = from.components * sizeof(float);
    *to = from.first != NULL ? vtAllocate(count, size) : NULL;
    if (*to != NULL && strideOf(&from) == size) {
        memcpy(*to, from.first, count * size);
    } else if (*to != NULL) {
        for (size_t i = 0; i < count; ++i) {
            memcpy(*to + from.components * i, numbersAt(&from, i), size);
        }
    }
    return from.first == NULL || *to != NULL;
}

static bool copyTriangles(const vtMeshDef* def, vtMesh* mesh)
{
    const uint32_t count = def->vertexCount;
    if (!copyNumbers(positionsOf(def), count, &mesh->positions) ||
        !copyNumbers(normalsOf(def), count, &mesh->normals) ||
        !copyNumbers(texcoordsOf(def), count, &mesh->texcoords) ||
        !copyNumbers(colorsOf(def), count, &mesh->colors) ||
        !copyNumbers((Numbers){def->alphas, 1, 0}, count, &mesh->alphas) ||
        !copyNumbers((Numbers){def->texcoords1, 2, 0}, count, &mesh->texcoords1) ||
        !copyNumbers((Numbers){def->tangents, 4, 0}, count, &mesh->tangents)) {
        return false;
    }
    if (mesh->normals == NULL) {
        mesh->normals = vtAllocateZeroed(count, 3 * sizeof(float));
    }
    mesh->indices = vtAllocate(def->indexCount, sizeof *mesh->indices);
    if (mesh->normals == NULL || mesh->indices == NULL) {
        return false;
    }
    mesh->vertexCount = count;
    mesh->indexCount = def->indexCount;
    for (uint32_t i = 0; i < def->indexCount; ++i) {
        mesh->indices[i] = indexAt(def, i);
    }
    return true;
}

/// Fills *mesh from checked triangles; false where an allocation failed.
static bool buildMesh(const vtMeshDef* def, vtMesh* mesh)
{
    if (!copyTriangles(def, mesh)) {
        return false;
    }
    uint32_t* welded = vtAllocateZeroed(mesh->vertexCount, sizeof *welded);
    bool built = welded != NULL && vtWeldPositions(mesh, welded) && countOpenEdges(mesh, welded);
    if (built) {
        countDegenerate(mesh, welded);
        findBounds(mesh);
        findVolume(mesh);
        mesh->normalsComputed = !normalizeGiven(mesh);
        built = !mesh->normalsComputed || completeNormals(mesh, welded);
    }
    vtFree(welded);
    return built;
}

vtResult vtCreateMesh(const vtMeshDef* def, const char* name, vtMesh* mesh, vtError* error)
{
    if (mesh == NULL) {
        return vtFailMissing(error, "vtCreateMesh", "mesh");
    }
    *mesh = (vtMesh){0};
    if (def == NULL || (def->positions == NULL && def->vertexCount > 0)) {
        return vtFailMissing(error, "vtCreateMesh", def == NULL ? "def" : "def->positions");
    }
    name = name != NULL ? name : "unnamed";
    vtResult result = checkCounts(def, name, error);
    if (result == vt_ok) {
        result = checkLayout(def, name, error);
    }
    if (result == vt_ok) {
        result = checkVectors(positionsOf(def), def->vertexCount, "position", name, error);
    }
    if (result == vt_ok && def->normals != NULL) {
        result = checkVectors(normalsOf(def), def->vertexCount, "normal", name, error);
    }
    if (result == vt_ok) {
        result = checkIndices(def, name, error);
    }
    if (result != vt_ok) {
        return result;
    }
    if (!buildMesh(def, mesh)) {
        vtDestroyMesh(mesh);
        return vtFail(error, vt_errorMemory,
                      "mesh '%.300s': out of memory for %u vertices and %u triangles; simplify it", name,
                      (unsigned)def->vertexCount, (unsigned)(def->indexCount / 3));
    }
    return vtSucceed(error);
}

static bool areFinite(const float* numbers, size_t count)
{
    float sum = 0.0f;
    for (size_t i = 0; i < count; ++i) {
        sum += 0.0f * numbers[i]; // NaN for NaN and infinity
    }
    return sum == 0.0f;
}

/// Normals given or computed for the positions that the mesh has now.
static bool updateNormals(vtMesh* mesh, const float* normals)
{
    const size_t count = 3 * (size_t)mesh->vertexCount;
    if (normals != NULL) {
        memcpy(mesh->normals, normals, count * sizeof *normals);
    } else {
        memset(mesh->normals, 0, count * sizeof *normals);
    }
    mesh->normalsComputed = !normalizeGiven(mesh);
    uint32_t* welded = mesh->normalsComputed ? vtAllocateZeroed(mesh->vertexCount, sizeof *welded) : NULL;
    const bool ready = !mesh->normalsComputed ||
                       (welded != NULL && vtWeldPositions(mesh, welded) && completeNormals(mesh, welded));
    vtFree(welded);
    return ready;
}

/// The hierarchy follows the vertices.
static vtResult updateHierarchy(vtMesh* mesh, vtError* error)
{
    if (mesh->hierarchy == NULL) {
        return vtSucceed(error);
    }
    const bool grows = mesh->degenerateCount > 0; // the hierarchy is without those
    vtResult result = grows ? vt_ok : vtHierarchy_Refit(mesh->hierarchy, mesh, error);
    if (result == vt_ok && (grows || vtHierarchy_IsWorn(mesh->hierarchy))) {
        vtHierarchy fresh;
        result = vtCreateHierarchy(mesh, &fresh, error);
        if (result == vt_ok) {
            fresh.builds = mesh->hierarchy->builds + 1;
            vtDestroyHierarchy(mesh->hierarchy);
            *mesh->hierarchy = fresh;
        }
    }
    return result;
}

vtResult vtMesh_Update(vtMesh* mesh, const float* positions, const float* normals, vtError* error)
{
    if (mesh == NULL || positions == NULL) {
        return vtFailMissing(error, "vtMesh_Update", mesh == NULL ? "mesh" : "positions");
    }
    const size_t count = 3 * (size_t)mesh->vertexCount;
    if (mesh->indexCount == 0) {
        return vtFail(error, vt_errorGeometry, "mesh: it has no triangles whose vertices could move");
    }
    if (!areFinite(positions, count) || (normals != NULL && !areFinite(normals, count))) {
        return vtFail(error, vt_errorGeometry, "mesh: a new position or normal is not a finite number");
    }
    memcpy(mesh->positions, positions, count * sizeof *positions);
    ++mesh->updates;
    findBounds(mesh);
    findVolume(mesh);
    vtFree(mesh->innerDistances);
    mesh->innerDistances = NULL;
    vtDestroyHeightField(mesh->heights);
    mesh->heights = NULL;
    if (!updateNormals(mesh, normals)) {
        return vtFail(error, vt_errorMemory, "mesh: out of memory for the normals of %u vertices",
                      mesh->vertexCount);
    }
    return updateHierarchy(mesh, error);
}

void vtDestroyMesh(vtMesh* mesh)
{
    if (mesh == NULL) {
        return;
    }
    vtFree(mesh->positions);
    vtFree(mesh->normals);
    vtFree(mesh->indices);
    vtFree(mesh->innerDistances);
    vtFree(mesh->texcoords);
    vtFree(mesh->colors);
    vtFree(mesh->alphas);
    vtFree(mesh->texcoords1);
    vtFree(mesh->tangents);
    vtDestroyHeightField(mesh->heights);
    if (mesh->hierarchy != NULL) {
        vtDestroyHierarchy(mesh->hierarchy);
        vtFree(mesh->hierarchy);
    }
    *mesh = (vtMesh){0};
}
