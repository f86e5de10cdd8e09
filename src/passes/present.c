#include "passes/present.h"

#include "base/error.h"
#include "shaders.h"

static const vtProgramDef programDef = {
    .name = "present",
    .vertex = {&vtChunk_screen_vert},
    .fragment = {&vtChunk_octahedral, &vtChunk_environment, &vtChunk_picture_light, &vtChunk_srgb,
                 &vtChunk_present_frag},
    .samplers = {"u_paths", "u_light", "u_environment", "u_layerDepths", "u_layerNormals"},
};

vtResult vtPresentPass_Create(vtPresentPass* pass, const vtGL* gl, vtError* error)
{
    *pass = (vtPresentPass){0};
    vtTexture_Resize(&pass->environment, gl, GL_RGB16F, 1, 1, 0);
    return vtCreateProgram(gl, &programDef, &pass->program, error);
}

vtResult vtPresentPass_SetEnvironment(vtPresentPass* pass, const vtGL* gl, const vtEnvironment* environment,
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
    vtTexture_Destroy(&pass->environment, gl);
    pass->environment = fresh;
    return vt_ok;
}

void vtPresentPass_Draw(const vtPresentPass* pass, const vtGL* gl, const vtPresentInputs* inputs,
                        GLuint framebuffer, int width, int height)
{
    vtBindFramebuffer(gl, framebuffer, width, height);
    gl->UseProgram(pass->program);
    vtTexture_Bind(inputs->paths, gl, 0);
    vtTexture_Bind(inputs->light, gl, 1);
    vtTexture_Bind(&pass->environment, gl, 2);
    if (inputs->layerDepths->name != 0) {
        vtTexture_Bind(inputs->layerDepths, gl, 3);
        vtTexture_Bind(inputs->layerNormals, gl, 4);
    }
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

void vtPresentPass_Destroy(vtPresentPass* pass, const vtGL* gl)
{
    vtTexture_Destroy(&pass->environment, gl);
    gl->DeleteProgram(pass->program);
    *pass = (vtPresentPass){0};
}
