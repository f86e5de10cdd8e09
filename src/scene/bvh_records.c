// This work is based on:
//   Ingo Wald. On fast Construction of SAH-based Bounding Volume Hierarchies. IEEE Symposium on Interactive
//   Ray Tracing 2007: binned surface area heuristic over the triangles' centres.
// Departures:
// - Where the tree would become deeper than the shader's stack its triangles are halved as they lie.
// - Children's boxes lie in their parent in 16-bit steps of the object's box, rounded outwards: two texels a
//   step of the walk. A step is far below a triangle's size, so that little is met that floats would not
//   meet.
#include "scene/bvh_records.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "base/math.h"
#include "scene/triangles.h"

enum { binCount = 16, largestLeaf = 4 };

typedef struct Box {
    float low[3], high[3];
} Box;

/// A triangle while the tree is built.
typedef struct Item {
    Box box;
    float centre[3];
    uint32_t triangle;
} Item;

typedef struct Builder {
    const uint32_t* source; // triangle records
    Item* items;
    vtBvhRecords* out;
    float origin[3], scale[3]; // of the 16-bit steps
} Builder;

/// A run of items, and the number of nodes above it.
typedef struct Range {
    uint32_t first, count;
    int depth;
} Range;

typedef struct Split {
    int axis;
    float low, scale; // bin = (centre - low) * scale
    int bin;          // the first on the right
    float cost;
} Split;

static const Box emptyBox = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};

static void growBox(Box* box, const float* low, const float* high)
{
    for (int k = 0; k < 3; ++k) {
        box->low[k] = fminf(box->low[k], low[k]);
        box->high[k] = fmaxf(box->high[k], high[k]);
    }
}

static float halfArea(const Box* box)
{
    float x = box->high[0] - box->low[0], y = box->high[1] - box->low[1], z = box->high[2] - box->low[2];
    return x < 0.0f ? 0.0f : x * y + y * z + z * x;
}

static int binOf(const Split* split, const Item* item)
{
    int bin = (int)((item->centre[split->axis] - split->low) * split->scale);
    return bin < 0 ? 0 : bin >= binCount ? binCount - 1 : bin;
}

/// The cheapest way to part the range between two bins of one axis; cost FLT_MAX where all centres share a
/// bin.
static Split bestOfAxis(const Item* items, uint32_t count, const Box* centres, int axis)
{
    Split split = {axis, centres->low[axis], 0.0f, 0, FLT_MAX};
    float extent = centres->high[axis] - centres->low[axis];
    if (!(extent > 1e-30f)) {
        return split;
    }
    split.scale = (float)binCount / extent;
    Box bins[binCount];
    uint32_t counts[binCount] = {0};
    for (int i = 0; i < binCount; ++i) {
        bins[i] = emptyBox;
    }
    for (uint32_t i = 0; i < count; ++i) {
        int bin = binOf(&split, &items[i]);
        growBox(&bins[bin], items[i].box.low, items[i].box.high);
        ++counts[bin];
    }
    float above[binCount]; // cost of the bins from i on
    Box box = emptyBox;
    uint32_t sum = 0;
    for (int i = binCount - 1; i > 0; --i) {
        growBox(&box, bins[i].low, bins[i].high);
        sum += counts[i];
        above[i] = halfArea(&box) * (float)sum;
    }
    box = emptyBox;
    sum = 0;
    for (int i = 1; i < binCount; ++i) {
        growBox(&box, bins[i - 1].low, bins[i - 1].high);
        sum += counts[i - 1];
        float cost = halfArea(&box) * (float)sum + above[i];
        if (sum > 0 && sum < count && cost < split.cost) {
            split.cost = cost;
            split.bin = i;
        }
    }
    return split;
}

/// Puts the items of the left side first and gives their number.
static uint32_t partition(const Split* split, Item* items, uint32_t count)
{
    uint32_t left = 0;
    for (uint32_t i = 0; i < count; ++i) {
        if (binOf(split, &items[i]) < split->bin) {
            Item moved = items[i];
            items[i] = items[left];
            items[left++] = moved;
        }
    }
    return left;
}

/// Items of the range's left side, or 0 where it is to be a leaf.
static uint32_t divide(Item* items, Range range, const Box* box)
{
    Box centres = emptyBox;
    for (uint32_t i = 0; i < range.count; ++i) {
        growBox(&centres, items[i].centre, items[i].centre);
    }
    Split best = {0, 0.0f, 0.0f, 0, FLT_MAX};
    for (int axis = 0; axis < 3; ++axis) {
        Split split = bestOfAxis(items, range.count, &centres, axis);
        best = split.cost < best.cost ? split : best;
    }
    int levels = 0; // that halving needs from here
    while ((uint32_t)largestLeaf << levels < range.count) {
        ++levels;
    }
    const bool deep = range.depth + levels + 1 >= VT_BVH_STACK;
    // A step of the walk (two boxes) costs about as much as a triangle.
    const float area = halfArea(box);
    if (range.count <= largestLeaf && (deep || best.cost + area >= area * (float)range.count)) {
        return 0;
    }
    if (deep || best.cost == FLT_MAX) {
        return range.count / 2;
    }
    return partition(&best, items, range.count);
}

static uint32_t step(const Builder* builder, float value, int axis, float outwards)
{
    float steps = (value - builder->origin[axis]) * builder->scale[axis] + 1.0f + outwards;
    return (uint32_t)vtClamp(outwards < 0.0f ? floorf(steps) : ceilf(steps), 0.0f, VT_BVH_STEPS);
}

static void writeBox(const Builder* builder, const Box* box, uint32_t* texel)
{
    uint32_t steps[6];
    for (int axis = 0; axis < 3; ++axis) {
        steps[axis] = step(builder, box->low[axis], axis, -0.5f);
        steps[axis + 3] = step(builder, box->high[axis], axis, 0.5f);
    }
    for (int i = 0; i < 3; ++i) {
        texel[i] = steps[2 * i] | steps[2 * i + 1] << 16;
    }
}

static uint32_t writeLeaf(const Builder* builder, Range range)
{
    const uint32_t first = builder->out->triangleCount;
    for (uint32_t i = 0; i < range.count; ++i) {
        const uint32_t triangle = builder->items[range.first + i].triangle;
        const uint32_t* source = builder->source + VT_TRIANGLE_WORDS * (size_t)triangle;
        uint32_t* texels = builder->out->triangles + 12 * (size_t)builder->out->triangleCount++;
        float corners[3][3];
        for (int k = 0; k < 3; ++k) {
            memcpy(corners[k], source + 4 * k, sizeof corners[k]);
        }
        for (int axis = 0; axis < 3; ++axis) {
            float edges[2] = {corners[1][axis] - corners[0][axis], corners[2][axis] - corners[0][axis]};
            memcpy(texels + 4 + axis, &edges[0], sizeof(float));
            memcpy(texels + 8 + axis, &edges[1], sizeof(float));
        }
        memcpy(texels, corners[0], sizeof corners[0]);
        texels[3] = triangle;
    }
    return 0x80000000u | range.count << VT_BVH_COUNT_SHIFT | first;
}

/// Builds the range's tree, writes its box and what it is into `texel`.
static void build(Builder* builder, Range range, size_t texel)
{
    Item* items = builder->items + range.first;
    Box box = emptyBox;
    for (uint32_t i = 0; i < range.count; ++i) {
        growBox(&box, items[i].box.low, items[i].box.high);
    }
    uint32_t* const nodes = builder->out->nodes;
    writeBox(builder, &box, nodes + 4 * texel);
    const uint32_t left = range.count > 1 ? divide(items, range, &box) : 0;
    if (left == 0) {
        nodes[4 * texel + 3] = writeLeaf(builder, range);
        return;
    }
    const uint32_t node = builder->out->nodeCount++;
    nodes[4 * texel + 3] = node;
    build(builder, (Range){range.first, left, range.depth + 1}, 2 * (size_t)node);
    build(builder, (Range){range.first + left, range.count - left, range.depth + 1}, 2 * (size_t)node + 1);
}

static void setItems(Builder* builder, uint32_t count)
{
    for (uint32_t i = 0; i < count; ++i) {
        Item* item = &builder->items[i];
        *item = (Item){emptyBox, {0.0f}, i};
        for (int k = 0; k < 3; ++k) {
            float corner[3];
            memcpy(corner, builder->source + VT_TRIANGLE_WORDS * (size_t)i + 4 * k, sizeof corner);
            growBox(&item->box, corner, corner);
        }
        for (int axis = 0; axis < 3; ++axis) {
            item->centre[axis] = 0.5f * (item->box.low[axis] + item->box.high[axis]);
        }
    }
}

bool vtCreateBvhRecords(const uint32_t* triangles, uint32_t count, vtVec3 boundsMin, vtVec3 boundsMax,
                        vtBvhRecords* records)
{
    *records = (vtBvhRecords){0};
    Builder builder = {.source = triangles, .out = records};
    builder.items = malloc(count * sizeof *builder.items);
    records->nodes = calloc((size_t)count + 1, 8 * sizeof(uint32_t)); // inner nodes, at most
    records->triangles = calloc(count, 12 * sizeof(uint32_t));
    if (builder.items == NULL || records->nodes == NULL || records->triangles == NULL) {
        free(builder.items);
        vtDestroyBvhRecords(records);
        return false;
    }
    const vtVec3 extent = vtSub(boundsMax, boundsMin);
    const float least = 1e-4f * vtLength(extent); // a flat object has thickness all the same
    const float extents[3] = {extent.x, extent.y, extent.z};
    const float origin[3] = {boundsMin.x, boundsMin.y, boundsMin.z};
    for (int axis = 0; axis < 3; ++axis) {
        builder.origin[axis] = origin[axis];
        builder.scale[axis] = (VT_BVH_STEPS - 2.0f) / fmaxf(extents[axis], least);
    }
    setItems(&builder, count);
    // The root is an inner node whatever it holds: one of few triangles has an empty second child.
    build(&builder, (Range){0, count, 0}, 2 * (size_t)count);
    if (records->nodeCount == 0) {
        memcpy(records->nodes, records->nodes + 8 * (size_t)count, 4 * sizeof(uint32_t));
        const uint32_t none[4] = {0xffffffffu, 0x0000ffffu, 0, 0x80000000u}; // low above high
        memcpy(records->nodes + 4, none, sizeof none);
        records->nodeCount = 1;
    }
    free(builder.items);
    return true;
}

void vtDestroyBvhRecords(vtBvhRecords* records)
{
    free(records->nodes);
    free(records->triangles);
    *records = (vtBvhRecords){0};
}
