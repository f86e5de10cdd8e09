#include "scene/lighting.h"

#include "base/error.h"

vtResult vtCreateLighting(const vtEnvironment* environment, vtLighting* lighting, vtError* error)
{
    *lighting = (vtLighting){.environment = environment};
    return vtSucceed(error);
}

void vtDestroyLighting(vtLighting* lighting)
{
    *lighting = (vtLighting){0};
}
