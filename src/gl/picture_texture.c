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
    vtResult result = vtCheckTextureSize(gl, width, height, what, error);
    if (result != vt_ok) {
        return result;
    }
    if (texture->width != width || texture->height != height) {
        vtTexture fresh = {0, GL_TEXTURE_2D, GL_SRGB8_ALPHA8, width, height, 0, true};
        gl->GenTextures(1, &fresh.name);
        vtTexture_Bind(&fresh, gl, vt_samplerNone);
        gl->TexStorage2D(GL_TEXTURE_2D, countLevels(width, height), fresh.format, width, height);
        result = vtCheckGL(gl, "room for a picture", error);
        vtTexture_Destroy(result == vt_ok ? texture : &fresh, gl);
        if (result != vt_ok) {
            return result;
        }
        *texture = fresh;
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
    vtResult result = vtMakePictureTexture(texture, gl, width, picture->height, repeat, what, error);
    if (result == vt_ok) {
        gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, picture->height, GL_RGBA, GL_UNSIGNED_BYTE,
                          picture->pixels);
        gl->GenerateMipmap(GL_TEXTURE_2D);
        result = vtCheckGL(gl, "uploading a picture", error);
    }
    return result;
}
