// The table of materials that shaders read where some are not plain: shaders_es3/common/constants.h.
#pragma once

#include "gl/image_array.h"
#include "gl/object_buffer.h"

/// Uploads the objects' materials, one each, and lights, which are placed as they are. Fails with
/// vt_errorMemory; the table stays as it was.
vtResult vtMaterialTable_Upload(vtTexture* table, const vtGL* gl, const vtObjectBuffer* objects,
                                uint32_t count, const vtLight* lights, uint32_t lightCount,
                                const vtImageArray* images, vtError* error);

/// The number of the first object's material in it.
uint32_t vtMaterialTable_First(uint32_t lightCount);
