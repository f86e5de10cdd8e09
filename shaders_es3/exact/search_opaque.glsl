// The first opaque surface on a ray, for the techniques that search layers for glass: behind the glass, beside it, and
// where the ray leaves the picture. (Wyman, Interactive Image-Space Refraction of Nearby Geometry, 2005, searches what
// the eye sees of it.) Needs records and object_tree.
struct OpaqueHit {
    RecordHit hit;
    int object;
};

const OpaqueHit NOTHING_OPAQUE = OpaqueHit(RecordHit(NOWHERE, VT_NO_TRIANGLE, vec2(0.0)), -1);

OpaqueHit searchOpaque(vec3 origin, vec3 direction, float farthest)
{
    OpaqueHit nearest = NOTHING_OPAQUE;
    nearest.hit.distance = farthest;
    vec3 inverse = 1.0 / mix(direction, vec3(1e-12), lessThan(abs(direction), vec3(1e-12)));
    int at = 0;
    for (int i = 0; i < VT_MAX_OBJECTS; ++i) {
        int object = nextObject(at, origin, inverse, nearest.hit.distance);
        if (object < 0) {
            break;
        }
        if (object >= u_scene.x) {
            Transform transform = readTransform(object);
            Hierarchy tree = readHierarchy(object);
            RecordHit hit = searchRecords(tree, toObject(transform, vec4(origin, 1.0)),
                                          toObject(transform, vec4(direction, 0.0)), float(!tree.bothSides), 0.0,
                                          nearest.hit.distance, VT_NO_TRIANGLE);
            bool isNearer = hit.triangle != VT_NO_TRIANGLE;
            nearest.hit.distance = isNearer ? hit.distance : nearest.hit.distance;
            nearest.hit.triangle = isNearer ? hit.triangle : nearest.hit.triangle;
            nearest.hit.at = isNearer ? hit.at : nearest.hit.at;
            nearest.object = isNearer ? object : nearest.object;
        }
    }
    return nearest;
}

// The same of a triangle that is known to be met about `position`.
OpaqueHit opaqueAt(uint triangle, int object, vec3 position, vec3 direction)
{
    Transform transform = readTransform(object);
    Corners corners = recordCorners(triangle);
    vec3 A = uintBitsToFloat(corners.a.xyz), d = toObject(transform, vec4(direction, 0.0));
    vec3 e = uintBitsToFloat(corners.b.xyz) - A, f = uintBitsToFloat(corners.c.xyz) - A;
    vec3 s = toObject(transform, vec4(position, 1.0)) - A, p = cross(d, f);
    vec2 at = vec2(dot(s, p), dot(d, cross(s, e))) / dot(e, p);
    return OpaqueHit(RecordHit(0.0, triangle, at), object);
}
