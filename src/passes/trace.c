#include "passes/trace.h"

#include "base/about.h"
#include "base/error.h"
#include "scene/material.h"
#include "shaders.h"
#include "technique/technique.h"

bool vtTrace_IsRough(const vtSceneBuffer* scene, const vtFrame* frame)
{
    bool rough = false;
    for (uint32_t i = 0; i < scene->glassCount; ++i) {
        rough = rough || vtMaterial_Roughness(&scene->objects[i].material, frame->roughness) > 0.0f;
    }
    return rough && vtTechnique_Row(frame->technique)->traces;
}

bool vtTrace_Disperses(const vtSceneBuffer* scene, const vtFrame* frame)
{
    bool disperses = false;
    for (uint32_t i = 0; i < scene->glassCount; ++i) {
        disperses = disperses || vtMaterial_Dispersion(&scene->objects[i].material, frame->dispersion) > 0.0f;
    }
    return disperses && vtTechnique_Row(frame->technique)->traces;
}

vtTraceVariant vtChooseTraceVariant(const vtSceneBuffer* scene, const vtEnvironmentBuffer* environment,
                                    const vtFrame* frame)
{
    bool any = false, only = true;
    for (uint32_t i = 0; i < scene->objectCount && vtTechnique_Row(frame->technique)->heights; ++i) {
        const bool isRelief = vtSceneBuffer_HasHeights(scene, i);
        any = any || isRelief;
        only = only && isRelief;
    }
    const bool opaque = scene->objectCount > scene->glassCount, looks = scene->hasLooks;
    const bool one = scene->objectCount == 1 && !opaque && !any && !looks && !scene->objects[0].bothSides;
    const bool rough = vtTrace_IsRough(scene, frame);
    const bool spectral = vtTrace_Disperses(scene, frame);
    const bool fan = spectral && frame->wavelengths < VT_MAX_WAVELENGTHS;
    const bool pictures = rough || fan || environment->kind == vt_environmentImage ||
                          ((opaque || looks) && scene->images.texture.width > 1);
    only = only && !looks;
    return (looks ? vt_traceLooks : 0) | (rough ? vt_traceRough : 0) | (spectral ? vt_traceSpectral : 0) |
           (fan ? vt_traceFan : 0) | (pictures ? vt_traceFootprint : 0) | (one ? vt_traceOneObject : 0) |
           (opaque ? vt_traceOpaque : 0) | (any ? vt_traceHeights : 0) |
           (vtFrame_IsOverlay(frame) || vtFrame_HasHost(frame) ? vt_traceHost : 0) |
           (any && only ? vt_traceOnlyHeights : 0) |
           (vtFrame_IsStrict(frame) && !looks && !rough ? vt_traceStrict : 0) |
           (VT_SHADES_LOOKS && opaque && scene->lightCount > 0 ? vt_traceShade : 0) |
           (frame->countReads ? vt_traceCounted : 0);
}

/// `photons`: rays of the ground's lights in place of those from the eye.
static vtProgramDef describe(vtTraceVariant variant, bool photons)
{
    const bool looks = (variant & vt_traceLooks) != 0;
    const bool heights = (variant & vt_traceHeights) != 0, opaque = looks || (variant & vt_traceOpaque) != 0;
    const bool host = VT_WITH_HOST && (variant & vt_traceHost) != 0, rough = (variant & vt_traceRough) != 0;
    const bool strict = (variant & vt_traceStrict) != 0, spectral = (variant & vt_traceSpectral) != 0;
    const bool records = (variant & vt_traceOnlyHeights) == 0, one = (variant & vt_traceOneObject) != 0;
    const bool backdrop = VT_IS_FULL && (variant & vt_traceBackdrop) != 0;
    const bool ground = (variant & vt_traceGround) != 0, shade = (variant & vt_traceShade) != 0;
    const vtChunk* const chunks[] = {
        photons ? &vtChunk_photon_chance : NULL,
        ground ? &vtChunk_with_ground : NULL,
        (variant & vt_traceCounted) != 0 ? &vtChunk_count_reads : NULL,
        (variant & vt_traceStrict) != 0 ? &vtChunk_strict : &vtChunk_keeps_first,
        one ? &vtChunk_one_object : NULL,
        looks ? &vtChunk_with_looks : NULL,
        shade ? &vtChunk_with_shade : NULL,
        opaque ? &vtChunk_with_opaque : NULL,
        rough ? &vtChunk_with_rough : NULL,
        (variant & vt_traceFan) != 0 ? &vtChunk_with_fan : NULL,
        records ? NULL : &vtChunk_only_heights,
        host ? &vtChunk_with_host : NULL,
        backdrop ? &vtChunk_with_backdrop : NULL,
        host ? &vtChunk_with_depth : NULL,
        (variant & vt_traceFootprint) != 0 ? &vtChunk_footprint : NULL,
        &vtChunk_octahedral,
        &vtChunk_media,
        &vtChunk_path,
        &vtChunk_environment,
        &vtChunk_objects,
        &vtChunk_optics,
        strict && !spectral && !shade ? NULL : &vtChunk_chance,
        spectral ? &vtChunk_spectral : NULL,
        rough ? &vtChunk_rough : NULL,
        &vtChunk_cross_surface,
        records || opaque ? &vtChunk_records : NULL,
        one ? NULL : &vtChunk_object_tree,
        heights ? &vtChunk_grid_walk : NULL,
        heights ? &vtChunk_search_heights : NULL,
        &vtChunk_search_scene,
        opaque || rough ? &vtChunk_lighting : NULL,
        shade && ground ? &vtChunk_caustics : NULL,
        shade ? &vtChunk_shade : NULL,
        opaque ? &vtChunk_shading : NULL,
        looks ? &vtChunk_looks : NULL,
        looks ? &vtChunk_cross_look : NULL,
        host ? &vtChunk_srgb : NULL,
        host ? &vtChunk_host_depth : NULL,
        host ? &vtChunk_host_picture : NULL,
        backdrop ? &vtChunk_backdrop : NULL,
        ground ? &vtChunk_ground : NULL,
        &vtChunk_surroundings,
        &vtChunk_trace_frag,
        photons ? &vtChunk_photons_frag : NULL,
    };
    vtProgramDef def = {.name = photons ? "photons" : "trace",
                        .vertex = {&vtChunk_screen_vert},
                        .uniforms = {"u_branches", "u_ground", photons ? "u_groundRays" : "u_groundMatt",
                                     photons ? "u_groundBox" : "u_sun",
                                     photons ? "u_groundLight" : "u_wavelengths",
                                     photons ? "u_groundSeed" : "u_backdropPlace"}};
    vtProgramDef_SetFragment(&def, chunks, sizeof chunks / sizeof chunks[0]);
    return def;
}

vtProgramDef vtTracePhotons(vtTraceVariant variant)
{
    const unsigned ofScene = vt_traceOneObject | vt_traceOpaque | vt_traceHeights | vt_traceOnlyHeights |
                             vt_traceLooks | vt_traceRough | vt_traceSpectral;
    const unsigned footprint = (variant & vt_traceRough) != 0 ? vt_traceFootprint : 0;
    return describe((variant & ofScene) | footprint, true);
}

void vtTracePass_Start(vtTracePass* pass, const vtGL* gl, vtTraceVariant variant, vtProgramList* programs)
{
    const vtProgramDef def = describe(variant, false);
    pass->program = vtProgramList_Start(programs, gl, &def);
}

vtResult vtTracePass_Resize(vtTracePass* pass, const vtGL* gl, vtTraceVariant variant, int width, int height,
                            vtError* error)
{
    const bool host = VT_WITH_HOST && (variant & vt_traceHost) != 0;
    bool changed = vtTexture_Resize(&pass->paths, gl, GL_RGBA32UI, width, height, 0);
    changed |= vtTexture_Resize(&pass->radiance, gl, GL_RGBA32UI, width, height, 0);
    if (changed) { // what they hold is gone
        vtDestroyFramebuffers(gl, pass->framebuffers, 2);
    }
    if (host && vtTexture_Resize(&pass->depths, gl, GL_R32UI, width, height, 0)) {
        vtDestroyFramebuffers(gl, &pass->framebuffers[1], 1);
    }
    if (pass->framebuffers[host] != 0) {
        return vtSucceed(error);
    }
    const vtAttachment colors[] = {{&pass->paths, 0}, {&pass->radiance, 0}, {&pass->depths, 0}};
    return vtMakeFramebuffer(gl, "trace", colors, host ? 3 : 2, NULL, &pass->framebuffers[host], error);
}

void vtBindTraced(const vtGL* gl, const vtSceneBuffer* scene, const vtEnvironmentBuffer* environment)
{
    const vtHeightTexture* heights = vtSceneBuffer_Heights(scene);
    const vtBinding bindings[] = {
        {vt_samplerObjects, &scene->table},
        {vt_samplerRecords, &scene->geometry.records},
        {vt_samplerObjectTree, &scene->tree},
        {vt_samplerEnvironment, &environment->picture},
        {vt_samplerAttributes, &scene->geometry.attributes},
        {vt_samplerImages, &scene->images.texture},
        {vt_samplerMaterials, &scene->looks},
        {vt_samplerLighting, &environment->lighting},
        {vt_samplerHeights, heights != NULL ? &heights->heights : NULL},
        {vt_samplerHeightRanges, heights != NULL ? &heights->ranges : NULL},
    };
    vtBindTextures(gl, bindings, sizeof bindings / sizeof bindings[0]);
}

void vtTracePass_Draw(const vtTracePass* pass, const vtGL* gl, vtTraceVariant variant,
                      const vtTraceInputs* inputs)
{
    const vtProgram* program = pass->program;
    const bool host = VT_WITH_HOST && (variant & vt_traceHost) != 0;
    vtBindFramebuffer(gl, pass->framebuffers[host], pass->paths.width, pass->paths.height);
    gl->UseProgram(program->name);
    gl->Uniform1i(program->uniforms[0], inputs->branches);
    if ((variant & vt_traceSpectral) != 0) {
        gl->Uniform1i(program->uniforms[4], inputs->wavelengths);
    }
    vtBindTraced(gl, inputs->scene, inputs->environment);
    if ((variant & vt_traceGround) != 0) {
        gl->Uniform4fv(program->uniforms[1], 1, inputs->ground->place);
        gl->Uniform4fv(program->uniforms[2], 2, inputs->ground->matt);
        vtTexture_Bind(&inputs->ground->map, gl, vt_samplerGround);
    }
    if ((variant & vt_traceShade) != 0) {
        gl->Uniform4fv(program->uniforms[3], 4, inputs->sun);
        if ((variant & vt_traceGround) != 0) {
            vtTexture_Bind(&inputs->ground->caustics, gl, vt_samplerCaustics);
        }
    }
    if (VT_IS_FULL && (variant & vt_traceBackdrop) != 0) {
        gl->Uniform4fv(program->uniforms[5], 3, inputs->backdropPlace->plane);
        vtTexture_Bind(inputs->backdrop, gl, vt_samplerBackdrop);
    }
    if (host) {
        vtHostPicture_Bind(inputs->host, gl);
    }
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    if (host) {
        vtHostPicture_Unbind(inputs->host, gl);
    }
}

void vtTracePass_Destroy(vtTracePass* pass, const vtGL* gl)
{
    vtDestroyFramebuffers(gl, pass->framebuffers, 2);
    vtTexture_Destroy(&pass->paths, gl);
    vtTexture_Destroy(&pass->radiance, gl);
    vtTexture_Destroy(&pass->depths, gl);
    *pass = (vtTracePass){0};
}

size_t vtTracePass_Bytes(const vtTracePass* pass)
{
    return vtTexture_Bytes(&pass->paths) + vtTexture_Bytes(&pass->radiance) + vtTexture_Bytes(&pass->depths);
}
