// This work is based on:
//   Henri Ylitie, Tero Karras, Samuli Laine. Efficient Incoherent Ray Traversal on GPUs Through Compressed
//   Wide BVHs. High Performance Graphics 2017: the collapse of a binary tree by dynamic programming.
// Departures:
// - Four children, and leaves stay single, as every record costs the walk about the same.
// - Where a child of the cheapest choice has too many levels for what the walk's stack holds, the node takes
// its
//   grandchildren instead: two binary levels at once.
#include <float.h>

#include "mesh/hierarchy_build.h"
#include "shaders_es3/common/constants.h"

// -------------------------------------------------------------------------------------------------- ways

static void findWays(vtHierarchyBuild* build, uint32_t number)
{
    const vtBinaryNode* node = &build->nodes[number];
    vtWays* here = &build->ways[number];
    const float area = vtBox_HalfArea(&node->box);
    *here = (vtWays){.cost = {area, area, area, area}};
    if (node->child == 0) {
        const float* normals = build->normals + 6 * (size_t)node->first;
        for (int k = 0; k < 3; ++k) {
            here->sum[k] = normals[k] + normals[k + 3];
        }
        return;
    }
    const vtWays *l = &build->ways[node->child], *r = l + 1;
    float best[5];
    uint8_t from[5];
    for (int n = 2; n <= 4; ++n) {
        best[n] = FLT_MAX;
        from[n] = 1;
        for (int k = 1; k < n; ++k) {
            const float cost = l->cost[k - 1] + r->cost[n - k - 1];
            if (cost < best[n]) {
                best[n] = cost;
                from[n] = (uint8_t)k;
            }
        }
    }
    here->cost[0] = area + best[4];
    here->left[0] = from[4];
    for (int n = 2; n <= 4; ++n) {
        const bool isBetter = best[n] < here->cost[n - 2];
        here->cost[n - 1] = isBetter ? best[n] : here->cost[n - 2];
        here->left[n - 1] = isBetter ? from[n] : 0;
    }
    here->height = (uint8_t)((l->height > r->height ? l->height : r->height) + 1);
    for (int k = 0; k < 3; ++k) {
        here->sum[k] = l->sum[k] + r->sum[k];
    }
}

/// Bottom up, which is from the last node to the first.
bool vtPhase_Ways(vtHierarchyBuild* build, int64_t* work)
{
    const uint32_t count = build->nodeCount;
    if (build->cursor == 0) {
        build->ways = vtHierarchyBuild_Allocate(build, count, sizeof *build->ways);
    }
    if (build->failure != vt_ok) {
        return true;
    }
    for (uint32_t i = vtAdvance(build, count, 2, work); i < build->cursor; ++i) {
        findWays(build, count - 1 - i);
    }
    return build->cursor == count;
}

// -------------------------------------------------------------------------------------------------- widen

/// The children that are cheapest for the node; gives their number.
static uint32_t chooseCheapest(const vtHierarchyBuild* build, uint32_t number, uint32_t children[4])
{
    const vtBinaryNode* nodes = build->nodes;
    const uint8_t left = build->ways[number].left[0];
    uint8_t room[4] = {left, (uint8_t)(4 - left)}; // children that one may become
    uint32_t count = 2;
    children[0] = nodes[number].child;
    children[1] = children[0] + 1;
    for (uint32_t i = 0; i < count;) {
        const vtWays* ways = &build->ways[children[i]];
        while (room[i] > 1 && ways->left[room[i] - 1] == 0) {
            --room[i];
        }
        if (room[i] == 1) {
            ++i;
            continue;
        }
        for (uint32_t k = count; k > i + 1; --k) {
            children[k] = children[k - 1];
            room[k] = room[k - 1];
        }
        ++count;
        const uint8_t ofLeft = ways->left[room[i] - 1];
        children[i] = nodes[children[i]].child;
        children[i + 1] = children[i] + 1;
        room[i + 1] = (uint8_t)(room[i] - ofLeft);
        room[i] = ofLeft;
    }
    return count;
}

static uint32_t chooseGrandchildren(const vtHierarchyBuild* build, uint32_t number, uint32_t children[4])
{
    uint32_t count = 0;
    for (uint32_t side = 0; side < 2; ++side) {
        const uint32_t child = build->nodes[number].child + side;
        const uint32_t below = build->nodes[child].child;
        if (below == 0) {
            children[count++] = child;
        } else {
            children[count++] = below;
            children[count++] = below + 1;
        }
    }
    return count;
}

/// `level`: the node's, 1 for the root. Its height is at most twice the levels from it on, and so will be
/// that of every child.
static uint32_t chooseChildren(const vtHierarchyBuild* build, uint32_t number, int level,
                               uint32_t children[4])
{
    if (build->nodes[number].child == 0) { // the root of a mesh of one pair
        children[0] = number;
        return build->nodes[number].count;
    }
    const int below = 2 * (VT_HIERARCHY_STACK + 1 - level);
    const uint32_t count = chooseCheapest(build, number, children);
    for (uint32_t i = 0; i < count; ++i) {
        if (build->ways[children[i]].height > below) {
            return chooseGrandchildren(build, number, children);
        }
    }
    return count;
}

static void widen(vtHierarchyBuild* build, vtWaiting waiting)
{
    uint32_t children[4];
    vtWideNode* parent = &build->wide[waiting.record];
    parent->count = chooseChildren(build, parent->node, waiting.level, children);
    parent->first = build->wideCount;
    build->wideCount += parent->count;
    for (uint32_t i = parent->count; i-- > 0;) {
        const uint32_t record = parent->first + i;
        build->wide[record] = (vtWideNode){.node = children[i]};
        build->cost += (double)vtBox_HalfArea(&build->nodes[children[i]].box);
        if (build->nodes[children[i]].child != 0) {
            build->waiting[build->waitingCount++] = (vtWaiting){record, waiting.level + 1};
        }
    }
}

/// Lays out the records, a node's children before all that is below them. The cursor counts records.
bool vtPhase_Widen(vtHierarchyBuild* build, int64_t* work)
{
    if (build->wide == NULL) {
        const size_t most = 2 * (size_t)build->pairCount + 2;
        build->wide = vtHierarchyBuild_Allocate(build, most, sizeof *build->wide);
        if (build->failure != vt_ok) {
            return true;
        }
        build->wide[0] = (vtWideNode){0};
        build->wideCount = 1;
        build->waiting[build->waitingCount++] = (vtWaiting){0, 1};
    }
    while (build->waitingCount > 0 && *work > 0) {
        widen(build, build->waiting[--build->waitingCount]);
        *work -= 2;
    }
    build->cursor = build->wideCount;
    build->limit = build->nodeCount + 1;
    return build->waitingCount == 0;
}
