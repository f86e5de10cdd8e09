// Memory that is out while something is drawn: each picture is repeated with the first allocation failing,
// then the second and so on, alone and with all that follow. It is right or the result is vt_errorMemory, the
// same renderer goes on to the right picture once there is memory, and all that was taken is given back.
#include "base/error.h"
#include "failing_memory.h"
#include "plays.h"

// Sanitizers make drawing some ten times slower.
#ifdef __SANITIZE_ADDRESS__
enum { stride = 5 };
#else
enum { stride = 1 };
#endif

/// The n-th allocation fails, then the play goes on to its end. False where there is no n-th.
static bool failAt(Play* play, long failing, bool lasting)
{
    vtError error;
    const long blocks = memory.live;
    const int objects = objectsAlive();
    failFrom(failing, lasting);
    const vtResult result = goOn(play, &error);
    failNone();
    const bool failed = memory.calls > failing;
    if (result != vt_ok && (result != vt_errorMemory || strlen(error.message) < 20 || !failed)) {
        fail_msg("%s, allocation %ld: result %d, '%s'", play->ofCase->name, failing, result, error.message);
    }
    if (result == vt_ok) {
        assertPicture(play, "though nothing was said");
    }
    play->step = play->step < stepCount ? play->step : stepCount - 1;
    assert_ok(goOn(play, &error), error);
    assertPicture(play, "once there is memory");
    leave(play);
    if (memory.live != blocks || objectsAlive() != objects) {
        fail_msg("%s, allocation %ld of step %d: %ld blocks and %d objects of GL are left",
                 play->ofCase->name, failing, play->step, memory.live - blocks, objectsAlive() - objects);
    }
    return failed;
}

/// Every allocation, or each `step`-th, alone, and some with all that follow.
static long failEach(Play* play, long step)
{
    long faults = 0;
    for (int lasting = 0; lasting < 2; ++lasting) {
        const long each = lasting && !isLong() ? 4 * step : step;
        for (long failing = lasting * step / 2; failAt(play, failing, lasting); failing += each) {
            ++faults;
        }
    }
    return faults;
}

static void picturesWithoutMemory(void** state)
{
    static Play play;
    long faults = 0;
    (void)state;
    for (int i = 0; i < caseCount; ++i) {
        if (cases[i].ground) { // it has a test of its own
            continue;
        }
        begin(&play, &cases[i]);
        faults += failEach(&play, stride * faultStep());
        end(&play);
    }
    print_message("%ld allocations failed\n", faults);
    assert_true(faults > 700 / (stride * faultStep()));
}

// --------------------------------------------------------------------------------------------- changes

/// Calls that come after the first picture.
typedef struct Changes {
    Play play;
    vtMesh cube;
    vtInstanceDef def;
    vtGeometryId geometry;
    vtInstanceId instance;
    float floats[4 * small * small], directions[3 * small * small];
    uint32_t states[small * small];
} Changes;

static vtResult addGeometry(Changes* all, vtError* error)
{
    return vtRenderer_AddGeometry(all->play.renderer, &all->cube, &all->geometry, error);
}

static vtResult updateGeometry(Changes* all, vtError* error)
{
    return vtRenderer_UpdateGeometry(all->play.renderer, all->geometry, &all->cube, error);
}

static vtResult addInstance(Changes* all, vtError* error)
{
    all->def = vtDefaultInstance();
    all->def.geometry = all->geometry;
    all->def.toWorld.rows[0][3] = 0.4f;
    return vtRenderer_AddInstance(all->play.renderer, &all->def, &all->instance, error);
}

/// A handle of the scene's is made when it is first asked for; zero is the answer where memory is out.
static vtResult moveOfScene(Changes* all, vtError* error)
{
    const vtInstanceId id = vtRenderer_SceneInstance(all->play.renderer, 0);
    if (id.index1 == 0) {
        return vtFail(error, vt_errorMemory, "no memory for the handle, the test says");
    }
    vtResult result = vtRenderer_GetInstance(all->play.renderer, id, &all->def, error);
    all->def.toWorld.rows[1][3] = 0.2f;
    return result == vt_ok ? vtRenderer_SetInstance(all->play.renderer, id, &all->def, error) : result;
}

static vtResult updateScene(Changes* all, vtError* error)
{
    return vtRenderer_UpdateScene(all->play.renderer, &all->play.scene, error);
}

static vtResult setImages(Changes* all, vtError* error)
{
    const vtScene* scene = &all->play.scene;
    return vtRenderer_SetImages(all->play.renderer, scene->images, scene->imageCount, error);
}

static vtResult setBackdrop(Changes* all, vtError* error)
{
    const vtImage picture = {.pixels = squares, .width = 8, .height = 8};
    return vtRenderer_SetBackdrop(all->play.renderer, &picture, NULL, error);
}

static vtResult prepare(Changes* all, vtError* error)
{
    bool ready;
    return vtRenderer_Prepare(all->play.renderer, &all->play.frame, &ready, error);
}

static vtResult drawFloats(Changes* all, vtError* error)
{
    return vtRenderer_DrawFloats(all->play.renderer, &all->play.frame, all->floats, error);
}

static vtResult readDirections(Changes* all, vtError* error)
{
    return vtRenderer_ReadDirections(all->play.renderer, all->directions, error);
}

static vtResult readStates(Changes* all, vtError* error)
{
    return vtRenderer_ReadStates(all->play.renderer, all->states, error);
}

static vtResult removeGeometry(Changes* all, vtError* error)
{
    return vtRenderer_RemoveGeometry(all->play.renderer, all->geometry, error);
}

static vtResult drawImage(Changes* all, vtError* error)
{
    return vtRenderer_DrawImage(all->play.renderer, &all->play.frame, all->play.pixels, error);
}

typedef vtResult Change(Changes* all, vtError* error);

static Change* const changes[] = {updateScene, moveOfScene,    addGeometry,    updateGeometry, addInstance,
                                  drawFloats,  setImages,      setBackdrop,    prepare,        drawFloats,
                                  readStates,  readDirections, removeGeometry, drawImage};
enum { changeCount = sizeof changes / sizeof changes[0] };

/// The change that fails is made again once there is memory. False where there is no n-th allocation.
static bool changeAll(Changes* all, long failing, bool lasting)
{
    vtError error;
    Play* play = &all->play;
    play->step = 0;
    assert_ok(goOn(play, &error), error);
    failFrom(failing, lasting);
    for (int i = 0; i < changeCount; ++i) {
        vtResult result = changes[i](all, &error);
        if (result == vt_errorMemory && failing >= 0 && memory.calls > failing) {
            failNone();
            result = changes[i](all, &error);
        }
        if (result != vt_ok) {
            fail_msg("allocation %ld, change %d: result %d, '%s'", failing, i, result, error.message);
        }
    }
    failNone();
    return memory.calls > failing;
}

static void changesWithoutMemory(void** state)
{
    static Changes all;
    static Changes expected;
    vtError error;
    long faults = 0;
    (void)state;
    begin(&all.play, &cases[12]);
    assert_true(all.play.ofCase->opaque && all.play.ofCase->picture);
    assert_ok(vtCreateShape("cube", &all.cube, &error), error);
    changeAll(&all, -1, false);
    leave(&all.play);
    expected = all;
    const long blocks = memory.live;
    for (int lasting = 0; lasting < 2; ++lasting) {
        bool failed = true;
        for (long failing = 0; failed; failing += stride) {
            failed = changeAll(&all, failing, lasting);
            assert_memory_equal(all.play.pixels, expected.play.pixels, sizeof all.play.pixels);
            assert_memory_equal(all.floats, expected.floats, sizeof all.floats);
            assert_memory_equal(all.states, expected.states, sizeof all.states);
            assert_memory_equal(all.directions, expected.directions, sizeof all.directions);
            leave(&all.play);
            assert_int_equal(memory.live, blocks);
            faults += failed;
        }
    }
    print_message("%ld allocations failed\n", faults);
    assert_true(faults > 40 / stride);
    vtDestroyMesh(&all.cube);
    end(&all.play);
}

// ---------------------------------------------------------------------------------------------- the rest

/// A ground takes seconds: a few of its allocations, or all of them where VITRINE_LONG asks for it.
static void groundWithoutMemory(void** state)
{
    static Play play;
    long faults = 0;
    (void)state;
    if (stride > 1) { // half a minute then
        skip();
    }
    begin(&play, &cases[caseCount - 1]);
    assert_true(play.ofCase->ground);
    if (isLong()) {
        faults = failEach(&play, 1);
    } else {
        for (; faults < 3; ++faults) {
            assert_true(failAt(&play, 40 + 20 * faults, true));
        }
    }
    print_message("%ld allocations failed\n", faults);
    end(&play);
}

/// And that of programs, which the renderers above share.
static void programsWithoutMemory(void** state)
{
    static Play play;
    (void)state;
    begin(&play, &cases[8]);
    vtRenderer* shared = play.shares;
    play.shares = NULL;
    const long faults = failEach(&play, 6 * stride);
    play.shares = shared;
    print_message("%ld allocations failed\n", faults);
    end(&play);
}

static int setUpMemory(void** state)
{
    return vtSetAllocator(&counting, NULL) == vt_ok ? setUpPlays(state) : 1;
}

static int tearDownMemory(void** state)
{
    tearDownPlays(state);
    assert_int_equal(memory.live, 0);
    return vtSetAllocator(NULL, NULL) == vt_ok ? 0 : 1;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(picturesWithoutMemory, setUpMemory, tearDownMemory),
        cmocka_unit_test_setup_teardown(changesWithoutMemory, setUpMemory, tearDownMemory),
        cmocka_unit_test_setup_teardown(groundWithoutMemory, setUpMemory, tearDownMemory),
        cmocka_unit_test_setup_teardown(programsWithoutMemory, setUpMemory, tearDownMemory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
