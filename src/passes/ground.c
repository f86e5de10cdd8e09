#include "passes/ground.h"

#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"

/// Rays along a side of their square: 2 x 2 shade rays a texel of a sun, 8 x 8 of the sky. A page, which
/// waits for them, takes a quarter of that.
#ifdef __EMSCRIPTEN__
enum { across = 512, targetCount = 3 };
#else
enum { across = 1024, targetCount = 3 };
#endif

bool vtGroundPass_IsStale(const vtGroundPass* pass, const vtFrame* frame)
{
    return pass->isStale || pass->frame.ior != frame->ior || pass->frame.fresnel != frame->fresnel ||
           pass->frame.maxEvents < frame->maxEvents || pass->frame.technique != frame->technique;
}

void vtGroundPass_Start(vtGroundPass* pass, const vtGL* gl, vtTraceVariant variant, vtProgramList* programs)
{
    if (pass->program.name != 0 && pass->variant != variant) {
        vtProgram_Destroy(&pass->program, gl);
    }
    const vtProgramDef def = vtTracePhotons(variant);
    vtProgramList_Start(programs, &pass->program, gl, &def);
    pass->variant = variant;
}

/// What one drawing needs, and where it is read to.
typedef struct Rays {
    vtGroundPlan plan;
    vtTexture lights, targets[targetCount];
    GLuint framebuffer;
    uint32_t* words; ///< of one target
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
    vtDestroyGroundPlan(&rays->plan);
}

static float asFloat(uint32_t word)
{
    float number;
    memcpy(&number, &word, sizeof number);
    return number;
}

static void addShade(Rays* rays, vtGroundLight light)
{
    for (int i = 0; i < across * across; ++i) {
        const uint32_t state = rays->words[4 * (size_t)i + 3] >> 16;
        if (state == 1) { // out, and nothing met
            const int x = i % across, y = i / across;
            const vtGroundRay ray = vtGroundPlan_Ray(&rays->plan, light, vt_groundShade, x, y, across, 0);
            vtGroundPlan_AddLit(&rays->plan, light, &ray, x, y, across);
        }
    }
}

/// `isOwn`: of the paths themselves, which count only where they have met something.
static void addPhotons(Rays* rays, vtGroundLight light, bool isOwn, vtVec3 origin)
{
    for (int i = 0; i < across * across; ++i) {
        const uint32_t* word = rays->words + 4 * (size_t)i;
        if ((word[2] | (word[3] & 0xffffu)) == 0 || (isOwn && (word[3] & 0x20000u) == 0)) {
            continue;
        }
        const vtVec3 share =
            vtScale((vtVec3){(float)(word[2] & 0xffffu), (float)(word[2] >> 16), (float)(word[3] & 0xffffu)},
                    1.0f / 65535.0f);
        const vtGroundRay ray =
            vtGroundPlan_Ray(&rays->plan, light, vt_groundPhotons, i % across, i / across, across, 0);
        vtGroundPlan_AddPhoton(&rays->plan, light, &ray, asFloat(word[0]) + origin.x,
                               asFloat(word[1]) + origin.z, share, across);
    }
}

static void drawRays(const vtGroundPass* pass, const vtGL* gl, Rays* rays, vtVec3 origin, vtGroundLight light,
                     vtGroundRays kind)
{
    const vtGroundPlan* plan = &rays->plan;
    const vtVec3 low = vtSub(plan->glassLow, origin), high = vtSub(plan->glassHigh, origin);
    const float ground[4] = {plan->height - origin.y, plan->lowX - origin.x, plan->lowZ - origin.z,
                             plan->size};
    const float numbers[4] = {(float)(2 * light + kind), (float)kind, plan->reach, (float)across};
    const float box[8] = {low.x, low.y, low.z, 0.0f, high.x, high.y, high.z, 0.0f};
    vtBindFramebuffer(gl, rays->framebuffer, across, across);
    gl->UseProgram(pass->program.name);
    gl->Uniform4fv(pass->program.uniforms[1], 1, ground);
    gl->Uniform4fv(pass->program.uniforms[2], 1, numbers);
    gl->Uniform4fv(pass->program.uniforms[3], 2, box);
    vtTexture_Bind(&rays->lights, gl, vt_samplerGroundLights);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    const int targets = kind == vt_groundPhotons ? targetCount : 1;
    for (int i = 0; i < targets; ++i) {
        gl->ReadBuffer(GL_COLOR_ATTACHMENT0 + (GLenum)i);
        gl->ReadPixels(0, 0, across, across, GL_RGBA_INTEGER, GL_UNSIGNED_INT, rays->words);
        if (kind == vt_groundShade) {
            addShade(rays, light);
        } else {
            addPhotons(rays, light, i == 0, origin);
        }
    }
    gl->ReadBuffer(GL_COLOR_ATTACHMENT0);
}

static bool isBlack(vtVec3 c)
{
    return c.x <= 0.0f && c.y <= 0.0f && c.z <= 0.0f;
}

static void followRays(const vtGroundPass* pass, const vtGL* gl, Rays* rays, vtVec3 origin)
{
    for (int light = 0; light < vt_groundLightCount; ++light) {
        if (isBlack(rays->plan.irradiance[light])) {
            continue;
        }
        drawRays(pass, gl, rays, origin, (vtGroundLight)light, vt_groundShade);
        if (rays->plan.hasGlass) {
            drawRays(pass, gl, rays, origin, (vtGroundLight)light, vt_groundPhotons);
        }
    }
}

vtResult vtGroundPass_MakeMap(vtGroundPass* pass, const vtGL* gl, const vtSceneBuffer* scene,
                              const vtEnvironmentBuffer* environment, vtGroundMap* map, vtError* error)
{
    const vtVec3 whole[2] = {vtAdd(scene->low, scene->origin), vtAdd(scene->high, scene->origin)};
    // Where surfaces let a part of the light pass that is opaque, all of them are photons' matter.
    const bool all = scene->hasLooks;
    const vtVec3 none[2] = {{1.0f, 1.0f, 1.0f}, {0.0f, 0.0f, 0.0f}};
    const vtVec3 glass[2] = {vtAdd(scene->glassMin, scene->origin), vtAdd(scene->glassMax, scene->origin)};
    Rays rays = {.framebuffer = 0};
    vtResult result = vtPlanGround(&pass->ground, &environment->light, whole,
                                   all                     ? whole
                                   : scene->glassCount > 0 ? glass
                                                           : none,
                                   &rays.plan, error);
    if (result == vt_ok) {
        result = makeRays(&rays, gl, error);
    }
    if (result == vt_ok) {
        vtBindTraced(gl, scene, environment);
        followRays(pass, gl, &rays, scene->origin);
        result = vtGroundPlan_Finish(&rays.plan, map, error);
    }
    destroyRays(&rays, gl);
    return result;
}

vtResult vtGroundPass_Draw(vtGroundPass* pass, const vtGL* gl, const vtSceneBuffer* scene,
                           const vtEnvironmentBuffer* environment, const vtFrame* frame, vtError* error)
{
    vtGroundMap map = {0};
    vtResult result = vtGroundPass_MakeMap(pass, gl, scene, environment, &map, error);
    if (result == vt_ok) {
        result = vtGroundBuffer_Set(&pass->buffer, gl, &map, scene->origin, error);
    }
    vtDestroyGroundMap(&map);
    pass->isStale = result != vt_ok;
    pass->frame = *frame;
    pass->frame.viewMatrix = pass->frame.projectionMatrix = NULL; // the caller's
    return result;
}

void vtGroundPass_Destroy(vtGroundPass* pass, const vtGL* gl)
{
    vtProgram_Destroy(&pass->program, gl);
    vtGroundBuffer_Destroy(&pass->buffer, gl);
    *pass = (vtGroundPass){0};
}
