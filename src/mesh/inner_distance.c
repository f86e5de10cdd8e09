// Distances from vertices inwards, for technique `wyman` (Wyman 2005, section 3.1: d_N). Natively Embree
// gives the same numbers faster.

#include "base/error.h"
#include "base/math.h"
#include "mesh/hierarchy.h"

vtResult vtComputeInnerDistances(vtMesh* mesh, vtError* error)
{
    if (mesh == NULL) {
        return vtFailMissing(error, "vtComputeInnerDistances", "mesh");
    }
    if (mesh->innerDistances != NULL) {
        return vtSucceed(error);
    }
    if (mesh->indexCount == 0) {
        return vtFail(
            error, vt_errorGeometry,
            "inner distances: the mesh has no triangles; if it is a relief, call vtTriangulateRelief first");
    }
    float* distances = vtAllocate(mesh->vertexCount, sizeof *distances);
    if (distances == NULL) {
        return vtFail(error, vt_errorMemory, "inner distances: out of memory for %u triangles",
                      mesh->indexCount / 3);
    }
    vtHierarchy hierarchy;
    const vtResult result = vtCreateHierarchy(mesh, &hierarchy, error);
    if (result != vt_ok) {
        vtFree(distances);
        return result;
    }
    // The vertex's own triangles lie at distance zero.
    float start = 1e-5f * vtLength(vtSub(mesh->boundsMax, mesh->boundsMin));
    for (size_t i = 0; i < mesh->vertexCount; ++i) {
        vtVec3 inward = vtScale(vtMakeVec3(mesh->normals + 3 * i), -1.0f);
        vtHierarchyHit hit;
        bool found =
            vtHierarchy_Trace(&hierarchy, vtMakeVec3(mesh->positions + 3 * i), inward, start, 2, &hit);
        distances[i] = found ? hit.distance : 0.0f;
    }
    vtDestroyHierarchy(&hierarchy);
    mesh->innerDistances = distances;
    return vtSucceed(error);
}
