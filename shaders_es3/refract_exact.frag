// Follows the path of each pixel that sees glass, event by event, until it has left all glass for good or ends on
// something opaque.

// Far more rounds than paths take, so that no fault of the data hangs the GPU.
const int MOST_SURFACES = 256, MOST_ROUNDS = 1024;

// Where the path meets an object next, its triangle VT_NO_TRIANGLE where it does not before `farthest`. False where it
// must have met it, unnoticed. isOther: the path is not on its surface now.
bool searchObject(Path p, int object, bool inside, bool isOther, float farthest, out Meeting meeting)
{
    meeting = Meeting(NOWHERE, VT_NO_TRIANGLE);
    int axis = -1;
    for (int tried = 0; tried < u_cube.z; ++tried) {
        Search s = startSearch(p.position, p.direction, object, axis, farthest, u_search.y);
        int attempt = 0;
        for (int round = 0; round < MOST_ROUNDS; ++round) {
            walkTiles(s, inside);
            if (s.steps < 0) {
                return false;
            }
            Passage passage = passTile(s, s.cell >> s.level, s.level);
            bool isEmpty = false;
            if (!s.isOver && tryCell(s, passage, inside, attempt, meeting, isEmpty)) {
                return true;
            }
            // A ray that has come out of the glass, or into it, without a surface has missed a wall too steep for
            // this side: more of the cell's surfaces are tried, then the next side.
            bool isOver = s.isOver || passage.leave >= s.ray.end;
            bool crossed = !s.isOver && !s.isOpaque &&
                           fits(readIntervals(s, s.cell, 0, inside ? NEAR : INNER), passage.low, passage.high, 0.0, !inside);
            if (isOver && !crossed && (!inside || s.ray.isCut)) {
                return true;
            }
            // Layers from the eye have no next side to ask; and of a ray that only grazes an object nothing tells
            // afterwards.
            bool isLast = crossed && !isOver && u_cube.z == 1;
            int attempts = isLast || (isOther && !inside) ? 5 : isEmpty && !inside ? 1 : 0;
            if (attempt < attempts) {
                ++attempt;
                continue;
            }
            if (crossed || isOver) {
                break;
            }
            attempt = 0;
            s.cell += passage.exits.x <= passage.exits.y ? ivec2(2 * s.positive.x - 1, 0) : ivec2(0, 2 * s.positive.y - 1);
        }
        axis = axis == 2 ? 0 : axis + 1;
    }
    return false;
}

void main()
{
#ifdef BRANCH
    uvec4 media;
    Path p = startBranch(media);
    SurfaceHit hit;
    Meeting nearest = Meeting(NOWHERE, VT_NO_TRIANGLE); // of all objects so far
    bool isMet = false;
    int met = -1;
#else
    vec3 view;
    SurfaceHit hit = firstSurface(view);
    Path p = startPath(hit.position, view);
    uvec4 media = mediaAtEye(hit, view);
    Meeting nearest = Meeting(length(hit.position - u_eye.xyz), VT_NO_TRIANGLE); // the first is known from rasterisation
    bool isMet = true;
    int met = hit.object;
#endif
    float same = 1e-5 * length(u_boundsMax.xyz - u_boundsMin.xyz); // surfaces nearer to one another lie at one place
    int also = -1, status = VT_PATH_LOST;
    for (int surface = 0; surface < MOST_SURFACES; ++surface) {
        if (isMet) {
            if (p.events >= u_search.w) {
                break;
            }
            crossSurface(p, media, nearest.distance, hit, also);
            if (p.events >= u_search.w && media != uvec4(0u)) {
                break;
            }
        }
        nearest = Meeting(NOWHERE, VT_NO_TRIANGLE);
        also = -1;
        bool isMissed = false;
        int next = -1;
        for (int object = 0; object < u_scene.y; ++object) {
            bool inside = holds(media, uint(object + 1));
            if (u_scene.y > 1 && !inside && !entersBox(object, p.position, p.direction, nearest.distance)) {
                continue;
            }
            Meeting meeting;
            isMissed = !searchObject(p, object, inside, object != met, nearest.distance + same, meeting) || isMissed;
            // Touching glass is crossed at once.
            bool isSame = abs(meeting.distance - nearest.distance) <= same && meeting.distance < NOWHERE;
            also = isSame && object < u_scene.x ? object : also;
            if (meeting.distance < nearest.distance - same) {
                nearest = meeting;
                next = object;
                also = -1;
            }
        }
        met = next;
        if (nearest.triangle == VT_NO_TRIANGLE) {
            status = media != uvec4(0u) || isMissed ? VT_PATH_LOST : VT_PATH_EXITED;
            break;
        }
        if (met >= u_scene.x) {
            absorb(p, media, nearest.distance);
            p.position += nearest.distance * p.direction;
            status = VT_PATH_OPAQUE;
            break;
        }
        hit = surfaceAt(met, nearest.triangle, p.position, p.direction);
        p.position += nearest.distance * p.direction;
        isMet = true;
    }
    writePathEnd(p, status, nearest.triangle, status == VT_PATH_OPAQUE ? met : -1);
}
