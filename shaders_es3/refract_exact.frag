// Follows the path of each pixel that sees glass, event by event, until it has left the object for good. A
// round of the loop meets a surface, or goes to the next cell that may hold one and tries it.

// Far more rounds than paths take, so that no fault of the data hangs the GPU.
const int MOST_ROUNDS = 512;

void main()
{
    vec3 direction;
    SurfaceHit hit = firstSurface(direction);
    bool inside = dot(hit.flatNormal, direction) > 0.0; // an eye within the glass sees its back faces
    bool isMet = true, isNew = true, anyReflected = false;
    int status = VT_PATH_LOST, events = 0, axis = 0, tried = 0, attempt = 0;
    Search s;
    for (int round = 0; round < MOST_ROUNDS; ++round) {
        if (isMet) {
            if (events >= u_search.w) {
                break;
            }
            bool reflected;
            direction = meetSurface(direction, hit.normal, hit.flatNormal, u_optics.x, inside, reflected);
            anyReflected = anyReflected || reflected;
            ++events;
            if (inside && events >= u_search.w) {
                break;
            }
            axis = mainAxis(direction);
            tried = 0;
            isMet = false;
            isNew = true;
        }
        if (isNew) {
            s = startSearch(hit.position, direction, axis);
            isNew = false;
        }
        walkTiles(s, inside);
        if (s.steps < 0) {
            break;
        }
        Passage p = passTile(s, s.cell >> s.level, s.level);
        bool isEmpty = false;
        if (!s.isOver && tryCell(s, p, direction, inside, attempt, hit, isEmpty)) {
            isMet = true;
            attempt = 0;
            continue;
        }
        // A ray that has come out of the glass, or into it, without a surface has missed a wall too steep for
        // this side: more of the cell's surfaces are tried, then the next side.
        bool over = p.leave >= s.ray.end;
        bool crossed = !s.isOver && fits(readIntervals(s, s.cell, 0, inside ? NEAR : INNER), p.low, p.high, 0.0, !inside);
        if (over && !inside && !crossed) {
            status = VT_PATH_EXITED;
            break;
        }
        // Layers from the eye have no next side to ask.
        int attempts = isEmpty && !inside ? 1 : crossed && !over && u_cube.z == 1 ? 5 : 0;
        if (attempt < attempts) {
            ++attempt;
            continue;
        }
        attempt = 0;
        if (crossed || over) {
            if (++tried == u_cube.z) {
                break;
            }
            axis = axis == 2 ? 0 : axis + 1;
            isNew = true;
        }
        s.cell += p.exits.x <= p.exits.y ? ivec2(2 * s.positive.x - 1, 0) : ivec2(0, 2 * s.positive.y - 1);
    }
    writePath(direction, status, events, anyReflected);
}
