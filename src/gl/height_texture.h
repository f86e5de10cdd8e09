// A relief's heights on the GPU, as technique `heightfield` reads them.
#pragma once

#include "gl/target.h"
#include "mesh/height_field.h"

typedef struct vtHeightTexture {
    vtTexture heights; ///< R32F: z of the samples, own units
    vtTexture ranges;  ///< RG32F: lowest and highest z of tiles of 2 x 2 cells, mipmapped
    float cell;        ///< side of a cell, own units
} vtHeightTexture;

/// Uploads; *texture need not be initialised. Fails with vt_errorContext where the GPU's textures are too
/// small.
vtResult vtHeightTexture_Create(vtHeightTexture* texture, const vtGL* gl, const vtHeightField* field,
                                vtError* error);
void vtHeightTexture_Destroy(vtHeightTexture* texture, const vtGL* gl);
size_t vtHeightTexture_Bytes(const vtHeightTexture* texture);
