// What the phases of building a hierarchy share.
#pragma once

#include "mesh/hierarchy_record.h"
#include "shaders_es3/common/constants.h"

/// Levels of the binary tree below its root, so that two at once give the shaders' depth.
enum { vtBinaryLevels = 2 * (VT_HIERARCHY_STACK + 1) };

/// What became of a triangle; 0 to 2: it is the first of a pair over the side that starts at this corner.
enum { vtMateSingle = 3, vtMateSecond, vtMateOpen, vtMateNoArea };

/// A side of a triangle, kept with the vertex where it starts.
typedef struct vtSide {
    uint32_t end;    ///< vertex
    uint32_t corner; ///< 3 * triangle + corner where it starts
} vtSide;

/// Two triangles P0 P1 P2 and P0 P2 P3, or one, P3 = P2.
typedef struct vtPair {
    uint32_t corners[4];
    float normals[2][3]; ///< of the triangles, unit; the same twice for one
} vtPair;

/// A pair while the tree is parted: its box.
typedef struct vtItem {
    vtBox box;
    uint32_t pair;
    uint32_t unused; // to 32 bytes
} vtItem;

/// Of the binary tree. Children follow one another and have greater numbers.
typedef struct vtBinaryNode {
    vtBox box;
    uint32_t first, count; ///< items below
    uint32_t child;        ///< the first; 0: a leaf of one item
} vtBinaryNode;

/// Items that wait for being parted.
typedef struct vtRange {
    uint32_t node;
    int depth;     ///< nodes above
    vtBox centres; ///< of the items' boxes' low + high
} vtRange;

/// Cheapest ways to show what hangs below a binary node as up to so many children of a wide one.
typedef struct vtWays {
    float cost[4];   ///< as 1 to 4 children
    uint8_t left[4]; ///< how many of them the left side gives; 0: as with one less. [0]: within the node
    uint8_t height;  ///< levels below
    float sum[3];    ///< of the normals
} vtWays;

/// A record to be.
typedef struct vtWideNode {
    uint32_t node;  ///< of the binary tree
    uint32_t first; ///< record of the first child
    uint32_t count; ///< of children; 0: a leaf
} vtWideNode;

/// A wide node whose children are still to be found.
typedef struct vtWaiting {
    uint32_t record;
    int level; ///< 1: the root
} vtWaiting;

struct vtHierarchyBuild {
    const vtMesh* mesh;
    vtGrid grid;
    vtResult failure;
    uint32_t phase, cursor; ///< cursor: how far the phase is
    uint32_t limit;         ///< where its cursor ends

    // Pairs.
    bool welding;     ///< the second round: over vertices that are equal, of triangles left over
    float* faces;     ///< unit normals of the triangles, 3 each
    uint8_t* mates;   ///< a triangle: vtMate... or the side's corner
    uint32_t* others; ///< of the first of a pair: corner where the other's side starts, 3 * triangle + corner
    uint32_t* starts; ///< of each vertex's sides
    vtSide* sides;
    uint32_t* left; ///< triangles for the second round
    uint32_t leftCount;
    uint32_t* welded; ///< vertex + 1 that stands for this one; 0: not asked yet
    uint32_t* slots;  ///< hash table of vertex + 1
    size_t slotCount;
    vtPair* pairs;
    uint32_t pairCount;

    // Binary tree.
    vtItem* items;
    vtBinaryNode* nodes;
    uint32_t nodeCount;
    vtRange ranges[vtBinaryLevels + 2];
    uint32_t rangeCount;
    uint32_t leafCount;

    // Wide tree.
    vtWays* ways;
    float* normals; ///< 6 an item
    vtWideNode* wide;
    uint32_t wideCount;
    vtWaiting waiting[3 * (VT_HIERARCHY_STACK + 1) + 2];
    uint32_t waitingCount;
    double cost;
    uint32_t* packed; ///< normals of vertices
    vtHierarchy out;
};

/// A phase does up to about *work units, takes them off *work and says whether it is done. It starts with the
/// cursor at 0 and may fail, in build->failure.
typedef bool vtPhase(vtHierarchyBuild* build, int64_t* work);

vtPhase vtPhase_Faces, vtPhase_Weld, vtPhase_Count, vtPhase_Sum, vtPhase_Fill, vtPhase_Mate, vtPhase_Pairs;
vtPhase vtPhase_Split;
vtPhase vtPhase_Ways, vtPhase_Widen;
vtPhase vtPhase_Normals, vtPhase_Write;

/// Takes the next items of a phase over `limit` of them, `perUnit` a unit of work: the cursor moves on, the
/// number where it was is given back.
static inline uint32_t vtAdvance(vtHierarchyBuild* build, uint32_t limit, uint32_t perUnit, int64_t* work)
{
    const uint32_t first = build->cursor;
    const int64_t wanted = (*work > 0 ? *work : 1) * perUnit;
    const uint32_t count = wanted < limit - first ? (uint32_t)wanted : limit - first;
    *work -= count / perUnit + 1;
    build->cursor = first + count;
    build->limit = limit;
    return first;
}

/// An array; the failure is noted.
void* vtHierarchyBuild_Allocate(vtHierarchyBuild* build, size_t count, size_t size);
/// The same, all zeros.
void* vtHierarchyBuild_AllocateZeros(vtHierarchyBuild* build, size_t count, size_t size);
