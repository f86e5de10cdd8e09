#include "passes/ground_caustics.h"

#include <string.h>

#include "base/error.h"
#include "base/memory.h"

bool vtKeepLanding(vtCaustics* caustics, const uint32_t* words, vtVec3 flux)
{
    return vtCaustics_Add(caustics, &(vtCausticHit){.object = words[3] >> 20,
                                                    .triangle = words[0],
                                                    .u = (float)(words[1] & 0xffffu) / 65535.0f,
                                                    .v = (float)(words[1] >> 16) / 65535.0f,
                                                    .behind = (words[3] & 0x80000u) != 0,
                                                    .flux = flux});
}

/// The records of the scene's triangles, back from the GPU.
typedef struct Triangles {
    const vtSceneBuffer* scene;
    uint32_t* records;
} Triangles;

static void cornersOf(const void* data, uint32_t object, uint32_t triangle, vtVec3 p[3])
{
    const Triangles* all = data;
    const uint32_t* record = all->records + VT_RECORD_WORDS * (size_t)(triangle / 2);
    const vtTransform* toWorld = &all->scene->objects[object].placed.toWorld;
    const uint32_t corners[3] = {0, 1 + triangle % 2, 2 + triangle % 2};
    for (int k = 0; k < 3; ++k) {
        vtVec3 own;
        memcpy(&own, record + 4 * corners[k], sizeof own);
        p[k] = vtTransformPoint(toWorld, own);
    }
}

static vtResult readRecords(Triangles* all, const vtGL* gl, vtError* error)
{
    const vtTexture* records = &all->scene->geometry.records;
    GLuint framebuffer = 0;
    all->records = vtAllocate((size_t)records->width * (size_t)records->height, 4 * sizeof *all->records);
    if (all->records == NULL) {
        return vtFail(error, vt_errorMemory, "ground: out of memory for triangles");
    }
    const vtResult result =
        vtMakeFramebuffer(gl, "records", &(vtAttachment){records, 0}, 1, NULL, &framebuffer, error);
    if (result == vt_ok) {
        gl->ReadBuffer(GL_COLOR_ATTACHMENT0);
        gl->ReadPixels(0, 0, records->width, records->height, GL_RGBA_INTEGER, GL_UNSIGNED_INT, all->records);
    }
    vtDestroyFramebuffers(gl, &framebuffer, 1);
    return result;
}

vtResult vtGatherLandings(const vtCaustics* caustics, const vtGL* gl, const vtSceneBuffer* scene,
                          float spacing, vtCausticMap* map, vtError* error)
{
    *map = (vtCausticMap){0};
    if (caustics->count == 0) {
        return vtSucceed(error);
    }
    Triangles all = {.scene = scene};
    vtResult result = readRecords(&all, gl, error);
    if (result == vt_ok && !vtCaustics_Gather(caustics, spacing, &(vtCornersOf){cornersOf, &all}, map)) {
        result = vtFail(error, vt_errorMemory, "ground: out of memory for light on opaque things");
    }
    vtFree(all.records);
    return result;
}
