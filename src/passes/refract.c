#include "passes/refract.h"

#include "base/error.h"

vtResult vtRefractPass_Prepare(vtRefractPass* pass, const vtGL* gl, vtTechnique technique, vtError* error)
{
    if (pass->programs[technique] != 0) {
        return vtSucceed(error);
    }
    return vtCreateProgram(gl, &vtTechnique_Row(technique)->refract, &pass->programs[technique], error);
}

vtResult vtRefractPass_Resize(vtRefractPass* pass, const vtGL* gl, int width, int height, vtError* error)
{
    if (!vtTexture_Resize(&pass->paths, gl, GL_RGBA32UI, width, height, 0)) {
        return vtSucceed(error);
    }
    vtAttachment color = {&pass->paths, 0};
    return vtMakeFramebuffer(gl, "refract", &color, 1, NULL, &pass->framebuffer, error);
}

void vtRefractPass_Draw(const vtRefractPass* pass, const vtGL* gl, vtTechnique technique,
                        const vtRefractInputs* inputs)
{
    vtBindFramebuffer(gl, pass->framebuffer, pass->paths.width, pass->paths.height);
    gl->UseProgram(pass->programs[technique]);
    vtTexture_Bind(inputs->surfaceDepth, gl, 0);
    vtTexture_Bind(inputs->surfaceNormals, gl, 1);
    vtTexture_Bind(inputs->mergedDepths, gl, 2);
    vtTexture_Bind(inputs->layerNormals, gl, 3);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

void vtRefractPass_Destroy(vtRefractPass* pass, const vtGL* gl)
{
    for (int i = 0; i < vt_techniqueCount; ++i) {
        gl->DeleteProgram(pass->programs[i]);
    }
    vtDestroyFramebuffers(gl, &pass->framebuffer, 1);
    vtTexture_Destroy(&pass->paths, gl);
    *pass = (vtRefractPass){0};
}
