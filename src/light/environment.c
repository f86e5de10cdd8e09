#include "light/environment.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "base/about.h"
#include "base/error.h"
#include "base/math.h"
#include "image/image.h"
#include "light/cube.h"

// shaders_es3/shade/environment.glsl tells the kinds apart by these numbers.
static_assert(vt_environmentChecker == 0 && vt_environmentStudio == 1 && vt_environmentSky == 2 &&
                  vt_environmentImage == 3,
              "environmentRadiance in environment.glsl");

// ------------------------------------------------------------- the GLSL vocabulary the functions below use

typedef struct vec2 {
    float x, y;
} vec2;

static vtVec3 vec3(float x, float y, float z)
{
    return (vtVec3){x, y, z};
}

static float smoothstep(float low, float high, float x)
{
    const float t = vtClamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// GLSL's mod, towards minus infinity.
static float mod(float x, float y)
{
    return x - y * floorf(x / y);
}

// ------------------------------------------------------------- twins of environment.glsl, in the same order

static vec2 environmentCoordinates(vtVec3 d)
{
    const float across = sqrtf(d.x * d.x + d.z * d.z);
    const float azimuth = across > 0.0f ? atan2f(d.z, d.x) : 0.0f;
    return (vec2){0.5f + azimuth / (2.0f * VT_PI), 0.5f + atan2f(d.y, across) / VT_PI};
}

vtVec3 vtEnvironmentChecker(vtVec3 d)
{
    const vec2 uv = environmentCoordinates(d);
    const float column = mod(floorf(32.0f * uv.x), 32.0f);
    const float row = fminf(floorf(16.0f * uv.y), 15.0f);
    const float q = mod(column + row, 2.0f);
    return vtScale(vec3(0.675f + 0.325f * d.x, 0.675f + 0.325f * d.y, 0.675f + 0.325f * d.z),
                   0.15f + 0.75f * q);
}

static float environmentLamp(vtVec3 d, vtVec3 centre, float halfWidth, float halfHeight, float softness)
{
    const vtVec3 forward = vtNormalize(centre);
    const vtVec3 right = vtNormalize(vec3(forward.z, 0.0f, -forward.x));
    const vtVec3 up = vtCross(forward, right);
    const float facing = vtDot(d, forward);
    if (facing <= 0.001f) {
        return 0.0f;
    }
    const float x = fabsf(vtDot(d, right)) / facing - halfWidth;
    const float y = fabsf(vtDot(d, up)) / facing - halfHeight;
    return (1.0f - smoothstep(-softness, softness, x)) * (1.0f - smoothstep(-softness, softness, y));
}

vtVec3 vtEnvironmentStudio(vtVec3 d)
{
    const vtVec3 wall =
        vtMix(vec3(0.030f, 0.033f, 0.040f), vec3(0.006f, 0.007f, 0.009f), smoothstep(-0.1f, 0.9f, d.y));
    const vtVec3 ground =
        vtMix(vec3(0.020f, 0.021f, 0.025f), vec3(0.110f, 0.103f, 0.092f), 0.5f + 0.5f * d.x);
    vtVec3 light = vtMix(ground, wall, smoothstep(-0.55f, 0.10f, d.y));

    const float towards = 0.5f - 0.5f * d.z;
    const float away = 1.0f - towards;
    const float narrow = towards * towards * towards * towards;
    const float pool = narrow * narrow * narrow * narrow;
    light = vtMulAdd(light, pool * (1.0f - 0.8f * d.y), vec3(0.38f, 0.45f, 0.56f));
    light = vtMulAdd(light, away * away, vec3(0.035f, 0.029f, 0.023f));

    const float overhead = environmentLamp(d, vec3(0.0f, 0.96f, -0.28f), 0.62f, 0.36f, 0.10f);
    const float left = environmentLamp(d, vec3(-0.96f, 0.10f, -0.28f), 0.16f, 1.10f, 0.04f);
    const float right = environmentLamp(d, vec3(0.96f, 0.10f, -0.28f), 0.16f, 1.10f, 0.04f);
    const float window = environmentLamp(d, vec3(-0.45f, 0.42f, 0.79f), 0.26f, 0.32f, 0.02f);
    const float strip = environmentLamp(d, vec3(0.62f, 0.05f, 0.78f), 0.06f, 0.90f, 0.02f);
    light = vtMulAdd(light, (0.70f + 0.50f * d.x) * overhead, vec3(4.2f, 4.2f, 4.1f));
    light = vtMulAdd(light, left, vec3(5.6f, 5.8f, 6.0f));
    light = vtMulAdd(light, right, vec3(6.0f, 5.6f, 5.0f));
    light = vtMulAdd(light, window, vec3(2.4f, 2.4f, 2.3f));
    light = vtMulAdd(light, strip, vec3(1.2f, 1.2f, 1.3f));
    return light;
}

static vtVec3 environmentAir(float height, float towardsSun)
{
    const float air = 1.0f / (fmaxf(height, 0.0f) + 0.08f);
    const vtVec3 scattered =
        vec3(1.0f - expf(-0.058f * air), 1.0f - expf(-0.135f * air), 1.0f - expf(-0.331f * air));
    return vtScale(scattered, 0.75f + 0.35f * towardsSun * towardsSun);
}

vtVec3 vtEnvironmentSky(vtVec3 d)
{
    const float towardsSun = vtDot(d, vec3(-0.5f, 0.5f, -0.70710678f));
    const vtVec3 haze = environmentAir(0.0f, towardsSun);
    vtVec3 light;
    if (d.y >= 0.0f) {
        light = environmentAir(d.y, towardsSun);
    } else {
        const float below = fmaxf(-d.y, 0.001f);
        const float q = mod(floorf(d.x / below) + floorf(d.z / below), 2.0f) - 0.5f;
        const float contrast = smoothstep(0.03f, 0.30f, below);
        const vtVec3 ground = vtScale(vec3(0.30f, 0.26f, 0.20f), 1.0f + 0.55f * contrast * q);
        light = vtMix(ground, haze, expf(-9.0f * below));
    }

    if (d.y > -0.05f) {
        const float apart = 1.0f - towardsSun;
        const float halo = 2.5f * expf(-300.0f * apart) + 0.45f * expf(-14.0f * apart);
        const float disc = 1.0f - smoothstep(0.00018f, 0.00030f, apart);
        const float risen = smoothstep(-0.05f, 0.0f, d.y);
        light = vtMulAdd(light, risen * halo, vec3(1.0f, 0.9f, 0.7f));
        light = vtMulAdd(light, risen * disc, vec3(48.0f, 45.0f, 40.0f));
    }
    return vec3(fminf(light.x, 50.0f), fminf(light.y, 50.0f), fminf(light.z, 50.0f));
}

static vtVec3 texel(const vtEnvironment* environment, int column, int row)
{
    const int width = environment->width, height = environment->height;
    column = ((column % width) + width) % width;
    row = row < 0 ? 0 : row >= height ? height - 1 : row;
    return vtMakeVec3(environment->pixels + ((size_t)row * (size_t)width + (size_t)column) * 3);
}

vtVec3 vtEnvironmentDirection(float u, float v)
{
    const float azimuth = 2.0f * VT_PI * (u - 0.5f), height = VT_PI * (0.5f - v), across = cosf(height);
    return (vtVec3){across * cosf(azimuth), sinf(height), across * sinf(azimuth)};
}

vtVec3 vtEnvironmentImage(const vtEnvironment* environment, vtVec3 d)
{
    const vec2 uv = environmentCoordinates(d);
    const float x = uv.x * (float)environment->width - 0.5f; // texel centres lie at halves
    const float y = (1.0f - uv.y) * (float)environment->height - 0.5f;
    const int column = (int)floorf(x), row = (int)floorf(y);
    const vtVec3 top =
        vtMix(texel(environment, column, row), texel(environment, column + 1, row), vtFract(x));
    const vtVec3 bottom =
        vtMix(texel(environment, column, row + 1), texel(environment, column + 1, row + 1), vtFract(x));
    return vtMix(top, bottom, vtFract(y));
}

// ------------------------------------------------------------------------------------------ the public API

/// By vtEnvironmentKind; the picture kind has no name.
static const struct {
    const char* name;
    const char* summary;
} builtIn[] = {
    {"checker", VT_ABOUT("a 32 x 16 checker tinted by direction, for tests: every distortion is legible")},
    {"studio",
     VT_ABOUT("soft boxes and strip lights in a dark room, as a product photographer lights glass")},
    {"sky", VT_ABOUT("a clear blue sky with sun over a tiled plain")},
};
enum { builtInCount = sizeof builtIn / sizeof builtIn[0] };

const char* vtEnvironmentName(int index)
{
    return index >= 0 && index < builtInCount ? builtIn[index].name : NULL;
}

const char* vtEnvironmentSummary(int index)
{
    return index >= 0 && index < builtInCount ? builtIn[index].summary : NULL;
}

vtResult vtCreateEnvironment(const char* name, vtEnvironment* environment, vtError* error)
{
    if (environment == NULL) {
        return vtFailMissing(error, "vtCreateEnvironment", "environment");
    }
    *environment = (vtEnvironment){0};
    if (name == NULL) {
        return vtFailMissing(error, "vtCreateEnvironment", "name");
    }
    for (int i = 0; i < builtInCount; ++i) {
        if (strcmp(name, builtIn[i].name) == 0) {
            environment->kind = (vtEnvironmentKind)i;
            return vtSucceed(error);
        }
    }
    return vtFail(error, vt_errorArgument, "there is no environment '%s'; choose checker, studio or sky",
                  name);
}

/// What was decoded, whether it is *environment's in the end or not.
static vtResult usePicture(vtEnvironment* decoded, const char* name, vtEnvironment* environment,
                           vtError* error)
{
    const vtResult result = vtUnfoldCube(decoded, name, error);
    if (result == vt_ok) {
        *environment = *decoded;
    } else {
        vtDestroyEnvironment(decoded);
    }
    return result;
}

vtResult vtLoadEnvironment(const void* bytes, size_t size, const char* name, vtEnvironment* environment,
                           vtError* error)
{
    return vtLoadEnvironmentWithin(bytes, size, name, NULL, environment, error);
}

vtResult vtLoadEnvironmentWithin(const void* bytes, size_t size, const char* name, const vtLimits* limits,
                                 vtEnvironment* environment, vtError* error)
{
    if (environment == NULL) {
        return vtFailMissing(error, "vtLoadEnvironment", "environment");
    }
    *environment = (vtEnvironment){0};
    if (bytes == NULL && size > 0) {
        return vtFailMissing(error, "vtLoadEnvironment", "bytes");
    }
    vtEnvironment loaded = {.kind = vt_environmentImage};
    vtResult result = vtCheckPicture(bytes, size, name, limits, 3 * sizeof *loaded.pixels, NULL, error);
    if (result == vt_ok) {
        result = vtDecodeImageLinear(bytes, size, name, &loaded.pixels, &loaded.width, &loaded.height, error);
    }
    return result == vt_ok ? usePicture(&loaded, name, environment, error) : result;
}

vtResult vtCreateImageEnvironment(const uint8_t* rgba, int width, int height, const char* name,
                                  vtEnvironment* environment, vtError* error)
{
    if (environment == NULL) {
        return vtFailMissing(error, "vtCreateImageEnvironment", "environment");
    }
    *environment = (vtEnvironment){0};
    if (rgba == NULL) {
        return vtFailMissing(error, "vtCreateImageEnvironment", "rgba");
    }
    vtEnvironment decoded = {vt_environmentImage, NULL, width, height};
    const vtResult result = vtLinearise(rgba, 4, name, width, height, &decoded.pixels, error);
    return result == vt_ok ? usePicture(&decoded, name, environment, error) : result;
}

vtVec3 vtEnvironment_Sample(const vtEnvironment* environment, vtVec3 direction)
{
    if (environment == NULL) {
        return vec3(0.0f, 0.0f, 0.0f);
    }
    switch (environment->kind) {
    case vt_environmentChecker:
        return vtEnvironmentChecker(direction);
    case vt_environmentStudio:
        return vtEnvironmentStudio(direction);
    case vt_environmentSky:
        return vtEnvironmentSky(direction);
    case vt_environmentImage:
        break;
    }
    const bool isPicture = environment->kind == vt_environmentImage && environment->pixels != NULL &&
                           environment->width > 0 && environment->height > 0;
    return isPicture ? vtEnvironmentImage(environment, direction) : vec3(0.0f, 0.0f, 0.0f);
}

void vtDestroyEnvironment(vtEnvironment* environment)
{
    if (environment != NULL) {
        vtFree(environment->pixels);
        *environment = (vtEnvironment){0};
    }
}
