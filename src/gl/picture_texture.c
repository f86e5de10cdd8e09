#include "gl/picture_texture.h"

#include "base/error.h"

static int countLevels(int width, int height)
{
    int levels = 1;
    for (int side = width > height ? width : height; side > 1; side /= 2) {
        ++levels;
    }
    return levels;
}

vtResult vtCheckTextureSize(const vtGL* gl, int width, int height, const char* what, vtError* error)
{
    GLint largest = 0;
    gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (width > largest || height > largest) {
        return vtFail(error, vt_errorContext,
                      "%s: %d x %d is more than this GPU's largest texture (%d); scale the picture down",
                      what, width, height, largest);
    }
    return vt_ok;
}

vtResult vtUploadPicture(vtTexture* texture, const vtGL* gl, const vtImage* picture, const char* what,
                         vtError* error)
{
    const int width = picture->width, height = picture->height;
    if (picture->pixels == NULL || width < 1 || height < 1) {
        return vtFail(error, vt_errorArgument, "%s: the picture has no pixels; decode it first", what);
    }
    const vtResult result = vtCheckTextureSize(gl, width, height, what, error);
    if (result != vt_ok) {
        return result;
    }
    vtTexture_Destroy(texture, gl);
    *texture = (vtTexture){0, GL_TEXTURE_2D, GL_SRGB8_ALPHA8, width, height, 0, true};
    gl->GenTextures(1, &texture->name);
    vtTexture_Bind(texture, gl, vt_samplerNone);
    gl->TexStorage2D(GL_TEXTURE_2D, countLevels(width, height), texture->format, width, height);
    gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, picture->pixels);
    gl->GenerateMipmap(GL_TEXTURE_2D);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return vtSucceed(error);
}
