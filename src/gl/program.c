#include "gl/program.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "gl/target.h"
#include "gl/uniforms.h"
#include "shaders.h"

// Nothing, not even a comment, may stand before #version. Every default precision is spelled out since
// ES has none for integer and array samplers.
static const vtChunk header = {"header", "#version 300 es\n"
                                         "precision highp float;\n"
                                         "precision highp int;\n"
                                         "precision highp sampler2D;\n"
                                         "precision highp sampler2DArray;\n"
                                         "precision highp usampler2D;\n"
                                         "precision highp usampler2DArray;\n"};

static const char* const samplerNames[vt_samplerCount] = {
    [vt_samplerSurface] = "u_surface",
    [vt_samplerInnerDistances] = "u_innerDistances",
    [vt_samplerLayerDepths] = "u_layerDepths",
    [vt_samplerLayerNormals] = "u_layerNormals",
    [vt_samplerMergedDepths] = "u_mergedDepths",
    [vt_samplerPreviousDepth] = "u_previousDepth",
    [vt_samplerObjects] = "u_objects",
    [vt_samplerRecords] = "u_records",
    [vt_samplerObjectTree] = "u_objectTree",
    [vt_samplerAttributes] = "u_attributes",
    [vt_samplerImages] = "u_images",
    [vt_samplerMaterials] = "u_materials",
    [vt_samplerHeights] = "u_heights",
    [vt_samplerHeightRanges] = "u_heightRanges",
    [vt_samplerEnvironment] = "u_environment",
    [vt_samplerLighting] = "u_lighting",
    [vt_samplerPaths] = "u_paths",
    [vt_samplerEnds] = "u_ends",
    [vt_samplerLights] = "u_lights",
    [vt_samplerAsides] = "u_asides",
    [vt_samplerRadiance] = "u_radiance",
    [vt_samplerSum] = "u_sum",
    [vt_samplerDepths] = "u_depths",
    [vt_samplerHostColor] = "u_hostColor",
    [vt_samplerHostDepth] = "u_hostDepth",
    [vt_samplerBackground] = "u_background",
    [vt_samplerBackdrop] = "u_backdrop",
    [vt_samplerGround] = "u_groundMap",
    [vt_samplerGroundLights] = "u_groundLights",
    [vt_samplerCaustics] = "u_caustics",
};

void vtProgramDef_SetFragment(vtProgramDef* def, const vtChunk* const* chunks, size_t count)
{
    int used = 0;
    for (size_t i = 0; i < count; ++i) {
        if (chunks[i] != NULL) {
            def->fragment[used++] = chunks[i];
        }
    }
}

/// A chunk's text; NULL where it is still to be loaded.
static const char* findText(const vtGL* gl, const vtChunk* chunk)
{
    const char* name = gl->laterShaders;
    const char* text = chunk->source;
    while (text == NULL && name != NULL && *name != '\0') {
        const char* after = name + strlen(name) + 1;
        text = strcmp(name, chunk->name) == 0 ? after : NULL;
        name = after + strlen(after) + 1;
    }
    return text;
}

static bool hasTexts(const vtGL* gl, const vtChunk* const* chunks)
{
    bool all = true;
    for (int i = 0; i < VT_MAX_CHUNKS && chunks[i] != NULL; ++i) {
        all = all && findText(gl, chunks[i]) != NULL;
    }
    return all;
}

static int countLines(const char* text)
{
    int lines = 0;
    for (; *text != '\0'; ++text) {
        lines += *text == '\n';
    }
    return lines;
}

/// Those that stand before every source, and the program's own.
static int collectChunks(const vtChunk* const* chunks, const vtChunk** all)
{
    int count = 0;
    all[count++] = &header;
    all[count++] = &vtChunk_vitrine_limits;
    all[count++] = &vtChunk_constants;
    all[count++] = &vtChunk_frame;
    for (int i = 0; i < VT_MAX_CHUNKS && chunks[i] != NULL; ++i) {
        all[count++] = chunks[i];
    }
    return count;
}

/// "peel.frag: lines 1-7 header, 8-30 constants, ..." so that a driver's line number can be found.
static void describeChunks(const vtGL* gl, const vtChunk* const* chunks, int count, char* text, size_t size)
{
    int line = 1;
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < count && used < size; ++i) {
        int lines = countLines(findText(gl, chunks[i]));
        int n = snprintf(text + used, size - used, "%s%s %d-%d", i > 0 ? ", " : "", chunks[i]->name, line,
                         line + lines - 1);
        used += n > 0 ? (size_t)n : 0;
        line += lines;
    }
}

/// Errors are one sentence: line ends become blanks, those at the end go.
static void makeOneLine(char* text)
{
    size_t length = strlen(text);
    while (length > 0 && (text[length - 1] == '\n' || text[length - 1] == ' ')) {
        text[--length] = '\0';
    }
    for (size_t i = 0; i < length; ++i) {
        text[i] = text[i] == '\n' ? ' ' : text[i];
    }
}

static GLuint compile(const vtGL* gl, GLenum stage, const vtChunk* const* chunks)
{
    const vtChunk* all[VT_MAX_CHUNKS + 3];
    const char* sources[VT_MAX_CHUNKS + 3];
    const int count = collectChunks(chunks, all);
    for (int i = 0; i < count; ++i) {
        sources[i] = findText(gl, all[i]);
    }
    const GLuint shader = gl->CreateShader(stage);
    gl->ShaderSource(shader, count, sources, NULL);
    gl->CompileShader(shader);
    return shader;
}

static vtResult checkShader(const vtGL* gl, GLuint shader, const char* stage, const char* name,
                            const vtChunk* const* chunks, vtError* error)
{
    GLint compiled = 0;
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled) {
        return vt_ok;
    }
    char log[256] = "", where[480];
    const vtChunk* all[VT_MAX_CHUNKS + 3];
    gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
    makeOneLine(log);
    describeChunks(gl, all, collectChunks(chunks, all), where, sizeof where);
    return vtFail(error, vt_errorContext, "GL: the %s shader of '%s' does not compile: %s (lines: %s)", stage,
                  name, log, where);
}

void vtProgram_Start(vtProgram* program, const vtGL* gl, const vtProgramDef* def)
{
    if (program->name != 0) {
        return;
    }
    program->def = *def;
    program->name = gl->CreateProgram();
    program->vertex = compile(gl, GL_VERTEX_SHADER, def->vertex);
    program->fragment = compile(gl, GL_FRAGMENT_SHADER, def->fragment);
    gl->AttachShader(program->name, program->vertex);
    gl->AttachShader(program->name, program->fragment);
    gl->LinkProgram(program->name);
}

bool vtProgram_IsReady(const vtProgram* program, const vtGL* gl)
{
    GLint complete = 1;
    if (gl->parallelCompile && !program->finished) {
        gl->GetProgramiv(program->name, 0x91B1, &complete); // GL_COMPLETION_STATUS_KHR
    }
    return complete != 0;
}

static vtResult checkProgram(const vtProgram* program, const vtGL* gl, vtError* error)
{
    const vtProgramDef* def = &program->def;
    GLint linked = 0;
    gl->GetProgramiv(program->name, GL_LINK_STATUS, &linked);
    if (linked) {
        return vt_ok;
    }
    vtResult result = checkShader(gl, program->vertex, "vertex", def->name, def->vertex, error);
    if (result == vt_ok) {
        result = checkShader(gl, program->fragment, "fragment", def->name, def->fragment, error);
    }
    if (result == vt_ok) {
        char log[256] = "";
        gl->GetProgramInfoLog(program->name, sizeof log, NULL, log);
        makeOneLine(log);
        result = vtFail(error, vt_errorContext, "GL: program '%s' does not link: %s", def->name, log);
    }
    return result;
}

vtResult vtProgram_Finish(vtProgram* program, const vtGL* gl, vtError* error)
{
    if (program->finished) {
        return vtSucceed(error);
    }
    const vtProgramDef* def = &program->def;
    const vtResult result = checkProgram(program, gl, error);
    gl->DeleteShader(program->vertex);
    gl->DeleteShader(program->fragment);
    program->vertex = program->fragment = 0;
    if (result != vt_ok) {
        vtProgram_Destroy(program, gl);
        return result;
    }
    program->finished = true;
    const GLuint block = gl->GetUniformBlockIndex(program->name, "Frame");
    if (block != GL_INVALID_INDEX) {
        gl->UniformBlockBinding(program->name, block, VT_FRAME_BINDING);
    }
    gl->UseProgram(program->name);
    for (int sampler = vt_samplerNone + 1; sampler < vt_samplerCount; ++sampler) { // -1 is passed over
        gl->Uniform1i(gl->GetUniformLocation(program->name, samplerNames[sampler]), sampler);
    }
    for (int i = 0; i < VT_MAX_UNIFORMS && def->uniforms[i] != NULL; ++i) {
        program->uniforms[i] = gl->GetUniformLocation(program->name, def->uniforms[i]);
    }
    return vtSucceed(error);
}

void vtProgram_Destroy(vtProgram* program, const vtGL* gl)
{
    if (program->name != 0) {
        gl->DeleteShader(program->vertex); // 0 is passed over
        gl->DeleteShader(program->fragment);
        gl->DeleteProgram(program->name);
    }
    *program = (vtProgram){.def = program->def, .next = program->next};
}

vtProgramStore* vtProgramStore_Join(vtProgramStore* store)
{
    store = store != NULL ? store : vtAllocateZeroed(1, sizeof *store);
    if (store != NULL) {
        ++store->users;
    }
    return store;
}

void vtProgramStore_Leave(vtProgramStore* store, const vtGL* gl)
{
    if (store == NULL || --store->users > 0) {
        return;
    }
    while (store->first != NULL) {
        vtProgram* program = store->first;
        store->first = program->next;
        vtProgram_Destroy(program, gl);
        vtFree(program);
    }
    vtFree(store);
}

/// The same chunks and uniforms: definitions are pointers only, and what is not used of them is NULL.
static vtProgram* findProgram(vtProgramStore* store, const vtProgramDef* def)
{
    vtProgram* program = store->first;
    while (program != NULL && memcmp(&program->def, def, sizeof *def) != 0) {
        program = program->next;
    }
    if (program == NULL) {
        program = vtAllocateZeroed(1, sizeof *program);
        if (program != NULL) {
            *program = (vtProgram){.def = *def, .next = store->first};
            store->first = program;
        }
    }
    return program;
}

const vtProgram* vtProgramList_Start(vtProgramList* list, const vtGL* gl, const vtProgramDef* def)
{
    assert(list->count < (int)(sizeof list->programs / sizeof list->programs[0]));
    if (!hasTexts(gl, def->vertex) || !hasTexts(gl, def->fragment)) {
        list->lacksShaders = true;
        return NULL;
    }
    vtProgram* program = findProgram(gl->programs, def);
    if (program == NULL) {
        list->lacksMemory = true;
        return NULL;
    }
    vtProgram_Start(program, gl, def);
    list->programs[list->count++] = program;
    return program;
}

bool vtProgramList_IsReady(const vtProgramList* list, const vtGL* gl)
{
    bool ready = !list->lacksShaders;
    for (int i = 0; i < list->count; ++i) {
        ready = ready && vtProgram_IsReady(list->programs[i], gl);
    }
    return ready;
}

vtResult vtProgramList_Finish(const vtProgramList* list, const vtGL* gl, vtError* error)
{
    vtResult result = list->lacksShaders  ? vtFail(error, vt_errorContext,
                                                   "GL: the shaders of this picture are still to be loaded")
                      : list->lacksMemory ? vtFail(error, vt_errorMemory, "GL: out of memory for a program")
                                          : vtSucceed(error);
    for (int i = 0; i < list->count && result == vt_ok; ++i) {
        result = vtProgram_Finish(list->programs[i], gl, error);
    }
    return result;
}
