#include "gl/mesh_buffer.h"

#include "base/error.h"

/// Into the buffer that is bound: positions in the space, then normals. False where memory is out.
static bool uploadVertices(const vtGL* gl, const vtMesh* mesh, const vtSpace* space)
{
    const size_t bytes = 3 * sizeof(float) * (size_t)mesh->vertexCount;
    float* positions = vtAllocate(1, bytes);
    if (positions == NULL) {
        return false;
    }
    const float from[3] = {space->origin.x, space->origin.y, space->origin.z};
    for (size_t i = 0; i < 3 * (size_t)mesh->vertexCount; ++i) {
        positions[i] = (mesh->positions[i] - from[i % 3]) * space->unit;
    }
    gl->BufferSubData(GL_ARRAY_BUFFER, 0, (GLsizeiptr)bytes, positions);
    gl->BufferSubData(GL_ARRAY_BUFFER, (GLintptr)bytes, (GLsizeiptr)bytes, mesh->normals);
    vtFree(positions);
    return true;
}

/// Into the buffer that is bound. False where memory is out.
static bool uploadDistances(const vtGL* gl, const vtMesh* mesh, const vtSpace* space)
{
    float* distances = vtAllocate(mesh->vertexCount, sizeof *distances);
    for (size_t i = 0; i < mesh->vertexCount && distances != NULL; ++i) {
        distances[i] = mesh->innerDistances[i] * space->unit;
    }
    const GLsizeiptr bytes = (GLsizeiptr)(sizeof *distances * mesh->vertexCount);
    if (distances != NULL) {
        gl->BufferData(GL_ARRAY_BUFFER, bytes, distances, GL_STATIC_DRAW);
    }
    vtFree(distances);
    return distances != NULL;
}

bool vtMeshBuffer_Update(const vtMeshBuffer* buffer, const vtGL* gl, const vtMesh* mesh, const vtSpace* space)
{
    if (buffer->vertexCount != mesh->vertexCount ||
        (buffer->distances == 0) != (mesh->innerDistances == NULL)) {
        return false;
    }
    if (mesh->innerDistances != NULL) {
        gl->BindBuffer(GL_ARRAY_BUFFER, buffer->distances);
        if (!uploadDistances(gl, mesh, space)) {
            return false;
        }
    }
    gl->BindBuffer(GL_ARRAY_BUFFER, buffer->vertices);
    return uploadVertices(gl, mesh, space);
}

vtResult vtMeshBuffer_Create(vtMeshBuffer* buffer, const vtGL* gl, const vtMesh* mesh, const vtSpace* space,
                             vtError* error)
{
    size_t attributeBytes = 3 * sizeof(float) * (size_t)mesh->vertexCount;
    size_t indexBytes = sizeof(uint32_t) * (size_t)mesh->indexCount;
    *buffer = (vtMeshBuffer){0};
    buffer->indexCount = (GLsizei)mesh->indexCount;
    buffer->vertexCount = mesh->vertexCount;
    buffer->bytes = 2 * attributeBytes + indexBytes;

    gl->GenVertexArrays(1, &buffer->vertexArray);
    gl->BindVertexArray(buffer->vertexArray);
    gl->GenBuffers(1, &buffer->vertices);
    gl->BindBuffer(GL_ARRAY_BUFFER, buffer->vertices);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(2 * attributeBytes), NULL, GL_STATIC_DRAW);
    bool uploaded = uploadVertices(gl, mesh, space);
    gl->EnableVertexAttribArray(0);
    gl->VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, (const void*)0);
    gl->EnableVertexAttribArray(1);
    gl->VertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, 0, (const void*)(uintptr_t)attributeBytes);
    if (mesh->innerDistances != NULL) {
        gl->GenBuffers(1, &buffer->distances);
        gl->BindBuffer(GL_ARRAY_BUFFER, buffer->distances);
        uploaded = uploadDistances(gl, mesh, space) && uploaded;
        gl->EnableVertexAttribArray(2);
        gl->VertexAttribPointer(2, 1, GL_FLOAT, GL_FALSE, 0, (const void*)0);
        buffer->bytes += attributeBytes / 3;
    }
    gl->GenBuffers(1, &buffer->indices);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer->indices);
    gl->BufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)indexBytes, mesh->indices, GL_STATIC_DRAW);
    gl->BindVertexArray(0);

    vtResult result =
        uploaded ? vtCheckGL(gl, "uploading the mesh", error)
                 : vtFail(error, vt_errorMemory, "mesh: out of memory for %u vertices", mesh->vertexCount);
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
