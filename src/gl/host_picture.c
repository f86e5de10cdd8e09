#include "gl/host_picture.h"

#if VT_WITH_HOST

void vtHostPicture_Set(vtHostPicture* host, const vtGL* gl, GLuint color, GLuint depth, bool levels)
{
    host->color = color;
    host->depth = depth;
    if (!vtHostPicture_IsThere(host)) {
        return;
    }
    if (host->samplers[0] == 0) {
        gl->GenSamplers(2, host->samplers);
    }
    for (int i = 0; i < 2; ++i) {
        const bool blended = i == 0 && levels;
        gl->SamplerParameteri(host->samplers[i], GL_TEXTURE_MIN_FILTER,
                              blended ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST);
        gl->SamplerParameteri(host->samplers[i], GL_TEXTURE_MAG_FILTER, blended ? GL_LINEAR : GL_NEAREST);
        gl->SamplerParameteri(host->samplers[i], GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        gl->SamplerParameteri(host->samplers[i], GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        gl->SamplerParameteri(host->samplers[i], GL_TEXTURE_COMPARE_MODE, GL_NONE);
    }
}

static void bind(const vtGL* gl, vtSampler unit, GLuint texture, GLuint sampler)
{
    gl->ActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->BindSampler((GLuint)unit, texture != 0 ? sampler : 0);
}

void vtHostPicture_Bind(const vtHostPicture* host, const vtGL* gl)
{
    bind(gl, vt_samplerHostColor, host->color, host->samplers[0]);
    bind(gl, vt_samplerHostDepth, host->depth, host->samplers[1]);
}

void vtHostPicture_Unbind(const vtHostPicture* host, const vtGL* gl)
{
    if (vtHostPicture_IsThere(host)) {
        const vtHostPicture none = {0};
        vtHostPicture_Bind(&none, gl);
    }
}

void vtHostPicture_Destroy(vtHostPicture* host, const vtGL* gl)
{
    if (host->samplers[0] != 0) {
        gl->DeleteSamplers(2, host->samplers);
    }
    *host = (vtHostPicture){0};
}

#endif
