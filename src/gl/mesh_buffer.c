#include "gl/mesh_buffer.h"

#include "base/error.h"

vtResult vtMeshBuffer_Create(vtMeshBuffer* buffer, const vtGL* gl, const vtMesh* mesh, uint32_t firstTriangle,
                             vtError* error)
{
    size_t attributeBytes = 3 * sizeof(float) * (size_t)mesh->vertexCount;
    size_t indexBytes = sizeof(uint32_t) * (size_t)mesh->indexCount;
    *buffer = (vtMeshBuffer){0};
    buffer->indexCount = (GLsizei)mesh->indexCount;
    buffer->firstTriangle = firstTriangle;
    buffer->bytes = 2 * attributeBytes + indexBytes;

    gl->GenVertexArrays(1, &buffer->vertexArray);
    gl->BindVertexArray(buffer->vertexArray);
    gl->GenBuffers(1, &buffer->vertices);
    gl->BindBuffer(GL_ARRAY_BUFFER, buffer->vertices);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(2 * attributeBytes), NULL, GL_STATIC_DRAW);
    gl->BufferSubData(GL_ARRAY_BUFFER, 0, (GLsizeiptr)attributeBytes, mesh->positions);
    gl->BufferSubData(GL_ARRAY_BUFFER, (GLintptr)attributeBytes, (GLsizeiptr)attributeBytes, mesh->normals);
    gl->EnableVertexAttribArray(0);
    gl->VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, (const void*)0);
    gl->EnableVertexAttribArray(1);
    gl->VertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, 0, (const void*)(uintptr_t)attributeBytes);
    if (mesh->innerDistances != NULL) {
        gl->GenBuffers(1, &buffer->distances);
        gl->BindBuffer(GL_ARRAY_BUFFER, buffer->distances);
        gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(attributeBytes / 3), mesh->innerDistances,
                       GL_STATIC_DRAW);
        gl->EnableVertexAttribArray(2);
        gl->VertexAttribPointer(2, 1, GL_FLOAT, GL_FALSE, 0, (const void*)0);
        buffer->bytes += attributeBytes / 3;
    }
    gl->GenBuffers(1, &buffer->indices);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer->indices);
    gl->BufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)indexBytes, mesh->indices, GL_STATIC_DRAW);
    gl->BindVertexArray(0);

    vtResult result = vtCheckGL(gl, "uploading the mesh", error);
    if (result != vt_ok) {
        vtMeshBuffer_Destroy(buffer, gl);
    }
    return result;
}

void vtMeshBuffer_Draw(const vtMeshBuffer* buffer, const vtGL* gl)
{
    gl->BindVertexArray(buffer->vertexArray);
    gl->DrawElements(GL_TRIANGLES, buffer->indexCount, GL_UNSIGNED_INT, (const void*)0);
    gl->BindVertexArray(0);
}

void vtMeshBuffer_Destroy(vtMeshBuffer* buffer, const vtGL* gl)
{
    if (buffer->vertexArray != 0) {
        gl->DeleteVertexArrays(1, &buffer->vertexArray);
        gl->DeleteBuffers(1, &buffer->vertices);
        gl->DeleteBuffers(1, &buffer->distances);
        gl->DeleteBuffers(1, &buffer->indices);
    }
    *buffer = (vtMeshBuffer){0};
}
