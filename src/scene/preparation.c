
#include "base/error.h"
#include "base/memory.h"
#include "mesh/hierarchy.h"

struct vtPreparation {
    vtScene* scene;
    uint32_t mesh;           ///< that is built, or meshCount
    vtHierarchyBuild* build; ///< of it; NULL: not begun
    vtError failure;         ///< of the first that failed
};

vtPreparation* vtBeginPreparation(vtScene* scene)
{
    vtPreparation* preparation = scene != NULL ? vtAllocateZeroed(1, sizeof *preparation) : NULL;
    if (preparation != NULL) {
        preparation->scene = scene;
    }
    return preparation;
}

/// Gives the mesh what has been built.
static void keep(vtPreparation* preparation, vtMesh* mesh)
{
    vtHierarchy* hierarchy = vtAllocate(1, sizeof *hierarchy);
    vtError* failure = &preparation->failure;
    if (hierarchy == NULL) {
        vtAbandonHierarchy(preparation->build);
        vtFail(failure, vt_errorMemory, "hierarchy: out of memory for %u triangles", mesh->indexCount / 3);
    } else if (vtFinishHierarchy(preparation->build, hierarchy, failure) == vt_ok) {
        mesh->hierarchy = hierarchy;
    } else {
        vtFree(hierarchy);
    }
    preparation->build = NULL;
}

bool vtPreparation_Step(vtPreparation* preparation, uint32_t work)
{
    if (preparation == NULL || preparation->scene->meshes == NULL) {
        return true;
    }
    vtScene* scene = preparation->scene;
    while (preparation->mesh < scene->meshCount && preparation->failure.result == vt_ok) {
        vtMesh* mesh = &scene->meshes[preparation->mesh];
        if (mesh->indexCount == 0 || mesh->hierarchy != NULL) {
            ++preparation->mesh;
            continue;
        }
        if (preparation->build == NULL) {
            preparation->build = vtBeginHierarchy(mesh, &preparation->failure);
        }
        if (preparation->build == NULL || !vtHierarchyBuild_Step(preparation->build, work)) {
            break;
        }
        keep(preparation, mesh);
        // Small meshes share a slice.
        const uint32_t done = mesh->indexCount / 3;
        work = work > done ? work - done : 0;
        if (work == 0) {
            break;
        }
    }
    return preparation->mesh >= scene->meshCount || preparation->failure.result != vt_ok;
}

vtResult vtEndPreparation(vtPreparation* preparation, vtError* error)
{
    if (preparation == NULL) {
        return vtFailMissing(error, "vtEndPreparation", "preparation");
    }
    const vtError failure = preparation->failure;
    vtAbandonHierarchy(preparation->build);
    vtFree(preparation);
    return failure.result == vt_ok ? vtSucceed(error) : vtFail(error, failure.result, "%s", failure.message);
}
