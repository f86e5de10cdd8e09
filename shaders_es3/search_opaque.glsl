// The first opaque surface on a ray, by the search of `exact`: behind the glass, beside it, and where the ray leaves
// the picture. (Wyman, Interactive Image-Space Refraction of Nearby Geometry, 2005, searches what the eye sees of it.)
struct OpaqueHit {
    float distance;
    uint triangle; // VT_NO_TRIANGLE: none
    int object;
};

const int MOST_OPAQUE_STEPS = 512; // texels of the pyramid read

OpaqueHit searchOpaque(vec3 origin, vec3 direction, float farthest)
{
    OpaqueHit hit = OpaqueHit(farthest, VT_NO_TRIANGLE, -1);
    for (int object = u_scene.x; object < u_scene.y; ++object) {
        if (!entersBox(object, origin, direction, hit.distance)) {
            continue;
        }
        Meeting meeting;
        searchCube(origin, direction, object, false, true, hit.distance, MOST_OPAQUE_STEPS, meeting);
        if (meeting.distance < hit.distance) {
            hit = OpaqueHit(meeting.distance, meeting.triangle, object);
        }
    }
    return hit;
}
