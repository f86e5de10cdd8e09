#include "gl/host_picture.h"

#if VT_WITH_HOST

void vtHostPicture_Set(vtHostPicture* host, const vtGL* gl, GLuint color, GLuint depth)
{
    host->color = color;
    host->depth = depth;
    if (host->sampler == 0 && vtHostPicture_IsThere(host)) {
        gl->GenSamplers(1, &host->sampler);
        gl->SamplerParameteri(host->sampler, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl->SamplerParameteri(host->sampler, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        gl->SamplerParameteri(host->sampler, GL_TEXTURE_COMPARE_MODE, GL_NONE);
    }
}

static void bind(const vtHostPicture* host, const vtGL* gl, vtSampler unit, GLuint texture)
{
    gl->ActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->BindSampler((GLuint)unit, texture != 0 ? host->sampler : 0);
}

void vtHostPicture_Bind(const vtHostPicture* host, const vtGL* gl)
{
    bind(host, gl, vt_samplerHostColor, host->color);
    bind(host, gl, vt_samplerHostDepth, host->depth);
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
    if (host->sampler != 0) {
        gl->DeleteSamplers(1, &host->sampler);
    }
    *host = (vtHostPicture){0};
}

#endif
