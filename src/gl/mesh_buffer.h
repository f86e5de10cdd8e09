#pragma once

#include "base/space.h"
#include "gl/target.h"

/// A mesh on the GPU: indexed triangles, position at attribute 0, normal at 1, inner distance at 2
/// where the mesh has it.
typedef struct vtMeshBuffer {
    GLuint vertexArray, vertices, distances, indices;
    GLsizei indexCount;
    uint32_t vertexCount;
    size_t bytes;
} vtMeshBuffer;

/// `space`: that of the positions on the GPU.
vtResult vtMeshBuffer_Create(vtMeshBuffer* buffer, const vtGL* gl, const vtMesh* mesh, const vtSpace* space,
                             vtError* error);
/// New positions and normals; false where there are not as many, or inner distances would be of the old ones,
/// or memory is out.
bool vtMeshBuffer_Update(const vtMeshBuffer* buffer, const vtGL* gl, const vtMesh* mesh,
                         const vtSpace* space);
void vtMeshBuffer_Draw(const vtMeshBuffer* buffer, const vtGL* gl);
void vtMeshBuffer_Destroy(vtMeshBuffer* buffer, const vtGL* gl);
