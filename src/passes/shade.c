#include "passes/shade.h"

#include "base/error.h"
#include "shaders.h"

#define VT_SHADE_SAMPLERS                                                                                    \
    {                                                                                                        \
        "u_paths", "u_ends", "u_lights", "u_asides", "u_surface", "u_environment", "u_objects", "u_records", \
            "u_objectTree", "u_attributes", "u_images", "u_lighting"                                         \
    }

#define VT_SHADE_OPAQUE_CHUNKS                                                                               \
    &vtChunk_octahedral, &vtChunk_environment, &vtChunk_objects, &vtChunk_optics, &vtChunk_records,          \
        &vtChunk_object_tree, &vtChunk_search_opaque, &vtChunk_lighting, &vtChunk_shading,                   \
        &vtChunk_shade_frag

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
      .fragment = {&vtChunk_with_opaque, VT_SHADE_OPAQUE_CHUNKS},
      .samplers = VT_SHADE_SAMPLERS},
     {.name = "shade opaque",
      .vertex = {&vtChunk_screen_vert},
      .fragment = {&vtChunk_with_opaque, &vtChunk_with_surface, VT_SHADE_OPAQUE_CHUNKS},
      .samplers = VT_SHADE_SAMPLERS}},
};

void vtShadePass_Start(vtShadePass* pass, const vtGL* gl, bool opaque, bool surface, vtProgramList* programs)
{
    vtProgramList_Start(programs, &pass->programs[opaque][surface], gl, &programDefs[opaque][surface]);
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
    const bool opaque = scene->objectCount > scene->glassCount;
    vtBindFramebuffer(gl, pass->framebuffer, pass->radiance.width, pass->radiance.height);
    gl->UseProgram(pass->programs[opaque][inputs->surface != NULL].name);
    // Units as VT_SHADE_SAMPLERS names them.
    const vtTexture* units[] = {&inputs->paths->paths,  &inputs->paths->ends, &inputs->paths->lights,
                                &inputs->paths->asides, inputs->surface,      &inputs->environment->picture,
                                &scene->table,          &scene->records,      &scene->tree,
                                &scene->attributes,     &scene->images,       &inputs->environment->lighting};
    vtBindTextures(gl, units, sizeof units / sizeof units[0]);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

void vtShadePass_Destroy(vtShadePass* pass, const vtGL* gl)
{
    for (int i = 0; i < 4; ++i) {
        vtProgram_Destroy(&pass->programs[i / 2][i % 2], gl);
    }
    vtDestroyFramebuffers(gl, &pass->framebuffer, 1);
    vtTexture_Destroy(&pass->radiance, gl);
    *pass = (vtShadePass){0};
}
