#include "passes/shade.h"

#include <stdlib.h>

#include "base/error.h"
#include "gl/lighting_texture.h"
#include "shaders.h"

#define VT_SHADE_SAMPLERS                                                                                    \
    {                                                                                                        \
        "u_paths", "u_ends", "u_lights", "u_asides", "u_surface", "u_environment", "u_objects",              \
            "u_triangles", "u_cubeSurfaces", "u_cubeTriangles", "u_intervals", "u_cubeColumns",              \
            "u_attributes", "u_images", "u_lighting", "u_before"                                             \
    }

// By whether there is something opaque, and a first surface.
static const vtProgramDef programDefs[2][2] = {
    {{.name = "shade blended",
      .vertex = {&vtChunk_screen_vert},
      .fragment = {&vtChunk_octahedral, &vtChunk_environment, &vtChunk_objects, &vtChunk_optics,
                   &vtChunk_shade_frag},
      .samplers = VT_SHADE_SAMPLERS},
     {.name = "shade",
      .vertex = {&vtChunk_screen_vert},
      .fragment = {&vtChunk_with_surface, &vtChunk_octahedral, &vtChunk_environment, &vtChunk_objects,
                   &vtChunk_optics, &vtChunk_shade_frag},
      .samplers = VT_SHADE_SAMPLERS}},
    {{.name = "shade opaque blended",
      .vertex = {&vtChunk_screen_vert},
      .fragment = {&vtChunk_with_opaque, &vtChunk_octahedral, &vtChunk_environment, &vtChunk_objects,
                   &vtChunk_optics, &vtChunk_triangles, &vtChunk_cube, &vtChunk_walk_mesh, &vtChunk_grid_walk,
                   &vtChunk_search_exact, &vtChunk_search_opaque, &vtChunk_lighting, &vtChunk_shading,
                   &vtChunk_shade_frag},
      .samplers = VT_SHADE_SAMPLERS},
     {.name = "shade opaque",
      .vertex = {&vtChunk_screen_vert},
      .fragment = {&vtChunk_with_opaque, &vtChunk_with_surface, &vtChunk_octahedral, &vtChunk_environment,
                   &vtChunk_objects, &vtChunk_optics, &vtChunk_triangles, &vtChunk_cube, &vtChunk_walk_mesh,
                   &vtChunk_grid_walk, &vtChunk_search_exact, &vtChunk_search_opaque, &vtChunk_lighting,
                   &vtChunk_shading, &vtChunk_shade_frag},
      .samplers = VT_SHADE_SAMPLERS}},
};

vtResult vtShadePass_Create(vtShadePass* pass, const vtGL* gl, vtError* error)
{
    *pass = (vtShadePass){0};
    vtTexture_Resize(&pass->environment, gl, GL_RGB16F, 1, 1, 0);
    return vtCheckGL(gl, "creating the environment", error);
}

/// A copy whose picture, if it has one, is at most 512 wide: enough for light on surfaces.
static vtResult shrinkEnvironment(const vtEnvironment* environment, vtEnvironment* shrunk, vtError* error)
{
    *shrunk = *environment;
    if (environment->kind != vt_environmentImage) {
        return vt_ok;
    }
    const int factor = (environment->width + 511) / 512;
    shrunk->width = environment->width / factor;
    shrunk->height = environment->height / factor > 0 ? environment->height / factor : 1;
    shrunk->pixels = calloc((size_t)shrunk->width * (size_t)shrunk->height, 3 * sizeof(float));
    if (shrunk->pixels == NULL) {
        return vtFail(error, vt_errorMemory, "environment: out of memory");
    }
    const int down = environment->height < factor ? environment->height : factor;
    for (int y = 0; y < shrunk->height * down; ++y) {
        for (int x = 0; x < shrunk->width * factor; ++x) {
            const float* from =
                environment->pixels + 3 * ((size_t)y * (size_t)environment->width + (size_t)x);
            float* to =
                shrunk->pixels + 3 * ((size_t)(y / down) * (size_t)shrunk->width + (size_t)(x / factor));
            for (int k = 0; k < 3; ++k) {
                to[k] += from[k] / (float)(factor * down);
            }
        }
    }
    return vt_ok;
}

vtResult vtShadePass_SetEnvironment(vtShadePass* pass, const vtGL* gl, const vtEnvironment* environment,
                                    vtError* error)
{
    bool isImage = environment->kind == vt_environmentImage;
    int width = isImage ? environment->width : 1, height = isImage ? environment->height : 1;
    GLint largest = 0;
    gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (width > largest || height > largest) {
        return vtFail(
            error, vt_errorContext,
            "environment: %d x %d is more than this GPU's largest texture (%d); scale the picture down",
            width, height, largest);
    }
    vtTexture fresh = {0};
    vtTexture_Resize(&fresh, gl, GL_RGB16F, width, height, 0);
    if (isImage) {
        gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGB, GL_FLOAT, environment->pixels);
    }
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    vtResult result = vtCheckGL(gl, "uploading the environment", error);
    if (result != vt_ok) {
        vtTexture_Destroy(&fresh, gl);
        return result;
    }
    vtEnvironment light;
    result = shrinkEnvironment(environment, &light, error);
    if (result != vt_ok) {
        vtTexture_Destroy(&fresh, gl);
        return result;
    }
    vtTexture_Destroy(&pass->environment, gl);
    vtTexture_Destroy(&pass->lighting, gl);
    vtDestroyEnvironment(&pass->light);
    pass->environment = fresh;
    pass->light = light;
    return vt_ok;
}

vtResult vtShadePass_Prepare(vtShadePass* pass, const vtGL* gl, int width, int height, bool opaque,
                             bool surface, bool branches, vtError* error)
{
    vtResult result = vtSucceed(error);
    vtShadeProgram* program = &pass->programs[opaque][surface];
    if (program->name == 0) {
        result = vtCreateProgram(gl, &programDefs[opaque][surface], &program->name, error);
        program->branch = gl->GetUniformLocation(program->name, "u_branch");
        program->branches = gl->GetUniformLocation(program->name, "u_branches");
    }
    for (int i = 0; i < 1 + branches && result == vt_ok; ++i) {
        if (vtTexture_Resize(&pass->radiances[i], gl, GL_RG32UI, width, height, 0)) {
            vtAttachment color = {&pass->radiances[i], 0};
            result = vtMakeFramebuffer(gl, "shade", &color, 1, NULL, &pass->framebuffers[i], error);
        }
    }
    if (result == vt_ok && opaque && pass->lighting.name == 0) {
        vtLighting lighting;
        result = vtCreateLighting(&pass->light, &lighting, error);
        if (result == vt_ok) {
            result = vtLightingTexture_Upload(&pass->lighting, gl, &lighting, error);
            vtDestroyLighting(&lighting);
        }
    }
    return result;
}

void vtShadePass_Draw(const vtShadePass* pass, const vtGL* gl, const vtShadeInputs* inputs)
{
    const vtSceneBuffer* scene = inputs->scene;
    const bool opaque = scene->objectCount > scene->glassCount;
    const vtShadeProgram* program = &pass->programs[opaque][inputs->surface != NULL];
    const vtTexture* radiance = vtShadePass_Light(pass, inputs->branch);
    vtBindFramebuffer(gl, pass->framebuffers[inputs->branch % 2], radiance->width, radiance->height);
    gl->UseProgram(program->name);
    gl->Uniform1i(program->branch, inputs->branch);
    gl->Uniform1i(program->branches, inputs->branches);
    // Units as VT_SHADE_SAMPLERS names them.
    const vtTexture* units[] = {&inputs->paths->paths,
                                &inputs->paths->ends,
                                &inputs->paths->lights,
                                &inputs->paths->asides,
                                inputs->surface,
                                &pass->environment,
                                &scene->table,
                                &scene->triangles,
                                &inputs->cube->surfaces,
                                &inputs->cube->triangles,
                                &inputs->cube->intervals,
                                &inputs->cube->columns,
                                &scene->attributes,
                                &scene->images,
                                &pass->lighting,
                                inputs->branch > 0 ? vtShadePass_Light(pass, inputs->branch - 1)
                                                   : &inputs->paths->paths}; // WebGL: not what is drawn to
    for (int unit = 0; unit < (int)(sizeof units / sizeof units[0]); ++unit) {
        if (units[unit] != NULL && units[unit]->name != 0) {
            vtTexture_Bind(units[unit], gl, unit);
        }
    }
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

const vtTexture* vtShadePass_Light(const vtShadePass* pass, int branch)
{
    return &pass->radiances[branch % 2];
}

void vtShadePass_Destroy(vtShadePass* pass, const vtGL* gl)
{
    for (int i = 0; i < 4; ++i) {
        gl->DeleteProgram(pass->programs[i / 2][i % 2].name);
    }
    vtDestroyFramebuffers(gl, pass->framebuffers, 2);
    vtTexture_Destroy(&pass->environment, gl);
    vtTexture_Destroy(&pass->lighting, gl);
    vtTexture_Destroy(&pass->radiances[0], gl);
    vtTexture_Destroy(&pass->radiances[1], gl);
    vtDestroyEnvironment(&pass->light);
    *pass = (vtShadePass){0};
}

size_t vtShadePass_Bytes(const vtShadePass* pass)
{
    return vtTexture_Bytes(&pass->environment) + vtTexture_Bytes(&pass->lighting) +
           vtTexture_Bytes(&pass->radiances[0]) + vtTexture_Bytes(&pass->radiances[1]);
}
