#include "gl/height_texture.h"

#include "base/error.h"

vtResult vtHeightTexture_Create(vtHeightTexture* texture, const vtGL* gl, const vtHeightField* field,
                                vtError* error)
{
    *texture = (vtHeightTexture){0};
    GLint largest = 0;
    gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (field->width > largest || field->height > largest) {
        return vtFail(
            error, vt_errorContext,
            "scene: a relief of %d x %d samples is larger than this GPU's textures (%d); scale it down",
            field->width, field->height, largest);
    }
    texture->cell = field->cell;
    vtTexture_Resize(&texture->heights, gl, GL_R32F, field->width, field->height, 0);
    gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, field->width, field->height, GL_RED, GL_FLOAT, field->z);

    vtTexture* ranges = &texture->ranges;
    *ranges = (vtTexture){.target = GL_TEXTURE_2D,
                          .format = GL_RG32F,
                          .width = field->tileColumns,
                          .height = field->tileRows,
                          .mipmapped = true};
    gl->GenTextures(1, &ranges->name);
    vtTexture_Bind(ranges, gl, vt_samplerNone);
    gl->TexStorage2D(GL_TEXTURE_2D, field->levelCount, GL_RG32F, field->tileColumns, field->tileRows);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    for (int level = 1; level <= field->levelCount; ++level) {
        gl->TexSubImage2D(GL_TEXTURE_2D, level - 1, 0, 0, vtHeightField_TileColumns(field, level),
                          vtHeightField_TileRows(field, level), GL_RG, GL_FLOAT,
                          field->ranges + field->starts[level]);
    }
    return vtCheckGL(gl, "uploading the relief", error);
}

void vtHeightTexture_Destroy(vtHeightTexture* texture, const vtGL* gl)
{
    vtTexture_Destroy(&texture->heights, gl);
    vtTexture_Destroy(&texture->ranges, gl);
    *texture = (vtHeightTexture){0};
}

size_t vtHeightTexture_Bytes(const vtHeightTexture* texture)
{
    return vtTexture_Bytes(&texture->heights) + vtTexture_Bytes(&texture->ranges);
}
