#include "scene/boxes.h"

#include <float.h>
#include <math.h>

void vtBoundBox(const vtTransform* toWorld, vtVec3 a, vtVec3 b, vtVec3* low, vtVec3* high)
{
    *low = (vtVec3){FLT_MAX, FLT_MAX, FLT_MAX};
    *high = (vtVec3){-FLT_MAX, -FLT_MAX, -FLT_MAX};
    for (int corner = 0; corner < 8; ++corner) {
        const vtVec3 p = {corner & 1 ? b.x : a.x, corner & 2 ? b.y : a.y, corner & 4 ? b.z : a.z};
        const float* x = toWorld->rows[0];
        const float* y = toWorld->rows[1];
        const float* z = toWorld->rows[2];
        const vtVec3 q = {x[0] * p.x + x[1] * p.y + x[2] * p.z + x[3],
                          y[0] * p.x + y[1] * p.y + y[2] * p.z + y[3],
                          z[0] * p.x + z[1] * p.y + z[2] * p.z + z[3]};
        *low = (vtVec3){fminf(low->x, q.x), fminf(low->y, q.y), fminf(low->z, q.z)};
        *high = (vtVec3){fmaxf(high->x, q.x), fmaxf(high->y, q.y), fmaxf(high->z, q.z)};
    }
}
