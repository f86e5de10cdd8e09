#include "light/shading.h"

#include "base/math.h"
#include "light/look.h"
#include "mesh/mesh_triangle.h"

vtVec3 vtShadeSurface(const vtScene* scene, const vtPlacedObject* object, const vtLighting* lighting,
                      uint32_t triangle, float u, float v, vtVec3 I)
{
    const vtLook look = vtLookAt(scene, object, triangle, u, v, vtMaterial_Index(object->material), -1.0f);
    vtVec3 p[3];
    vtPlacedObject_Corners(object, triangle, p);
    const vtVec3 position = vtTransformPoint(&object->toWorld, vtBlend(p, u, v));
    const float side = vtDot(look.G, I) > 0.0f ? -1.0f : 1.0f;
    const vtVec3 N = vtScale(look.N, side);
    const vtIllumination illumination = {lighting, scene->lights, scene->lightCount, NULL};
    return vtLook_SentLight(&look, &illumination, NULL, vtDot(N, I) < 0.0f ? N : vtScale(look.G, side), I,
                            position, 1.0f);
}
