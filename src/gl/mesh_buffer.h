#pragma once

#include "gl/target.h"

/// A mesh on the GPU: indexed triangles, position at attribute 0, normal at 1, inner distance at 2
/// where the mesh has it; and the same triangles as records in a texture (scene/triangles.h).
typedef struct vtMeshBuffer {
    GLuint vertexArray, vertices, distances, indices;
    GLsizei indexCount;
    vtTexture triangles; ///< RGBA32UI, four texels a triangle, VT_TRIANGLES_A_ROW triangles a row
    size_t bytes;
} vtMeshBuffer;

vtResult vtMeshBuffer_Create(vtMeshBuffer* buffer, const vtGL* gl, const vtMesh* mesh, vtError* error);
void vtMeshBuffer_Draw(const vtMeshBuffer* buffer, const vtGL* gl);
void vtMeshBuffer_Destroy(vtMeshBuffer* buffer, const vtGL* gl);
