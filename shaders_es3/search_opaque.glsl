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
        int axis = -1;
        Search s = startSearch(origin, direction, object, axis, hit.distance, MOST_OPAQUE_STEPS);
        for (int round = 0; round < MOST_OPAQUE_STEPS; ++round) {
            walkTiles(s, false);
            if (s.isOver || s.steps < 0) {
                break;
            }
            Passage passage = passTile(s, s.cell, 0);
            Meeting meeting;
            bool isEmpty, isFound = false;
            for (int attempt = 0; attempt < 6 && !isFound; ++attempt) {
                isFound = tryCell(s, passage, false, attempt, meeting, isEmpty);
            }
            if (isFound && meeting.distance < hit.distance) {
                hit = OpaqueHit(meeting.distance, meeting.triangle, object);
            }
            if (isFound || passage.leave >= s.ray.end) {
                break;
            }
            s.cell += passage.exits.x <= passage.exits.y ? ivec2(2 * s.positive.x - 1, 0) : ivec2(0, 2 * s.positive.y - 1);
        }
    }
    return hit;
}
