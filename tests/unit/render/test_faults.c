// A driver that fails: whichever call it is, the picture is right or there is a sentence; nothing is left
// behind, and once the driver works again so does the same renderer.
#include "base/memory.h"
#include "faulty_gl.h"
#include "lit_scenes.h"

enum { small = 24 };

// Sanitizers make drawing some ten times slower.
#ifdef __SANITIZE_ADDRESS__
enum { stride = 5 };
#else
enum { stride = 1 };
#endif

// ------------------------------------------------------------------------------------------------- cases

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

static vtScene makeScene(const Case* c)
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
            scene.images = vtAllocateZeroed(1, sizeof *scene.images);
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
static vtEnvironment makeSky(void)
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

static vtFrame makeFrame(const Case* c, const vtScene* scene)
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

static vtResult doStep(Play* play, vtError* error)
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
static vtResult goOn(Play* play, vtError* error)
{
    vtResult result = vt_ok;
    for (; play->step < stepCount && result == vt_ok; play->step += result == vt_ok) {
        *error = (vtError){0};
        result = doStep(play, error);
    }
    return result;
}

static void assertPicture(Play* play, const char* when)
{
    if (memcmp(play->pixels, play->expected, sizeof play->expected) != 0) {
        fail_msg("%s: another picture %s", play->ofCase->name, when);
    }
}

/// One line that says what was being done.
static void assertSentence(const vtError* error, const char* name)
{
    if (strlen(error->message) < 20 || strchr(error->message, '\n') != NULL ||
        (strstr(error->message, "GL") == NULL && strstr(error->message, "GPU") == NULL)) {
        fail_msg("%s: the sentence is '%s'", name, error->message);
    }
}

/// The case's picture by a driver that works, and a renderer with its programs.
static void begin(Play* play, const Case* c)
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

static void end(Play* play)
{
    vtDestroyRenderer(play->shares);
    vtDestroyScene(&play->scene);
    vtDestroyEnvironment(&play->sky);
}

/// Ends one renderer's part of a play.
static void leave(Play* play)
{
    vtDestroyRenderer(play->renderer);
    play->renderer = NULL;
    play->step = 0;
}

// ------------------------------------------------------------------------------------------------- tests

static int setUpFaults(void** state)
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

static int tearDownFaults(void** state)
{
    vtDestroyContext(*state);
    free(*state);
    return 0;
}

/// Each program is refused once: a sentence names it, and the next attempt draws.
static void refusePrograms(FaultyCall call, const char* words)
{
    static Play play;
    vtError error;
    vtRenderer* keeper = NULL; // of all programs
    int refusals = 0;
    faulty.failsFirst = true;
    for (int i = 0; i < caseCount; ++i) {
        play = (Play){.ofCase = &cases[i], .scene = makeScene(&cases[i]), .sky = makeSky(), .shares = keeper};
        play.frame = makeFrame(&cases[i], &play.scene);
        setFault(call, 1);
        int attempts = 0;
        for (; goOn(&play, &error) != vt_ok; ++attempts) {
            assertSentence(&error, cases[i].name);
            if (strstr(error.message, words) == NULL) {
                fail_msg("%s: '%s' has no '%s'", cases[i].name, error.message, words);
            }
            assert_true(attempts < 20);
        }
        refusals += attempts;
        setFault(faultyNone, 0);
        memcpy(play.expected, play.pixels, sizeof play.pixels);
        assert_ok(vtRenderer_DrawImage(play.renderer, &play.frame, play.pixels, &error), error);
        assertPicture(&play, "after refusals");
        vtDestroyRenderer(keeper);
        keeper = play.renderer;
        vtDestroyScene(&play.scene);
        vtDestroyEnvironment(&play.sky);
    }
    faulty.failsFirst = false;
    print_message("%d refusals\n", refusals);
    assert_true(refusals > 15);
    vtDestroyRenderer(keeper);
    assert_int_equal(objectsAlive(), 0);
}

static void programsThatDoNotCompile(void** state)
{
    (void)state;
    refusePrograms(faultyCompileShader, "the driver's own words");
}

static void programsThatDoNotLink(void** state)
{
    (void)state;
    faulty.knownCount = 0;
    refusePrograms(faultyLinkProgram, "does not link");
}

/// The n-th of those calls fails, and the rest is as it should be. False where there is no n-th.
static bool failAt(Play* play, FaultyCall call, int n)
{
    vtError error;
    const int before = objectsAlive();
    setFault(call, n);
    const vtResult result = goOn(play, &error);
    const bool failed = hasFailed();
    if (result != vt_ok) {
        assertSentence(&error, play->ofCase->name);
        assert_true(result == vt_errorMemory || result == vt_errorContext);
    } else {
        assertPicture(play, "though nothing was said");
    }
    setFault(faultyNone, 0);
    play->step = play->step < stepCount ? play->step : stepCount - 1;
    assert_ok(goOn(play, &error), error);
    assertPicture(play, "once the driver works again");
    leave(play);
    if (objectsAlive() != before) {
        fail_msg("%s: %d objects are left behind", play->ofCase->name, objectsAlive() - before);
    }
    return failed;
}

static void failEach(Play* play, FaultyCall call, int step, int* faults)
{
    for (int n = 1; failAt(play, call, n); n += step) {
        ++*faults;
    }
}

static void memoryThatIsNotThere(void** state)
{
    static const FaultyCall calls[] = {
        faultyTexStorage2D,   faultyTexStorage3D, faultyBufferData,        faultyCheckFramebufferStatus,
        faultyGenerateMipmap, faultyReadPixels,   faultyCopyTexSubImage2D, faultyTexSubImage2D,
        faultyTexSubImage3D,  faultyDrawArrays,   faultyDrawElements,      faultyBufferSubData};
    static Play play;
    int faults = 0;
    (void)state;
    for (int i = 0; i < caseCount; ++i) {
        if (cases[i].ground) { // it has a test of its own
            continue;
        }
        begin(&play, &cases[i]);
        for (size_t k = 0; k < sizeof calls / sizeof calls[0]; ++k) {
            failEach(&play, calls[k], stride, &faults);
        }
        end(&play);
    }
    print_message("%d faults\n", faults);
    assert_true(faults > 400 / stride);
    assert_int_equal(objectsAlive(), 0);
}

/// What a ground alone asks for: rays' targets, their framebuffer, what is read back of them.
static void groundWithoutMemory(void** state)
{
    static Play play;
    (void)state;
    if (stride > 1) { // a ground takes seconds then
        skip();
    }
    begin(&play, &cases[caseCount - 1]);
    assert_true(play.ofCase->ground);
    assert_true(failAt(&play, faultyReadPixels, 2));
    assert_true(failAt(&play, faultyTexStorage2D, 16));
    end(&play);
    assert_int_equal(objectsAlive(), 0);
}

/// From some call on nothing is done any more: a sentence, nothing crashes, all is given back.
static void contextThatIsLost(void** state)
{
    static Play play;
    vtError error;
    int losses = 0;
    (void)state;
    for (int i = 0; i < caseCount; ++i) {
        if (cases[i].ground) {
            continue;
        }
        begin(&play, &cases[i]);
        const int before = objectsAlive();
        bool lost = true;
        for (int n = 1; lost; n += 7 * stride) {
            setFault(faultyEvery, n);
            const vtResult result = goOn(&play, &error);
            lost = hasFailed();
            if (lost && result == vt_ok) {
                fail_msg("%s: nothing is said of a context that was lost", cases[i].name);
            } else if (lost) {
                assertSentence(&error, cases[i].name);
                losses += strstr(error.message, "context was lost") != NULL;
            }
            leave(&play);
            assert_int_equal(objectsAlive(), before);
        }
        setFault(faultyNone, 0);
        end(&play);
    }
    print_message("%d sentences say that it was lost\n", losses);
    assert_true(losses > 100 / stride);
}

/// No more than what every OpenGL ES 3.0 and WebGL 2 has: the same pictures.
static void leastLimits(void** state)
{
    static Play play;
    vtError error;
    (void)state;
    for (int i = 0; i < caseCount; ++i) {
        if (cases[i].ground && stride > 1) {
            continue;
        }
        begin(&play, &cases[i]);
        vtDestroyRenderer(play.shares); // programs, too
        play.shares = NULL;
        faulty.isTiny = true;
        assert_ok(goOn(&play, &error), error);
        assertPicture(&play, "within the least limits");
        leave(&play);
        faulty.isTiny = false;
        end(&play);
        if (faulty.refused) {
            fail_msg("%s: asks for more than the least limits", cases[i].name);
        }
    }
}

/// And what goes beyond them, a sentence that says by what.
static void beyondTheLeastLimits(void** state)
{
    static Play play;
    static float row[3 * 4096 * 2];
    vtError error;
    (void)state;
    begin(&play, &cases[8]);
    faulty.isTiny = true;
    assert_ok(goOn(&play, &error), error);
    vtFrame frame = play.frame;
    uint8_t* pixels = malloc(4 * (size_t)2100 * small);
    frame.width = 2100;
    assert_int_equal(vtRenderer_DrawImage(play.renderer, &frame, pixels, &error), vt_errorContext);
    assert_string_equal(error.message, "frame: 2100 x 24 is more than this GPU's largest texture (2048); ask "
                                       "for a smaller picture");
    vtEnvironment wide = {.kind = vt_environmentImage, .width = 4096, .height = 2, .pixels = row};
    assert_int_equal(vtRenderer_SetEnvironment(play.renderer, &wide, &error), vt_errorContext);
    assert_non_null(strstr(error.message, "4096 x 2 is more than this GPU's largest texture (2048)"));
    const vtImage picture = {.pixels = (uint8_t*)row, .width = 4096, .height = 2};
    assert_int_equal(vtRenderer_SetBackground(play.renderer, &picture, &error), vt_errorContext);
    assert_non_null(strstr(error.message, "4096 x 2 is more than this GPU's largest texture (2048)"));
    play.step = stepCount - 1;
    assert_ok(goOn(&play, &error), error);
    assertPicture(&play, "after what was too large");
    free(pixels);
    leave(&play);
    faulty.isTiny = faulty.refused = false;
    end(&play);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(programsThatDoNotCompile, setUpFaults, tearDownFaults),
        cmocka_unit_test_setup_teardown(programsThatDoNotLink, setUpFaults, tearDownFaults),
        cmocka_unit_test_setup_teardown(memoryThatIsNotThere, setUpFaults, tearDownFaults),
        cmocka_unit_test_setup_teardown(groundWithoutMemory, setUpFaults, tearDownFaults),
        cmocka_unit_test_setup_teardown(contextThatIsLost, setUpFaults, tearDownFaults),
        cmocka_unit_test_setup_teardown(leastLimits, setUpFaults, tearDownFaults),
        cmocka_unit_test_setup_teardown(beyondTheLeastLimits, setUpFaults, tearDownFaults),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
