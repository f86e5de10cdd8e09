// What a ground is asked to be.
#include <math.h>

#include "base/about.h"
#include "base/error.h"
#include "base/math.h"

vtGround vtDefaultGround(void)
{
    return (vtGround){.height = NAN,
                      .color = {0.8f, 0.8f, 0.8f},
                      .shadowIntensity = 1.0f,
                      .sunSize = 0.53f,
                      .sunColor = {3.0f, 3.0f, 3.0f}};
}

#ifdef VT_WITH_ABOUT // a page's attributes have their ranges
static bool isFinite(vtVec3 v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static vtResult checkNumber(const char* name, float value, float most, vtError* error)
{
    return value >= 0.0f && value <= most // written so that NaN fails
               ? vt_ok
               : vtFail(error, vt_errorArgument, "ground: its %s is %g; it must be from 0 to %g", name,
                        (double)value, (double)most);
}

static vtResult checkColor(const char* name, vtVec3 c, float most, vtError* error)
{
    vtResult result = checkNumber(name, c.x, most, error);
    result = result == vt_ok ? checkNumber(name, c.y, most, error) : result;
    return result == vt_ok ? checkNumber(name, c.z, most, error) : result;
}

vtResult vtValidateGround(const vtGround* ground, vtError* error)
{
    if (ground == NULL) {
        return vtFailMissing(error, "vtValidateGround", "ground");
    }
    vtResult result = checkColor("color", ground->color, 1.0f, error);
    result = result == vt_ok ? checkNumber("shadow intensity", ground->shadowIntensity, 1.0f, error) : result;
    result = result == vt_ok ? checkNumber("shadow softness", ground->shadowSoftness, 1.0f, error) : result;
    result = result == vt_ok ? checkNumber("sun's size", ground->sunSize, 90.0f, error) : result;
    result = result == vt_ok ? checkColor("sun's color", ground->sunColor, 1e6f, error) : result;
    if (result != vt_ok) {
        return result;
    }
    if (isinf(ground->height)) {
        return vtFail(error, vt_errorArgument,
                      "ground: its height is infinite; give a number, or NAN for the "
                      "scene's lowest point");
    }
    const vtVec3 sun = ground->sunDirection;
    const bool none = sun.x == 0.0f && sun.y == 0.0f && sun.z == 0.0f;
    if (!none && (!isFinite(sun) || !(vtNormalizeAny(sun).y > 0.02f))) {
        return vtFail(error, vt_errorArgument,
                      "ground: the sun's direction is %g, %g, %g; it must point up, by more than a degree",
                      (double)sun.x, (double)sun.y, (double)sun.z);
    }
    return vtSucceed(error);
}
#else
vtResult vtValidateGround(const vtGround* ground, vtError* error)
{
    (void)ground;
    return vtSucceed(error);
}
#endif
