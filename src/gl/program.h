#pragma once

#include "gl/gl.h"

/// A named piece of GLSL without #version, made from shaders_es3/ at build time.
typedef struct vtChunk {
    const char* name;
    const char* source; ///< NULL: it is in vtGL.laterShaders, where a page has loaded those
} vtChunk;

#define VT_MAX_CHUNKS 40
#define VT_MAX_UNIFORMS 6

/// What a program is made of: its chunks in order, after {version, precision, constants, frame}.
typedef struct vtProgramDef {
    const char* name;
    const vtChunk* vertex[VT_MAX_CHUNKS];   ///< NULL-terminated
    const vtChunk* fragment[VT_MAX_CHUNKS]; ///< NULL-terminated
    const char* uniforms[VT_MAX_UNIFORMS];  ///< NULL-terminated; what vtProgram.uniforms holds
} vtProgramDef;

/// The fragment shader's chunks: those of a list that are not NULL, in its order.
void vtProgramDef_SetFragment(vtProgramDef* def, const vtChunk* const* chunks, size_t count);

/// A program in two steps, so that a driver can work at several at once, and the caller at something else:
/// started, nothing of it is asked for; finished, it can be used.
typedef struct vtProgram {
    GLuint name;
    GLuint vertex, fragment; ///< until it is finished
    vtProgramDef def;
    bool finished;
    GLint uniforms[VT_MAX_UNIFORMS]; ///< places of def.uniforms
    struct vtProgram* next;          ///< in a store
} vtProgram;

/// The programs of the renderers that share a context: each is made once, and all go with the last renderer.
typedef struct vtProgramStore {
    vtProgram* first;
    int users;
} vtProgramStore;
/// One user more; NULL: of a new store. NULL where memory is out.
vtProgramStore* vtProgramStore_Join(vtProgramStore* store);
/// One user less; safe on NULL.
void vtProgramStore_Leave(vtProgramStore* store, const vtGL* gl);

/// Hands the sources to the driver. Does nothing where that was done before.
void vtProgram_Start(vtProgram* program, const vtGL* gl, const vtProgramDef* def);
/// Can a started program be finished without waiting? True where the driver cannot tell
/// (KHR_parallel_shader_compile).
bool vtProgram_IsReady(const vtProgram* program, const vtGL* gl);
/// Waits for the driver. Does nothing the second time. On failure the sentence holds the driver's first
/// lines and where the chunks' lines lie, and the program is destroyed.
vtResult vtProgram_Finish(vtProgram* program, const vtGL* gl, vtError* error);
/// The programs of a frame: all are started before the first is waited for.
typedef struct vtProgramList {
    vtProgram* programs[8];
    int count;
    bool lacksShaders; ///< some were not started, for want of vtGL.laterShaders
    bool lacksMemory;  ///< some were not started, for want of memory
} vtProgramList;
/// The program of that definition, from the store; NULL where it cannot be started: then the list is not
/// finished either.
const vtProgram* vtProgramList_Start(vtProgramList* list, const vtGL* gl, const vtProgramDef* def);
bool vtProgramList_IsReady(const vtProgramList* list, const vtGL* gl);
vtResult vtProgramList_Finish(const vtProgramList* list, const vtGL* gl, vtError* error);

/// Safe on a zeroed program; afterwards it can be started again.
void vtProgram_Destroy(vtProgram* program, const vtGL* gl);
