#include "gl/bvh_buffer.h"

#include <stdlib.h>

#include "base/error.h"
#include "scene/bvh_records.h"
#include "scene/triangles.h"

/// The triangle records, allocated by malloc.
static vtResult readTriangles(const vtGL* gl, const vtTexture* texture, uint32_t** records, vtError* error)
{
    *records = malloc(vtTexture_Bytes(texture));
    if (*records == NULL) {
        return vtFail(error, vt_errorMemory, "bvh: out of memory for the triangles");
    }
    GLuint framebuffer = 0;
    vtResult result =
        vtMakeFramebuffer(gl, "triangles", &(vtAttachment){texture, 0}, 1, NULL, &framebuffer, error);
    if (result == vt_ok) {
        gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
        gl->ReadPixels(0, 0, texture->width, texture->height, GL_RGBA_INTEGER, GL_UNSIGNED_INT, *records);
        result = vtCheckGL(gl, "reading triangles back", error);
    }
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
    vtDestroyFramebuffers(gl, &framebuffer, 1);
    if (result != vt_ok) {
        free(*records);
        *records = NULL;
    }
    return result;
}

/// Uploads `count` things of so many texels.
static vtResult uploadRows(vtTexture* texture, const vtGL* gl, const uint32_t* words, uint32_t count,
                           int texels, int things, vtError* error)
{
    GLint largest = 0;
    gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if ((int)count / things + 1 > largest || things * texels > largest) {
        return vtFail(error, vt_errorContext,
                      "bvh: the mesh has more triangles than this GPU can hold in a hierarchy; simplify it");
    }
    vtTexture_UploadRecords(texture, gl, words, (int)count, texels, things);
    return vt_ok;
}

vtResult vtBvhBuffer_Create(vtBvhBuffer* buffer, const vtGL* gl, const vtTexture* triangles, uint32_t count,
                            vtVec3 boundsMin, vtVec3 boundsMax, vtError* error)
{
    *buffer = (vtBvhBuffer){0};
    uint32_t* read = NULL;
    vtBvhRecords records = {0};
    vtResult result = readTriangles(gl, triangles, &read, error);
    if (result == vt_ok && !vtCreateBvhRecords(read, count, boundsMin, boundsMax, &records)) {
        result = vtFail(error, vt_errorMemory, "bvh: out of memory for %u triangles", count);
    }
    free(read);
    if (result == vt_ok) {
        result =
            uploadRows(&buffer->nodes, gl, records.nodes, records.nodeCount, 2, VT_BVH_NODES_A_ROW, error);
    }
    if (result == vt_ok) {
        result =
            uploadRows(&buffer->triangles, gl, records.triangles, count, 3, VT_BVH_TRIANGLES_A_ROW, error);
    }
    if (result == vt_ok) {
        result = vtCheckGL(gl, "uploading the hierarchy", error);
    }
    vtDestroyBvhRecords(&records);
    if (result != vt_ok) {
        vtBvhBuffer_Destroy(buffer, gl);
    }
    return result;
}

void vtBvhBuffer_Destroy(vtBvhBuffer* buffer, const vtGL* gl)
{
    vtTexture_Destroy(&buffer->nodes, gl);
    vtTexture_Destroy(&buffer->triangles, gl);
}
