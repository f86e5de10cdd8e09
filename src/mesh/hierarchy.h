// A mesh as a bounding volume hierarchy of four children a node, whose leaves are pairs of triangles: what
// the shaders walk, and the same records walked on the CPU.
#pragma once

#include "base/space.h"
#include "shaders_es3/common/constants.h"
#include "vitrine.h"

/// Records of VT_RECORD_WORDS words: four texels. Record 0 is the root, an inner node. Children of a node
/// follow one another and have greater numbers than it.
///
/// Inner node: texel k is child k, its words x, y, z each: low step, 12 bits; high step << 12; a signed byte
/// of its cone << 24. The box is all p with low <= (p - gridLow) * gridScale <= high + 1. Cone: m, the bytes
/// / 21; a triangle below with the unit normal n has n . d > 0 for a unit direction d only if m . d > -1;
/// three zeros: for any direction. So with -d where a ray enters. No child: x = y = z = 4095, an empty box.
/// Word w of texel 0: number of the first child; of texel 3: VT_NO_NORMAL, which no leaf has there.
///
/// Leaf: the triangles P0 P1 P2 and P0 P2 P3; P3 = P2 where it is one triangle. Texel k: the bits of Pk,
/// and the packed normal of the vertex (scene/octahedral.h).
typedef struct vtHierarchy {
    uint32_t* records; ///< VT_RECORD_WORDS * recordCount, and zeros up to whole rows of VT_RECORDS_A_ROW
    uint32_t* corners; ///< 4 * recordCount: vertices of a leaf; VT_NO_TRIANGLE of an inner node
    uint32_t recordCount;
    vtSpace space;             ///< about the mesh; all else is in it
    vtVec3 gridLow, gridScale; ///< step = (p - gridLow) * gridScale; the box lies in steps 1 to 4095
    float cost;                ///< as built: records that a ray through the mesh's box reaches on average
    float refitCost;           ///< the same now
    uint32_t builds;           ///< how often it was built anew after refits (vtMesh_Update)
} vtHierarchy;

/// What a ray meets.
typedef struct vtHierarchyHit {
    float distance;       ///< in lengths of the ray's direction
    float u, v;           ///< weights of the triangle's second and third corner
    uint32_t record;      ///< the leaf
    bool second;          ///< its second triangle
    uint32_t vertices[3]; ///< of the triangle, numbers in the mesh
} vtHierarchyHit;

/// Builds the hierarchy at once. Triangles without area are left out; a mesh of no others (or of none) gives
/// a root without children. Fails with vt_errorMemory, or vt_errorGeometry for more pairs than a tree of
/// the shaders' depth holds (about 4 million); then *hierarchy is zeroed.
vtResult vtCreateHierarchy(const vtMesh* mesh, vtHierarchy* hierarchy, vtError* error);
/// Frees and zeroes; safe on a zeroed one.
void vtDestroyHierarchy(vtHierarchy* hierarchy);

// The same in slices, so that nothing else waits long.

typedef struct vtHierarchyBuild vtHierarchyBuild;

/// Keeps a pointer to the mesh, which must stay as it is until the end. NULL where memory is out.
vtHierarchyBuild* vtBeginHierarchy(const vtMesh* mesh, vtError* error);
/// Does about `work` units, at least one step; a unit takes about as long as looking at one triangle. True
/// once nothing is left to do, also after a failure.
bool vtHierarchyBuild_Step(vtHierarchyBuild* build, uint32_t work);
/// Share of the work that is done, 0 to 1.
float vtHierarchyBuild_Progress(const vtHierarchyBuild* build);
/// Does what is left, hands out the hierarchy and frees the build. Fails as vtCreateHierarchy does.
vtResult vtFinishHierarchy(vtHierarchyBuild* build, vtHierarchy* hierarchy, vtError* error);
/// Frees the build; NULL is allowed.
void vtAbandonHierarchy(vtHierarchyBuild* build);

/// Takes over new positions and normals of the mesh that the hierarchy was built of: its indices and the
/// number of its vertices are the same, and vertices that were equal in everything still are. Boxes and cones
/// follow; which triangles lie together does not. Fails with vt_errorMemory, the hierarchy as it was.
vtResult vtHierarchy_Refit(vtHierarchy* hierarchy, const vtMesh* mesh, vtError* error);
/// Refits have made it so much worse than it was that building anew is worth it.
bool vtHierarchy_IsWorn(const vtHierarchy* hierarchy);

/// The nearest triangle beyond distance `start` that the ray meets; false where there is none. `origin`: in
/// the mesh's coordinates; `direction`: of any length but zero, distances are in it; `sides`: of triangles
/// that the ray goes in through (1), out through (2), or either (3).
bool vtHierarchy_Trace(const vtHierarchy* hierarchy, vtVec3 origin, vtVec3 direction, float start, int sides,
                       vtHierarchyHit* hit);

/// Do parts of a closed mesh run into each other? Asked at some hundred places, so that parts of about a
/// hundredth of the surface are found. In such glass sides do not tell what a ray meets next.
bool vtHierarchy_Overlaps(const vtHierarchy* hierarchy);
