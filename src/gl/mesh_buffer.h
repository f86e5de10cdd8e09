#pragma once

#include "gl/target.h"

/// A mesh on the GPU: indexed triangles, position at attribute 0, normal at 1, inner distance at 2
/// where the mesh has it.
typedef struct vtMeshBuffer {
    GLuint vertexArray, vertices, distances, indices;
    GLsizei indexCount;
    uint32_t firstTriangle; ///< among the triangle records of all meshes
    size_t bytes;
} vtMeshBuffer;

vtResult vtMeshBuffer_Create(vtMeshBuffer* buffer, const vtGL* gl, const vtMesh* mesh, uint32_t firstTriangle,
                             vtError* error);
void vtMeshBuffer_Draw(const vtMeshBuffer* buffer, const vtGL* gl);
void vtMeshBuffer_Destroy(vtMeshBuffer* buffer, const vtGL* gl);
