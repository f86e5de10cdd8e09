#include "base/limits.h"

vtLimits vtDefaultLimits(void)
{
    const uint64_t gibibyte = (uint64_t)1 << 30;
    return (vtLimits){.memory = SIZE_MAX > UINT32_MAX ? 4 * gibibyte : 2 * gibibyte,
                      .triangles = 50000000,
                      .pixels = (uint64_t)8192 * 8192};
}

vtLimits vtResolveLimits(const vtLimits* limits)
{
    vtLimits resolved = vtDefaultLimits();
    if (limits != NULL) {
        resolved.memory = limits->memory > 0 ? limits->memory : resolved.memory;
        resolved.triangles = limits->triangles > 0 ? limits->triangles : resolved.triangles;
        resolved.pixels = limits->pixels > 0 ? limits->pixels : resolved.pixels;
    }
    return resolved;
}
