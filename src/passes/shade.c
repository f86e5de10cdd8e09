#include "passes/shade.h"

#include "base/error.h"
#include "shaders.h"
#include "technique/technique.h"

static vtProgramDef describe(bool opaque, bool surface, bool host)
{
    const vtChunk* const chunks[] = {
        opaque ? &vtChunk_with_opaque : NULL,
        surface ? &vtChunk_with_surface : NULL,
        VT_WITH_HOST && host ? &vtChunk_with_host : NULL,
        &vtChunk_octahedral,
        &vtChunk_environment,
        &vtChunk_objects,
        &vtChunk_optics,
        opaque ? &vtChunk_records : NULL,
        opaque ? &vtChunk_object_tree : NULL,
        opaque ? &vtChunk_search_opaque : NULL,
        opaque ? &vtChunk_lighting : NULL,
        opaque ? &vtChunk_shading : NULL,
        VT_WITH_HOST && host ? &vtChunk_srgb : NULL,
        VT_WITH_HOST && host ? &vtChunk_host_depth : NULL,
        VT_WITH_HOST && host ? &vtChunk_host_picture : NULL,
        &vtChunk_surroundings,
        &vtChunk_shade_frag,
    };
    vtProgramDef def = {.name = "shade", .vertex = {&vtChunk_screen_vert}};
    vtProgramDef_SetFragment(&def, chunks, sizeof chunks / sizeof chunks[0]);
    return def;
}

void vtShadePass_Start(vtShadePass* pass, const vtGL* gl, bool opaque, bool surface, bool host,
                       vtProgramList* programs)
{
    const vtProgramDef def = describe(opaque, surface, host);
    pass->program = vtProgramList_Start(programs, gl, &def);
}

vtResult vtShadePass_Resize(vtShadePass* pass, const vtGL* gl, int width, int height, vtError* error)
{
    if (!vtTexture_Resize(&pass->radiance, gl, GL_RGBA32UI, width, height, 0)) {
        return vtSucceed(error);
    }
    vtAttachment color = {&pass->radiance, 0};
    return vtMakeFramebuffer(gl, "shade", &color, 1, NULL, &pass->framebuffer, error);
}

void vtShadePass_Draw(const vtShadePass* pass, const vtGL* gl, const vtShadeInputs* inputs)
{
    const vtSceneBuffer* scene = inputs->scene;
    vtBindFramebuffer(gl, pass->framebuffer, pass->radiance.width, pass->radiance.height);
    const bool host = VT_WITH_HOST && inputs->host->color != 0;
    gl->UseProgram(pass->program->name);
    const vtPathTargets* paths = inputs->paths;
    const vtEnvironmentBuffer* environment = inputs->environment;
    const vtBinding bindings[] = {
        {vt_samplerPaths, &paths->paths},           {vt_samplerEnds, &paths->ends},
        {vt_samplerLights, &paths->lights},         {vt_samplerAsides, &paths->asides},
        {vt_samplerSurface, inputs->surface},       {vt_samplerEnvironment, &environment->picture},
        {vt_samplerObjects, &scene->table},         {vt_samplerRecords, &scene->geometry.records},
        {vt_samplerObjectTree, &scene->tree},       {vt_samplerAttributes, &scene->geometry.attributes},
        {vt_samplerImages, &scene->images.texture}, {vt_samplerLighting, &environment->lighting},
    };
    vtBindTextures(gl, bindings, sizeof bindings / sizeof bindings[0]);
    if (host) {
        vtHostPicture_Bind(inputs->host, gl);
    }
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    if (host) {
        vtHostPicture_Unbind(inputs->host, gl);
    }
}

void vtShadePass_Destroy(vtShadePass* pass, const vtGL* gl)
{
    vtDestroyFramebuffers(gl, &pass->framebuffer, 1);
    vtTexture_Destroy(&pass->radiance, gl);
    *pass = (vtShadePass){0};
}
