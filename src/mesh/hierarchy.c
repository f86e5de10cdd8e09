// Building a hierarchy, phase by phase, in slices: pairs of triangles, a binary tree of them, its collapse to
// four children a node, the records.
#include "mesh/hierarchy.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/octahedral.h"
#include "mesh/hierarchy_build.h"

/// Brings the triangles' normals into the items' order, so that those below a node lie together.
bool vtPhase_Normals(vtHierarchyBuild* build, int64_t* work)
{
    if (build->cursor == 0) {
        build->normals = vtHierarchyBuild_Allocate(build, build->pairCount, 6 * sizeof *build->normals);
    }
    if (build->failure != vt_ok) {
        return true;
    }
    for (uint32_t i = vtAdvance(build, build->pairCount, 2, work); i < build->cursor; ++i) {
        const vtPair* pair = &build->pairs[build->items[i].pair];
        memcpy(build->normals + 6 * (size_t)i, pair->normals, sizeof pair->normals);
    }
    return build->cursor == build->pairCount;
}

/// The cone of all normals below a node, about their mean.
static vtCone findCone(const vtHierarchyBuild* build, uint32_t number, int64_t* work)
{
    const float* sum = build->ways[number].sum;
    const float length = sqrtf(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    vtCone cone = {.cosine = 0.0f};
    const vtBinaryNode* node = &build->nodes[number];
    if (!(length > 0.05f * 2.0f * (float)node->count)) { // the mean cosine; the least is no more
        return cone;
    }
    for (int k = 0; k < 3; ++k) {
        cone.axis[k] = sum[k] / length;
    }
    const float x = cone.axis[0], y = cone.axis[1], z = cone.axis[2];
    const float* n = build->normals + 6 * (size_t)node->first;
    const float* const end = n + 6 * (size_t)node->count;
    float least = 1.0f;
    for (; n < end && least > 0.0f; n += 6) {
        least = vtLesser(n[0] * x + n[1] * y + n[2] * z, least);
        least = vtLesser(n[3] * x + n[4] * y + n[5] * z, least);
    }
    *work -= (int64_t)((n - (end - 6 * (size_t)node->count)) / 24);
    cone.cosine = least;
    return cone;
}

static void writeNode(vtHierarchyBuild* build, uint32_t number, int64_t* work)
{
    const vtWideNode* wide = &build->wide[number];
    uint32_t* record = build->out.records + VT_RECORD_WORDS * (size_t)number;
    for (uint32_t i = 0; i < 4; ++i) {
        if (i < wide->count) {
            const uint32_t child = build->wide[wide->first + i].node;
            const vtCone cone = findCone(build, child, work);
            vtWriteChild(&build->grid, &build->nodes[child].box, &cone, record + 4 * i);
        } else {
            record[4 * i] = record[4 * i + 1] = record[4 * i + 2] = 4095;
        }
        record[4 * i + 3] = 0;
    }
    record[3] = wide->first;
    record[15] = VT_NO_NORMAL;
    for (size_t i = 0; i < 4; ++i) {
        build->out.corners[4 * (size_t)number + i] = VT_NO_TRIANGLE;
    }
}

static void writeRecord(vtHierarchyBuild* build, uint32_t number, int64_t* work)
{
    const vtWideNode* wide = &build->wide[number];
    if (number == 0 || wide->count > 0) {
        writeNode(build, number, work);
        return;
    }
    const uint32_t* corners = build->pairs[build->items[build->nodes[wide->node].first].pair].corners;
    memcpy(build->out.corners + 4 * (size_t)number, corners, 4 * sizeof *corners);
    vtWriteLeaf(&build->grid, build->mesh->positions, build->packed, corners,
                build->out.records + VT_RECORD_WORDS * (size_t)number);
}

/// Packs the vertices' normals.
static bool vtPhase_Pack(vtHierarchyBuild* build, int64_t* work)
{
    const uint32_t count = build->mesh->vertexCount;
    if (build->cursor == 0) {
        build->packed = vtHierarchyBuild_Allocate(build, count, sizeof *build->packed);
    }
    if (build->failure != vt_ok) {
        return true;
    }
    for (uint32_t i = vtAdvance(build, count, 4, work); i < build->cursor; ++i) {
        build->packed[i] = vtPackNormal(build->mesh->normals + 3 * (size_t)i);
    }
    return build->cursor == count;
}

bool vtPhase_Write(vtHierarchyBuild* build, int64_t* work)
{
    vtHierarchy* out = &build->out;
    const uint32_t count = build->wideCount;
    const size_t rows = ((size_t)count + VT_RECORDS_A_ROW - 1) / VT_RECORDS_A_ROW;
    if (build->cursor == 0) {
        out->records =
            vtHierarchyBuild_Allocate(build, rows * VT_RECORDS_A_ROW, VT_RECORD_WORDS * sizeof *out->records);
        out->corners = vtHierarchyBuild_Allocate(build, count, 4 * sizeof *out->corners);
        out->recordCount = count;
    }
    if (build->failure != vt_ok) {
        return true;
    }
    while (build->cursor<count&& * work> 0) {
        writeRecord(build, build->cursor++, work);
        *work -= 4;
    }
    build->limit = count;
    if (build->cursor < count) {
        return false;
    }
    const double area = (double)vtBox_HalfArea(&build->nodes[0].box);
    vtHierarchy_SetGrid(out, &build->grid);
    out->cost = out->refitCost = 1.0f + (area > 0.0 ? (float)(build->cost / area) : 0.0f);
    return true;
}

// --------------------------------------------------------------------------------------------------- steps

/// A phase and its share of the time, percent.
typedef struct PhaseRow {
    vtPhase* run;
    int share;
} PhaseRow;

static const PhaseRow phases[] = {
    {vtPhase_Faces, 4}, {vtPhase_Count, 2},  {vtPhase_Sum, 1},     {vtPhase_Fill, 4}, {vtPhase_Mate, 8},
    {vtPhase_Weld, 4},  {vtPhase_Count, 1},  {vtPhase_Sum, 1},     {vtPhase_Fill, 1}, {vtPhase_Mate, 4},
    {vtPhase_Pairs, 5}, {vtPhase_Split, 40}, {vtPhase_Normals, 3}, {vtPhase_Ways, 4}, {vtPhase_Widen, 3},
    {vtPhase_Pack, 3},  {vtPhase_Write, 12},
};
enum { phaseCount = sizeof phases / sizeof *phases };

vtHierarchyBuild* vtBeginHierarchy(const vtMesh* mesh, vtError* error)
{
    vtHierarchyBuild* build = vtAllocateZeroed(1, sizeof *build);
    if (build == NULL) {
        vtFail(error, vt_errorMemory, "hierarchy: out of memory for %u triangles", mesh->indexCount / 3);
        return NULL;
    }
    const vtVec3 low = mesh->boundsMin, high = mesh->boundsMax;
    const vtBox box = {{low.x, low.y, low.z}, {high.x, high.y, high.z}};
    build->mesh = mesh;
    build->failure = vt_ok;
    build->grid = vtMakeGrid(&box);
    vtSucceed(error);
    return build;
}

bool vtHierarchyBuild_Step(vtHierarchyBuild* build, uint32_t work)
{
    int64_t left = work;
    while (build->phase < phaseCount && build->failure == vt_ok) {
        if (phases[build->phase].run(build, &left)) {
            ++build->phase;
            build->cursor = build->limit = 0;
        }
        if (left <= 0) {
            break;
        }
    }
    return build->phase == phaseCount || build->failure != vt_ok;
}

float vtHierarchyBuild_Progress(const vtHierarchyBuild* build)
{
    int done = 0, all = 0;
    for (uint32_t i = 0; i < phaseCount; ++i) {
        done += i < build->phase ? phases[i].share : 0;
        all += phases[i].share;
    }
    const float within = build->limit > 0 ? (float)build->cursor / (float)build->limit : 0.0f;
    const float now = build->phase < phaseCount ? within * (float)phases[build->phase].share : 0.0f;
    return ((float)done + now) / (float)all;
}

vtResult vtFinishHierarchy(vtHierarchyBuild* build, vtHierarchy* hierarchy, vtError* error)
{
    *hierarchy = (vtHierarchy){0};
    while (!vtHierarchyBuild_Step(build, UINT32_MAX)) {
    }
    const vtResult failure = build->failure;
    const uint32_t triangles = build->mesh->indexCount / 3;
    if (failure == vt_ok) {
        *hierarchy = build->out;
        build->out = (vtHierarchy){0};
    }
    vtAbandonHierarchy(build);
    if (failure == vt_errorGeometry) {
        return vtFail(error, failure,
                      "hierarchy: %u triangles are more than its depth holds; simplify the mesh", triangles);
    }
    return failure == vt_ok ? vtSucceed(error)
                            : vtFail(error, failure, "hierarchy: out of memory for %u triangles", triangles);
}

void vtAbandonHierarchy(vtHierarchyBuild* build)
{
    if (build == NULL) {
        return;
    }
    void* all[] = {build->faces, build->mates,  build->others,  build->starts, build->sides,
                   build->left,  build->welded, build->slots,   build->pairs,  build->items,
                   build->nodes, build->ways,   build->normals, build->wide,   build->packed};
    for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
        vtFree(all[i]);
    }
    vtDestroyHierarchy(&build->out);
    vtFree(build);
}

vtResult vtCreateHierarchy(const vtMesh* mesh, vtHierarchy* hierarchy, vtError* error)
{
    *hierarchy = (vtHierarchy){0};
    vtHierarchyBuild* build = vtBeginHierarchy(mesh, error);
    return build != NULL ? vtFinishHierarchy(build, hierarchy, error) : vt_errorMemory;
}

void vtDestroyHierarchy(vtHierarchy* hierarchy)
{
    vtFree(hierarchy->records);
    vtFree(hierarchy->corners);
    *hierarchy = (vtHierarchy){0};
}
