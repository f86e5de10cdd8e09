#include "passes/ground.h"

#include <float.h>

#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "passes/ground_caustics.h"

/// Rays along a side of their square: 2 x 2 shade rays a texel of a sun, 8 x 8 of the sky. A page, which
/// waits for them, takes a quarter of that, and of what would show noise four drawings; while things move
/// fewer photons, in one.
#ifdef __EMSCRIPTEN__
enum { across = 512, movingAcross = 256, targetCount = 3, mostDrawings = 4 };
#else
enum { across = 1024, movingAcross = across, targetCount = 3, mostDrawings = 1 };
#endif

bool vtGroundPass_IsStale(const vtGroundPass* pass, const vtFrame* frame)
{
    return pass->isStale || pass->isCoarse || pass->frame.ior != frame->ior ||
           pass->frame.fresnel != frame->fresnel || pass->frame.maxEvents < frame->maxEvents ||
           pass->frame.technique != frame->technique;
}

void vtGroundPass_Start(vtGroundPass* pass, const vtGL* gl, vtTraceVariant variant, vtProgramList* programs)
{
    const vtProgramDef def = vtTracePhotons(variant);
    pass->program = vtProgramList_Start(programs, gl, &def);
    pass->mostLight = (variant & vt_traceSpectral) != 0 ? (float)VT_PHOTON_MOST : 1.0f;
    pass->hasChance = (variant & (vt_traceSpectral | vt_traceRough)) != 0;
}

/// What one drawing needs, and where it is read to.
typedef struct Rays {
    vtGroundPlan plan;
    vtTexture lights, targets[targetCount];
    GLuint framebuffer;
    uint32_t* words;     ///< of one target
    vtCaustics caustics; ///< photons on opaque things
} Rays;

static vtResult makeRays(Rays* rays, const vtGL* gl, vtError* error)
{
    const uint32_t listRows = VT_GROUND_SAMPLES / 64;
    rays->words = vtAllocate((size_t)across * across, 4 * sizeof *rays->words);
    if (rays->words == NULL) {
        return vtFail(error, vt_errorMemory, "ground: out of memory");
    }
    vtTexture_Resize(&rays->lights, gl, GL_RGBA32UI, 64, (int)(4 * listRows), 0);
    for (uint32_t list = 0; list < 4; ++list) {
        const vtLightSample* samples = rays->plan.samples[list / 2][list % 2];
        for (uint32_t i = 0; i < VT_GROUND_SAMPLES; ++i) {
            memcpy(rays->words + 4 * (size_t)i, &samples[i].direction, sizeof samples[i].direction);
            rays->words[4 * (size_t)i + 3] = 0;
        }
        vtTexture_Bind(&rays->lights, gl, vt_samplerNone);
        gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, (GLint)(list * listRows), 64, (GLsizei)listRows,
                          GL_RGBA_INTEGER, GL_UNSIGNED_INT, rays->words);
    }
    vtAttachment colors[targetCount];
    for (int i = 0; i < targetCount; ++i) {
        vtTexture_Resize(&rays->targets[i], gl, GL_RGBA32UI, across, across, 0);
        colors[i] = (vtAttachment){&rays->targets[i], 0};
    }
    return vtMakeFramebuffer(gl, "ground", colors, targetCount, NULL, &rays->framebuffer, error);
}

static void destroyRays(Rays* rays, const vtGL* gl)
{
    vtTexture_Destroy(&rays->lights, gl);
    for (int i = 0; i < targetCount; ++i) {
        vtTexture_Destroy(&rays->targets[i], gl);
    }
    vtDestroyFramebuffers(gl, &rays->framebuffer, 1);
    vtFree(rays->words);
    vtDestroyCaustics(&rays->caustics);
    vtDestroyGroundPlan(&rays->plan);
}

static float asFloat(uint32_t word)
{
    float number;
    memcpy(&number, &word, sizeof number);
    return number;
}

static void addShade(Rays* rays, int source, int count, uint32_t seed)
{
    for (int i = 0; i < count * count; ++i) {
        const uint32_t state = rays->words[4 * (size_t)i + 3] >> 16;
        const int x = i % count, y = i / count;
        const vtGroundRay ray = vtGroundPlan_Ray(&rays->plan, source, vt_groundShade, x, y, count, seed);
        vtGroundPlan_AddShade(&rays->plan, source, &ray, x, y, count, state == 1); // out, and nothing met
    }
}

/// `isOwn`: of the paths themselves, which count only where they have met something. False where memory is
/// out.
static bool addPhotons(const vtGroundPass* pass, Rays* rays, int source, bool isOwn, int count, int drawings,
                       uint32_t seed)
{
    bool ready = true;
    for (int i = 0; i < count * count; ++i) {
        const uint32_t* word = rays->words + 4 * (size_t)i;
        if ((word[2] | (word[3] & 0xffffu)) == 0 || (isOwn && (word[3] & 0x20000u) == 0)) {
            continue;
        }
        const vtGroundRay ray =
            vtGroundPlan_Ray(&rays->plan, source, vt_groundPhotons, i % count, i / count, count, seed);
        const vtVec3 share = vtScale(vtLanding_Light(word), pass->mostLight / (float)drawings);
        if (vtLanding_IsOpaque(word)) { // the sky lights opaque things without shadows
            const vtVec3 flux =
                vtScale(vtMultiply(ray.color, share), ray.area / ((float)count * (float)count));
            ready = ready && (source == vt_groundSky || vtKeepLanding(&rays->caustics, word, flux));
            continue;
        }
        vtGroundPlan_AddPhoton(&rays->plan, source, &ray, asFloat(word[0]), asFloat(word[1]), share, count);
    }
    return ready;
}

/// What the shader has to know of a source.
static void setUniforms(const vtGroundPass* pass, const vtGL* gl, const vtGroundPlan* plan, int source,
                        vtGroundRays kind, int count, uint32_t seed)
{
    const vtVec3 low = plan->glassLow, high = plan->glassHigh;
    const vtGroundBeam beam = vtGroundPlan_Beam(plan, source);
    const vtVec3 place = beam.place, axis = beam.axis;
    const float ground[4] = {plan->height, plan->lowX, plan->lowZ, plan->size};
    const float numbers[4] = {(float)(2 * source + (int)kind), (float)kind, plan->reach, (float)count};
    const float box[8] = {low.x, low.y, low.z, 0.0f, high.x, high.y, high.z, 0.0f};
    const float light[8] = {place.x, place.y, place.z, source < 2 ? 0.0f : beam.isNear ? 1.0f : 2.0f,
                            axis.x,  axis.y,  axis.z,  beam.cosine};
    gl->Uniform4fv(pass->program->uniforms[1], 1, ground);
    gl->Uniform4fv(pass->program->uniforms[2], 1, numbers);
    gl->Uniform4fv(pass->program->uniforms[3], 2, box);
    gl->Uniform4fv(pass->program->uniforms[4], 2, light);
    gl->Uniform1i(pass->program->uniforms[5], (GLint)seed);
}

/// One of so many drawings; `seed`: its number.
static bool drawRays(const vtGroundPass* pass, const vtGL* gl, Rays* rays, int source, vtGroundRays kind,
                     int drawings, uint32_t seed)
{
    bool ready = true;
    const int most = pass->isCoarse ? movingAcross : across;
    const int count = vtGroundPlan_Across(&rays->plan, source, kind, most);
    vtBindFramebuffer(gl, rays->framebuffer, count, count);
    gl->UseProgram(pass->program->name);
    setUniforms(pass, gl, &rays->plan, source, kind, count, seed);
    vtTexture_Bind(&rays->lights, gl, vt_samplerGroundLights);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    const int targets = kind == vt_groundPhotons ? targetCount : 1;
    for (int i = 0; i < targets; ++i) {
        gl->ReadBuffer(GL_COLOR_ATTACHMENT0 + (GLenum)i);
        gl->ReadPixels(0, 0, count, count, GL_RGBA_INTEGER, GL_UNSIGNED_INT, rays->words);
        if (kind == vt_groundShade) {
            addShade(rays, source, count, seed);
        } else {
            ready = addPhotons(pass, rays, source, i == 0, count, drawings, seed) && ready;
        }
    }
    gl->ReadBuffer(GL_COLOR_ATTACHMENT0);
    return ready;
}

static vtResult followRays(const vtGroundPass* pass, const vtGL* gl, Rays* rays, vtError* error)
{
    bool ready = true;
    for (int source = 0; source < rays->plan.sourceCount; ++source) {
        if (vtGroundPlan_IsDark(&rays->plan, source)) {
            continue;
        }
        const int several = pass->isCoarse ? 1 : mostDrawings;
        const int ofShade = source == vt_groundSky ? several : 1;
        const int ofPhotons = source == vt_groundSky || pass->hasChance ? several : 1;
        for (int i = 0; i < ofShade; ++i) {
            drawRays(pass, gl, rays, source, vt_groundShade, ofShade, (uint32_t)i);
        }
        vtGroundPlan_EndShade(&rays->plan, source);
        for (int i = 0; i < ofPhotons && rays->plan.hasGlass; ++i) {
            ready = drawRays(pass, gl, rays, source, vt_groundPhotons, ofPhotons, (uint32_t)i) && ready;
        }
    }
    return ready ? vt_ok : vtFail(error, vt_errorMemory, "ground: out of memory for photons");
}

/// As fine as a two hundredth of the glass, or of what else photons go through.
static float spacingOf(const vtGroundPlan* plan)
{
    return fmaxf(vtLength(vtSub(plan->glassHigh, plan->glassLow)) / 200.0f, FLT_MIN);
}

/// Where surfaces let a part of the light pass that is opaque, all of them are photons' matter.
static vtGroundScene describeScene(const vtSceneBuffer* scene)
{
    const bool all = scene->hasLooks, any = all || scene->glassCount > 0;
    vtGroundScene described = {scene->space,       scene->low,          scene->high,      {1.0f, 1.0f, 1.0f},
                               {0.0f, 0.0f, 0.0f}, scene->placedLights, scene->lightCount};
    if (any) {
        described.glassLow = all ? described.low : scene->glassMin;
        described.glassHigh = all ? described.high : scene->glassMax;
    }
    return described;
}

vtResult vtGroundPass_MakeMap(vtGroundPass* pass, const vtGL* gl, const vtSceneBuffer* scene,
                              const vtEnvironmentBuffer* environment, vtGroundMap* map,
                              vtCausticMap* caustics, vtError* error)
{
    *map = (vtGroundMap){0};
    *caustics = (vtCausticMap){0};
    const vtGroundScene described = describeScene(scene);
    Rays rays = {.framebuffer = 0};
    vtResult result = vtPlanGround(&pass->ground, &environment->light, &described, &rays.plan, error);
    if (result == vt_ok) {
        result = makeRays(&rays, gl, error);
    }
    if (result == vt_ok) {
        vtBindTraced(gl, scene, environment);
        result = followRays(pass, gl, &rays, error);
    }
    if (result == vt_ok) {
        result = vtGatherLandings(&rays.caustics, gl, scene, spacingOf(&rays.plan), caustics, error);
    }
    if (result == vt_ok) {
        result = vtGroundPlan_Finish(&rays.plan, map, error);
    }
    destroyRays(&rays, gl);
    return result;
}

vtResult vtGroundPass_Draw(vtGroundPass* pass, const vtGL* gl, const vtSceneBuffer* scene,
                           const vtEnvironmentBuffer* environment, const vtFrame* frame, vtError* error)
{
    vtGroundMap map;
    vtCausticMap caustics;
    pass->isCoarse = movingAcross < across && pass->isFresh && pass->isStale;
    pass->isFresh = true;
    vtResult result = vtGroundPass_MakeMap(pass, gl, scene, environment, &map, &caustics, error);
    if (result == vt_ok) {
        result = vtGroundBuffer_Set(&pass->buffer, gl, &map, error);
    }
    if (result == vt_ok) {
        result = vtGroundBuffer_SetCaustics(&pass->buffer, gl, &caustics, error);
    }
    vtDestroyGroundMap(&map);
    vtDestroyCausticMap(&caustics);
    pass->isStale = result != vt_ok;
    pass->frame = *frame;
    pass->frame.viewMatrix = pass->frame.projectionMatrix = NULL; // the caller's
    return result;
}

void vtGroundPass_Destroy(vtGroundPass* pass, const vtGL* gl)
{
    vtGroundBuffer_Destroy(&pass->buffer, gl);
    *pass = (vtGroundPass){0};
}
