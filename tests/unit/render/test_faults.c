// A driver that fails: whichever call it is, the picture is right or there is a sentence; nothing is left
// behind, and once the driver works again so does the same renderer.
#include "plays.h"

// Sanitizers make drawing some ten times slower.
#ifdef __SANITIZE_ADDRESS__
enum { stride = 5 };
#else
enum { stride = 1 };
#endif

// ------------------------------------------------------------------------------------------------- tests

/// One line that says what was being done.
static void assertSentence(const vtError* error, const char* name)
{
    if (strlen(error->message) < 20 || strchr(error->message, '\n') != NULL ||
        (strstr(error->message, "GL") == NULL && strstr(error->message, "GPU") == NULL)) {
        fail_msg("%s: the sentence is '%s'", name, error->message);
    }
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
            failEach(&play, calls[k], stride * faultStep(), &faults);
        }
        end(&play);
    }
    print_message("%d faults\n", faults);
    assert_true(faults > 400 / (stride * faultStep()));
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
        cmocka_unit_test_setup_teardown(programsThatDoNotCompile, setUpPlays, tearDownPlays),
        cmocka_unit_test_setup_teardown(programsThatDoNotLink, setUpPlays, tearDownPlays),
        cmocka_unit_test_setup_teardown(memoryThatIsNotThere, setUpPlays, tearDownPlays),
        cmocka_unit_test_setup_teardown(groundWithoutMemory, setUpPlays, tearDownPlays),
        cmocka_unit_test_setup_teardown(contextThatIsLost, setUpPlays, tearDownPlays),
        cmocka_unit_test_setup_teardown(leastLimits, setUpPlays, tearDownPlays),
        cmocka_unit_test_setup_teardown(beyondTheLeastLimits, setUpPlays, tearDownPlays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
