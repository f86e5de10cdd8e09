// Pictures that ask different things of driver and memory, each drawn from a new renderer on, step by step,
// by a driver that can fail.
#pragma once

#include "base/memory.h"
#include "faulty_gl.h"
#include "lit_scenes.h"

enum { small = 24 };

// ------------------------------------------------------------------------------------------------- cases

/// VITRINE_LONG: nothing is left out.
static bool isLong(void)
{
    const char* text = getenv("VITRINE_LONG");
    return text != NULL && strcmp(text, "1") == 0;
}

/// Of all faults, each so many-th is tried.
static int faultStep(void)
{
    return isLong() ? 1 : 8;
}

/// What a picture may ask of the driver beside glass.
typedef struct Case {
    const char* name;
    vtTechnique technique;
    float roughness, dispersion;
    bool relief, opaque, picture, ground, several;
    vtBackground background;
} Case;

static const Case cases[] = {
    {.name = "kay-linear", .technique = vt_techniqueKayLinear},
    {.name = "kay-nonlinear", .technique = vt_techniqueKayNonlinear},
    {.name = "kay-thickness", .technique = vt_techniqueKayThickness},
    {.name = "single", .technique = vt_techniqueSingle},
    {.name = "wyman", .technique = vt_techniqueWyman},
    {.name = "oliveira", .technique = vt_techniqueOliveira},
    {.name = "layered", .technique = vt_techniqueLayered},
    {.name = "layered, several", .technique = vt_techniqueLayered, .several = true},
    {.name = "exact", .technique = vt_techniqueExact},
    {.name = "heightfield", .technique = vt_techniqueHeightField, .relief = true},
    {.name = "rough", .technique = vt_techniqueExact, .roughness = 0.3f},
    {.name = "dispersion", .technique = vt_techniqueExact, .dispersion = 5.0f},
    {.name = "opaque", .technique = vt_techniqueExact, .opaque = true, .picture = true},
    {.name = "blurred", .technique = vt_techniqueExact, .background = vt_backgroundBlurred},
    {.name = "backdrop", .technique = vt_techniqueExact, .picture = true, .background = vt_backgroundPicture},
    {.name = "ground", .technique = vt_techniqueExact, .ground = true, .opaque = true},
};
enum { caseCount = sizeof cases / sizeof cases[0] };

static uint8_t squares[4 * 8 * 8];

static inline vtScene makeScene(const Case* c)
{
    vtScene scene = {0};
    vtError error;
    const vtMaterial glass = vtDefaultMaterial();
    if (c->relief) {
        vtReliefDef def = vtDefaultRelief();
        vtMesh mesh;
        def.width = def.height = 16;
        assert_ok(vtCreateReliefPattern("ripples", &def, &mesh, &error), error);
        assert_ok(vtCreateMeshScene(&mesh, &glass, &scene, &error), error);
    } else {
        const vtVec3 one = {1.0f, 1.0f, 1.0f};
        addShape(&scene, "diamond", &glass, one, (vtVec3){0});
        if (c->several) {
            addShape(&scene, "cube", &glass, one, (vtVec3){1.5f, 0.0f, 0.0f});
        }
    }
    if (c->opaque) {
        const vtMaterial matt = mattOf((vtVec3){0.9f, 0.3f, 0.2f});
        if (c->picture) {
            scene.images = vtReallocate(scene.images, 1, sizeof *scene.images); // vtScene_Append made it
            scene.imageCount = 1;
            scene.images[0] = (vtImage){.pixels = vtAllocate(1, sizeof squares), .width = 8, .height = 8};
            memcpy(scene.images[0].pixels, squares, sizeof squares);
        }
        addShape(&scene, "cube", &matt, (vtVec3){0.5f, 0.5f, 0.5f}, (vtVec3){-1.0f, 0.3f, 0.0f});
        scene.materials[scene.materialCount - 1].maps[vt_mapBaseColor].image = c->picture ? 0 : -1;
    }
    assert_ok(vtPrepareScene(&scene, c->technique, NULL, &error), error);
    return scene;
}

/// A small panorama with a sun.
static inline vtEnvironment makeSky(void)
{
    uint8_t pixels[4 * 16 * 8];
    vtEnvironment sky;
    vtError error;
    for (size_t i = 0; i < sizeof pixels; ++i) {
        pixels[i] = (uint8_t)(i / 4 == 40 ? 255 : 60 + 37 * i % 90);
    }
    assert_ok(vtCreateImageEnvironment(pixels, 16, 8, "sky", &sky, &error), error);
    return sky;
}

static inline vtFrame makeFrame(const Case* c, const vtScene* scene)
{
    vtFrame frame = vtDefaultFrame();
    frame.technique = c->technique;
    frame.view = vtViewOfScene(scene, 40.0f, 1.0f);
    frame.width = frame.height = small;
    frame.samples = 2;
    frame.roughness = c->roughness > 0.0f ? c->roughness : -1.0f;
    frame.dispersion = c->dispersion > 0.0f ? c->dispersion : -1.0f;
    frame.background = c->background;
    return frame;
}

// -------------------------------------------------------------------------------------------------- plays

/// A case, and how far a renderer has come with it.
typedef struct Play {
    const Case* ofCase;
    vtScene scene;
    vtEnvironment sky;
    vtFrame frame;
    vtRenderer* shares;
    vtRenderer* renderer;
    int step;
    uint8_t pixels[4 * small * small], expected[4 * small * small];
    float directions[3 * small * small];
} Play;

static inline vtResult doStep(Play* play, vtError* error)
{
    const vtImage picture = {.pixels = squares, .width = 8, .height = 8};
    const vtGround ground = vtDefaultGround();
    switch (play->step) {
    case 0:
        return vtCreateRenderer(&(vtRendererDef){.getProcAddress = getFaulty, .shares = play->shares},
                                &play->renderer, error);
    case 1:
        return vtRenderer_SetEnvironment(play->renderer, &play->sky, error);
    case 2:
        return vtRenderer_SetScene(play->renderer, &play->scene, error);
    case 3:
        return play->ofCase->picture ? vtRenderer_SetBackground(play->renderer, &picture, error) : vt_ok;
    case 4:
        return play->ofCase->ground ? vtRenderer_SetGround(play->renderer, &ground, error) : vt_ok;
    default:
        return vtRenderer_DrawImage(play->renderer, &play->frame, play->pixels, error);
    }
}

enum { stepCount = 6 };

/// From the step that failed last on, to the picture.
static inline vtResult goOn(Play* play, vtError* error)
{
    vtResult result = vt_ok;
    for (; play->step < stepCount && result == vt_ok; play->step += result == vt_ok) {
        *error = (vtError){0};
        result = doStep(play, error);
    }
    return result;
}

static inline void assertPicture(Play* play, const char* when)
{
    if (memcmp(play->pixels, play->expected, sizeof play->expected) != 0) {
        fail_msg("%s: another picture %s", play->ofCase->name, when);
    }
}

/// The case's picture by a driver that works, and a renderer with its programs.
static inline void begin(Play* play, const Case* c)
{
    vtError error;
    *play = (Play){.ofCase = c, .scene = makeScene(c), .sky = makeSky()};
    play->frame = makeFrame(c, &play->scene);
    setFault(faultyNone, 0);
    assert_ok(goOn(play, &error), error);
    memcpy(play->expected, play->pixels, sizeof play->expected);
    play->shares = play->renderer;
    play->renderer = NULL;
    play->step = 0;
}

static inline void end(Play* play)
{
    vtDestroyRenderer(play->shares);
    vtDestroyScene(&play->scene);
    vtDestroyEnvironment(&play->sky);
}

/// Ends one renderer's part of a play.
static inline void leave(Play* play)
{
    vtDestroyRenderer(play->renderer);
    play->renderer = NULL;
    play->step = 0;
}

static inline int setUpPlays(void** state)
{
    for (size_t i = 0; i < sizeof squares; ++i) {
        squares[i] = (uint8_t)(i % 4 == 3 || (i / 4 + i / 32) % 2 == 0 ? 255 : 90);
    }
    vtContext* context = calloc(1, sizeof *context);
    vtError error;
    assert_ok(vtCreateContext(vt_backendAuto, context, &error), error);
    faulty = (FaultyGL){.getReal = context->getProcAddress};
    *state = context;
    return 0;
}

static inline int tearDownPlays(void** state)
{
    vtDestroyContext(*state);
    free(*state);
    return 0;
}
