#include "scene/shading.h"

vtVec3 vtShadeSurface(const vtScene* scene, const vtPlacedObject* object, const vtLighting* lighting,
                      uint32_t triangle, float u, float v, vtVec3 I)
{
    (void)scene, (void)lighting, (void)triangle, (void)u, (void)v, (void)I;
    return object->material->baseColor;
}
