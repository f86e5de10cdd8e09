// Follows the path of each pixel that sees glass, event by event, until it has left all glass for good or ends on
// something opaque. A round of the loop goes through a surface, or on to the next object, or to the next cell that
// may hold a surface, and tries it.

// Far more rounds than paths take, so that no fault of the data hangs the GPU.
const int MOST_ROUNDS = 1024;

// What the next round begins with.
const int CROSS = 0, NEXT_OBJECT = 1, NEXT_AXIS = 2, WALK = 3;

void main()
{
#ifdef BRANCH
    uvec4 media;
    Path p = startBranch(media);
    SurfaceHit hit;
    int stage = NEXT_OBJECT, met = -1;
    Meeting nearest = Meeting(NOWHERE, VT_NO_TRIANGLE); // of all objects so far
#else
    vec3 view;
    SurfaceHit hit = firstSurface(view);
    Path p = startPath(hit.position, view);
    uvec4 media = mediaAtEye(hit, view);
    absorb(p, media, length(hit.position - u_eye.xyz));
    int stage = CROSS, met = hit.object;
    Meeting nearest = Meeting(0.0, VT_NO_TRIANGLE); // of all objects so far; the first comes from rasterisation
#endif
    float same = 1e-5 * length(u_boundsMax.xyz - u_boundsMin.xyz); // surfaces nearer to one another lie at one place
    int also = -1, status = VT_PATH_LOST, object = 0, axis = 0, tried = 0, attempt = 0;
    bool isMissed = false;
    Search s;
    for (int round = 0; round < MOST_ROUNDS; ++round) {
        if (stage == CROSS) {
            if (nearest.triangle != VT_NO_TRIANGLE) {
                absorb(p, media, nearest.distance);
                if (met >= u_scene.x) {
                    p.position += nearest.distance * p.direction;
                    status = VT_PATH_OPAQUE;
                    break;
                }
                hit = surfaceAt(met, nearest.triangle, p.position, p.direction);
                p.position += nearest.distance * p.direction;
            }
            if (p.events >= u_search.w) {
                break;
            }
            crossSurface(p, media, hit.normal, hit.flatNormal, met, also);
            if (p.events >= u_search.w && media != uvec4(0u)) {
                break;
            }
            nearest = Meeting(NOWHERE, VT_NO_TRIANGLE);
            also = -1;
            object = 0;
            isMissed = false;
            stage = NEXT_OBJECT;
        }
        if (stage == NEXT_OBJECT) {
            while (object < u_scene.y && !holds(media, uint(object + 1)) &&
                   !entersBox(object, p.position, p.direction, nearest.distance)) {
                ++object;
            }
            if (object == u_scene.y) {
                if (nearest.triangle == VT_NO_TRIANGLE) {
                    status = media != uvec4(0u) || isMissed ? VT_PATH_LOST : VT_PATH_EXITED;
                    break;
                }
                stage = CROSS;
                continue;
            }
            axis = mainAxis(p.direction, object);
            tried = 0;
            attempt = 0;
            stage = NEXT_AXIS;
        }
        if (stage == NEXT_AXIS) {
            s = startSearch(p.position, p.direction, object, axis, nearest.distance + same, u_search.y);
            stage = WALK;
        }
        bool inside = holds(media, uint(object + 1));
        walkTiles(s, inside);
        bool isDone = s.steps < 0;
        isMissed = isMissed || isDone;
        Passage passage = passTile(s, s.cell >> s.level, s.level);
        Meeting meeting;
        bool isEmpty = false;
        if (!isDone && !s.isOver && tryCell(s, passage, inside, attempt, meeting, isEmpty)) {
            // Touching glass is crossed at once.
            bool isSame = abs(meeting.distance - nearest.distance) <= same;
            also = isSame && object < u_scene.x ? object : also;
            if (meeting.distance < nearest.distance - same) {
                nearest = meeting;
                met = object;
                also = -1;
            }
            isDone = true;
        } else if (!isDone) {
            // A ray that has come out of the glass, or into it, without a surface has missed a wall too steep for
            // this side: more of the cell's surfaces are tried, then the next side.
            bool isOver = s.isOver || passage.leave >= s.ray.end;
            bool crossed = !s.isOver && !s.isOpaque &&
                           fits(readIntervals(s, s.cell, 0, inside ? NEAR : INNER), passage.low, passage.high, 0.0, !inside);
            // Layers from the eye have no next side to ask.
            int attempts = isEmpty && !inside ? 1 : s.isOpaque ? 1 : crossed && !isOver && u_cube.z == 1 ? 5 : 0;
            isDone = isOver && !crossed && (!inside || s.ray.isCut);
            if (!isDone && attempt < attempts) {
                ++attempt;
            } else if (!isDone) {
                attempt = 0;
                s.cell += passage.exits.x <= passage.exits.y ? ivec2(2 * s.positive.x - 1, 0) : ivec2(0, 2 * s.positive.y - 1);
                if (crossed || isOver) {
                    axis = axis == 2 ? 0 : axis + 1;
                    isDone = ++tried == u_cube.z;
                    isMissed = isMissed || isDone;
                    stage = NEXT_AXIS;
                }
            }
        }
        if (isDone) {
            ++object;
            stage = NEXT_OBJECT;
        }
    }
    writePathEnd(p, status, nearest.triangle, status == VT_PATH_OPAQUE ? met : -1);
}
