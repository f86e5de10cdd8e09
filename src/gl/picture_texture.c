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

vtResult vtMakePictureTexture(vtTexture* texture, const vtGL* gl, int width, int height, GLenum repeat,
                              const char* what, vtError* error)
{
    if (width < 1 || height < 1) {
        return vtFail(error, vt_errorArgument, "%s: the picture has no pixels; decode it first", what);
    }
    const vtResult result = vtCheckTextureSize(gl, width, height, what, error);
    if (result != vt_ok) {
        return result;
    }
    if (texture->width != width || texture->height != height) {
        vtTexture_Destroy(texture, gl);
        *texture = (vtTexture){0, GL_TEXTURE_2D, GL_SRGB8_ALPHA8, width, height, 0, true};
        gl->GenTextures(1, &texture->name);
        vtTexture_Bind(texture, gl, vt_samplerNone);
        gl->TexStorage2D(GL_TEXTURE_2D, countLevels(width, height), texture->format, width, height);
    }
    vtTexture_Bind(texture, gl, vt_samplerNone);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, (GLint)repeat);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, (GLint)repeat);
    return vtSucceed(error);
}

vtResult vtUploadPicture(vtTexture* texture, const vtGL* gl, const vtImage* picture, GLenum repeat,
                         const char* what, vtError* error)
{
    const int width = picture->pixels != NULL ? picture->width : 0;
    const vtResult result =
        vtMakePictureTexture(texture, gl, width, picture->height, repeat, what, error);
    if (result == vt_ok) {
        gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, picture->height, GL_RGBA, GL_UNSIGNED_BYTE,
                          picture->pixels);
        gl->GenerateMipmap(GL_TEXTURE_2D);
    }
    return result;
}
