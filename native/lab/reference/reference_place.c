// Where a path meets glass: the surfaces there, and what the path is within before and after them.
#include "lab/reference/reference_place.h"

#include "mesh/mesh_triangle.h"

vtVec3 vtTriangleNormal(const vtPlacedObject* object, const vtSurfaceHit* hit)
{
    vtVec3 p[3];
    vtPlacedObject_Corners(object, hit->triangle, p);
    const vtVec3 normal = vtCross(vtSub(p[1], p[0]), vtSub(p[2], p[0]));
    return vtNormalize(vtTransformNormal(&object->toObject, normal));
}

vtVec3 vtSurfacePoint(const vtPlacedObject* object, const vtSurfaceHit* hit)
{
    vtVec3 corners[3];
    vtPlacedObject_Corners(object, hit->triangle, corners);
    return vtTransformPoint(&object->toWorld, vtBlend(corners, hit->u, hit->v));
}

/// Whether a surface found is the one that the path is just leaving.
static bool isStart(const vtReference* reference, const vtReferencePath* path, const vtSurface* surface)
{
    const vtSurfaceHit* hit = surface->hit;
    const vtPlacedObject* object = &reference->objects[hit->object];
    const bool wrongSide = !object->thin && vtMedia_Holds(&path->within, object->body + 1) != surface->behind;
    const bool near = hit->distance < VT_SELF_DISTANCE * reference->extent;
    for (int i = 0; i < path->startCount; ++i) {
        if (path->startObjects[i] == hit->object &&
            (path->startTriangles[i] == hit->triangle || (wrongSide && near))) {
            return true;
        }
    }
    return false;
}

/// The surfaces of glass that the path meets; false where the nearest is the one it starts from.
bool vtFindSurfaces(const vtReference* reference, const vtReferencePath* path, const vtMeeting* meeting,
                    vtPlace* place)
{
    place->count = 0;
    place->opaque = &meeting->opaque;
    for (int i = 0; i < meeting->glassCount; ++i) {
        const vtSurfaceHit* hit = &meeting->glass[i];
        const vtVec3 G = vtTriangleNormal(&reference->objects[hit->object], hit);
        vtSurface* surface = &place->surfaces[place->count];
        *surface = (vtSurface){hit, &reference->objects[hit->object], G, vtDot(G, path->direction) > 0.0f};
        if (!isStart(reference, path, surface)) {
            ++place->count;
        } else if (hit->distance == meeting->nearest) {
            return false;
        }
    }
    return true;
}

/// Toggles the objects of those surfaces that are met from behind, or of the others.
static bool toggle(vtMedia* media, const vtPlace* place, bool behind)
{
    bool fits = true;
    for (int i = 0; i < place->count; ++i) {
        const vtSurface* surface = &place->surfaces[i];
        fits = fits && (surface->behind != behind || surface->object->thin ||
                        vtMedia_Toggle(media, surface->object->body + 1));
    }
    return fits;
}

/// What the path is within before the surfaces and after them. A surface itself says where the path is: an
/// eye within open glass sees back faces first, and where parts of a mesh run into each other (the cow's
/// horns) this is what Cycles does. False where too much lies one in the other.
bool vtFindMedia(const vtReferencePath* path, vtPlace* place)
{
    place->before = path->within;
    bool fits = true;
    for (int i = 0; i < place->count; ++i) {
        const uint32_t id = place->surfaces[i].object->body + 1;
        if (!place->surfaces[i].object->thin &&
            vtMedia_Holds(&place->before, id) != place->surfaces[i].behind) {
            fits = fits && vtMedia_Toggle(&place->before, id);
        }
    }
    place->after = place->before;
    return fits && toggle(&place->after, place, true) && toggle(&place->after, place, false);
}

const vtSurface* vtPlace_Surface(const vtPlace* place)
{
    int first = 0;
    while (first < place->count && place->surfaces[first].object->thin) {
        ++first;
    }
    return &place->surfaces[first < place->count ? first : 0];
}
