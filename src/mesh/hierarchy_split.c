// This work is based on:
//   Ingo Wald. On fast Construction of SAH-based Bounding Volume Hierarchies. IEEE Symposium on Interactive
//   Ray Tracing 2007: binned surface area heuristic over the centres of boxes.
// Departures:
// - The items are pairs of triangles, and a leaf holds one.
// - Few items are parted at the best of all places between them rather than between bins.
// - The tree has at most vtBinaryLevels levels: a side gets no more items than the levels left below hold,
// and
//   where no bin allows that, the items are halved as they lie.
#include <float.h>

#include "mesh/hierarchy_build.h"

enum { mostBins = 32, fewItems = 8 };

typedef struct Bin {
    vtBox box;
    uint32_t count;
    uint32_t unused; // to 32 bytes
} Bin;

/// How a range is parted. For bins: bin = (low + high of the item's box - low) * scale.
typedef struct Split {
    int axis;
    uint32_t bin, left; ///< first bin of the right side; items of the left one
    float low, scale;
    float cost; ///< half areas times items
} Split;

static float centre(const vtItem* item, int axis)
{
    return item->box.low[axis] + item->box.high[axis];
}

static uint32_t binOf(const vtItem* item, int axis, float low, float scale)
{
    return (uint32_t)(int)((centre(item, axis) - low) * scale);
}

/// Boxes of one side's items and of their centres.
typedef struct Side {
    vtBox box, centres;
} Side;

static void clearSide(Side* side)
{
    vtBox_Clear(&side->box);
    vtBox_Clear(&side->centres);
}

static void growSide(Side* side, const vtItem* item)
{
    vtBox_Grow(&side->box, item->box.low, item->box.high);
    for (int k = 0; k < 3; ++k) {
        const float value = centre(item, k);
        side->centres.low[k] = vtLesser(value, side->centres.low[k]);
        side->centres.high[k] = vtGreater(value, side->centres.high[k]);
    }
}

// -------------------------------------------------------------------------------------------------- bins

/// The best place between the bins of an axis, if better than *best. `room`: of each side.
static void judgeBins(const Bin* bins, uint32_t binCount, uint32_t count, uint32_t room, const Split* axis,
                      Split* best)
{
    float above[mostBins]; // cost of the bins from i on
    vtBox box;
    uint32_t sum = 0;
    vtBox_Clear(&box);
    for (uint32_t i = binCount - 1; i > 0; --i) {
        vtBox_Grow(&box, bins[i].box.low, bins[i].box.high);
        sum += bins[i].count;
        above[i] = vtBox_HalfArea(&box) * (float)sum;
    }
    vtBox_Clear(&box);
    sum = 0;
    for (uint32_t i = 1; i < binCount; ++i) {
        vtBox_Grow(&box, bins[i - 1].box.low, bins[i - 1].box.high);
        sum += bins[i - 1].count;
        const float cost = vtBox_HalfArea(&box) * (float)sum + above[i];
        if (cost < best->cost && sum > 0 && sum < count && sum <= room && count - sum <= room) {
            *best = *axis;
            best->bin = i;
            best->left = sum;
            best->cost = cost;
        }
    }
}

/// False where all centres share a bin, or no place leaves both sides room.
static bool chooseBin(const vtItem* items, uint32_t count, const vtBox* centres, uint32_t room, Split* best)
{
    const uint32_t binCount = count < 32 ? 8 : count < 512 ? 16 : mostBins;
    Bin bins[3][mostBins];
    Split axes[3];
    for (int k = 0; k < 3; ++k) {
        const float extent = centres->high[k] - centres->low[k];
        const bool isUsable = extent > 1e-30f && extent < 1e30f; // for what 1 / extent is a number
        axes[k] = (Split){.axis = k, .low = centres->low[k]};
        // A little less than all bins, so that no rounding gives one more.
        axes[k].scale = isUsable ? (float)binCount * 0.999999f / extent : 0.0f;
        for (uint32_t i = 0; i < binCount; ++i) {
            vtBox_Clear(&bins[k][i].box);
            bins[k][i].count = 0;
        }
    }
    for (uint32_t i = 0; i < count; ++i) {
        for (int k = 0; k < 3; ++k) {
            Bin* bin = &bins[k][binOf(&items[i], k, axes[k].low, axes[k].scale)];
            vtBox_Grow(&bin->box, items[i].box.low, items[i].box.high);
            ++bin->count;
        }
    }
    best->cost = FLT_MAX;
    for (int k = 0; k < 3; ++k) {
        if (axes[k].scale > 0.0f) {
            judgeBins(bins[k], binCount, count, room, &axes[k], best);
        }
    }
    return best->cost < FLT_MAX;
}

/// Puts the items of the left side first.
static void partition(const Split* split, vtItem* items, uint32_t count, Side sides[2])
{
    Side left = sides[0], right = sides[1]; // copies, which the compiler keeps in registers
    vtItem *first = items, *end = items + count;
    while (first < end) {
        if (binOf(first, split->axis, split->low, split->scale) < split->bin) {
            growSide(&left, first++);
            continue;
        }
        const vtItem moved = *--end;
        growSide(&right, first);
        *end = *first;
        *first = moved;
    }
    sides[0] = left;
    sides[1] = right;
}

// --------------------------------------------------------------------------------------------- few items

/// Sorts at most fewItems by their centres.
static void sortItems(const vtItem* items, uint32_t count, int axis, uint8_t* order)
{
    float keys[fewItems];
    for (uint32_t i = 0; i < count; ++i) {
        const float key = centre(&items[i], axis);
        uint32_t at = i;
        for (; at > 0 && keys[at - 1] > key; --at) {
            keys[at] = keys[at - 1];
            order[at] = order[at - 1];
        }
        keys[at] = key;
        order[at] = (uint8_t)i;
    }
}

/// Parts at most fewItems, at the best place along any axis, and gives the number of the left ones. There is
/// room for a half at least on each side.
static uint32_t sweep(vtItem* items, uint32_t count, uint32_t room)
{
    uint8_t best[fewItems];
    uint32_t left = 0;
    float least = FLT_MAX;
    for (int axis = 0; axis < 3 && count > 2; ++axis) {
        uint8_t order[fewItems];
        float above[fewItems];
        vtBox box;
        sortItems(items, count, axis, order);
        vtBox_Clear(&box);
        for (uint32_t i = count - 1; i > 0; --i) {
            vtBox_Grow(&box, items[order[i]].box.low, items[order[i]].box.high);
            above[i] = vtBox_HalfArea(&box) * (float)(count - i);
        }
        vtBox_Clear(&box);
        for (uint32_t i = 1; i < count; ++i) {
            vtBox_Grow(&box, items[order[i - 1]].box.low, items[order[i - 1]].box.high);
            const float cost = vtBox_HalfArea(&box) * (float)i + above[i];
            if (cost < least && i <= room && count - i <= room) {
                least = cost;
                left = i;
                memcpy(best, order, sizeof best);
            }
        }
    }
    if (left == 0) {
        return count / 2;
    }
    vtItem sorted[fewItems];
    for (uint32_t i = 0; i < count; ++i) {
        sorted[i] = items[best[i]];
    }
    memcpy(items, sorted, count * sizeof *items);
    return left;
}

// -------------------------------------------------------------------------------------------------- tree

/// Gives the node two children, the first of `left` items.
static void addChildren(vtHierarchyBuild* build, const vtRange* range, uint32_t left, const Side sides[2])
{
    vtBinaryNode* parent = &build->nodes[range->node];
    const uint32_t child = build->nodeCount;
    parent->child = child;
    build->nodeCount += 2;
    for (uint32_t side = 0; side < 2; ++side) {
        vtBinaryNode* node = &build->nodes[child + side];
        node->first = parent->first + (side == 0 ? 0 : left);
        node->count = side == 0 ? left : parent->count - left;
        node->child = 0;
        node->box = sides[side].box;
        if (node->count > 1) {
            const vtRange below = {child + side, range->depth + 1, sides[side].centres};
            build->ranges[build->rangeCount++] = below;
        } else {
            ++build->leafCount;
        }
    }
}

static void part(vtHierarchyBuild* build, vtRange range)
{
    const vtBinaryNode* node = &build->nodes[range.node];
    const uint32_t count = node->count;
    const uint32_t room = 1u << (vtBinaryLevels - range.depth - 1);
    vtItem* items = build->items + node->first;
    uint32_t left = count / 2;
    Side sides[2];
    Split split;
    clearSide(&sides[0]);
    clearSide(&sides[1]);
    if (count > fewItems && chooseBin(items, count, &range.centres, room, &split)) {
        partition(&split, items, count, sides);
        left = split.left;
    } else {
        left = count <= fewItems ? sweep(items, count, room) : left;
        for (uint32_t i = 0; i < count; ++i) {
            growSide(&sides[i < left ? 0 : 1], &items[i]);
        }
    }
    addChildren(build, &range, left, sides);
}

/// The root, of all items; with its box.
static void begin(vtHierarchyBuild* build)
{
    const uint32_t count = build->pairCount;
    build->nodes = vtHierarchyBuild_Allocate(build, 2 * (size_t)count + 1, sizeof *build->nodes);
    if (build->failure == vt_ok && count > 1u << vtBinaryLevels) {
        build->failure = vt_errorGeometry;
    }
    if (build->failure != vt_ok) {
        return;
    }
    Side all;
    clearSide(&all);
    for (uint32_t i = 0; i < count; ++i) {
        growSide(&all, &build->items[i]);
    }
    build->nodes[0] = (vtBinaryNode){.box = all.box, .count = count};
    build->nodeCount = 1;
    build->leafCount = count == 1 ? 1 : 0;
    if (count > 1) {
        build->ranges[build->rangeCount++] = (vtRange){.centres = all.centres};
    }
}

/// Parts the items into a binary tree. The cursor counts leaves.
bool vtPhase_Split(vtHierarchyBuild* build, int64_t* work)
{
    if (build->nodes == NULL) {
        begin(build);
        *work -= build->pairCount / 2;
    }
    if (build->failure != vt_ok) {
        return true;
    }
    while (build->rangeCount > 0 && *work > 0) {
        const vtRange range = build->ranges[--build->rangeCount];
        *work -= build->nodes[range.node].count / 2 + 2;
        part(build, range);
    }
    build->cursor = build->leafCount;
    build->limit = build->pairCount;
    return build->rangeCount == 0;
}
