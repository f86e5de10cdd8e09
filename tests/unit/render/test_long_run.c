// A long run: frames of changing size, technique and scene, renderers and contexts that come and go. The same
// frame is the same picture whatever was drawn before, no GL error, no GL object is left, memory is flat:
// from a third of the run on, when the second context has drawn, too, of which Mesa 25 keeps 20 MB and of no
// later one. VITRINE_FRAMES: how many frames (900; 10,000 where VITRINE_LONG is 1; 300 under sanitizers).
// VITRINE_CURVE: a file for "frame resident-MB GL-objects" lines. Twenty rows of a table are printed:
// docs/robustness.md has them.
#include <unistd.h>

#include "faulty_gl.h"
#include "lit_scenes.h"

enum { most = 24, sizeCount = 3, sceneCount = 3, framesOfRenderer = 60, framesOfContext = 180 };

static const int sizes[sizeCount][2] = {{24, 16}, {13, 24}, {20, 20}};

/// What was drawn first for each combination.
typedef struct Seen {
    bool isThere;
    uint8_t pixels[4 * most * most];
} Seen;

static Seen seen[sceneCount][vt_techniqueCount][sizeCount];

static int readNumber(const char* name, int usual)
{
    const char* text = getenv(name);
    return text != NULL ? atoi(text) : usual;
}

static int usualFrames(void)
{
#ifdef __SANITIZE_ADDRESS__ // some ten times slower
    return 300;
#else
    return readNumber("VITRINE_LONG", 0) == 1 ? 10000 : 900;
#endif
}

/// Of this process, that is not shared with others' pages on disk.
static double residentMegabytes(void)
{
    long total = 0, resident = 0;
    FILE* file = fopen("/proc/self/statm", "r");
    if (file != NULL) {
        assert_int_equal(fscanf(file, "%ld %ld", &total, &resident), 2);
        fclose(file);
    }
    return (double)resident * (double)sysconf(_SC_PAGESIZE) / 1e6;
}

static vtScene makeScene(int which)
{
    static const char* const shapes[sceneCount] = {"diamond", "cube", "sphere"};
    const vtMaterial glass = vtDefaultMaterial(), matt = mattOf((vtVec3){0.8f, 0.4f, 0.2f});
    const vtVec3 one = {1.0f, 1.0f, 1.0f};
    vtScene scene = {0};
    vtError error;
    addShape(&scene, shapes[which], &glass, one, (vtVec3){0});
    if (which == 1) {
        addShape(&scene, "cube", &matt, (vtVec3){0.5f, 0.5f, 0.5f}, (vtVec3){-1.0f, 0.0f, 0.0f});
    }
    assert_ok(vtPrepareScene(&scene, vt_techniqueWyman, NULL, &error), error);
    return scene;
}

typedef struct Run {
    vtContext context;
    vtRenderer* renderer;
    vtScene scene;
    int which;
} Run;

/// A new context, a new renderer or another scene, where it is time for one.
static void change(Run* run, int frame)
{
    vtError error;
    const bool newContext = frame % framesOfContext == 0, newRenderer = frame % framesOfRenderer == 0;
    if (newRenderer) {
        vtDestroyRenderer(run->renderer);
        run->renderer = NULL;
        assert_int_equal(objectsAlive(), 0);
    }
    if (newContext) {
        vtDestroyContext(&run->context);
        assert_ok(vtCreateContext(vt_backendAuto, &run->context, &error), error);
        faulty = (FaultyGL){.getReal = run->context.getProcAddress};
    }
    if (newRenderer) {
        const vtRendererDef def = {.getProcAddress = getFaulty};
        assert_ok(vtCreateRenderer(&def, &run->renderer, &error), error);
        setEnvironment(run->renderer, "sky");
    }
    if (newRenderer || frame % 7 == 0) {
        vtDestroyScene(&run->scene);
        run->which = frame / 7 % sceneCount;
        run->scene = makeScene(run->which);
        assert_ok(vtRenderer_SetScene(run->renderer, &run->scene, &error), error);
    }
}

static void drawNext(Run* run, int number)
{
    static uint8_t pixels[4 * most * most];
    vtError error;
    vtFrame frame = vtDefaultFrame();
    // Every order of sizes and techniques comes by in time.
    const int size = number * 5 / 3 % sizeCount;
    frame.technique = (vtTechnique)(number * 7 / 2 % vt_techniqueCount);
    frame.width = sizes[size][0];
    frame.height = sizes[size][1];
    frame.samples = 1 + number % 2;
    frame.view = vtViewOfScene(&run->scene, 40.0f, 1.0f);
    assert_ok(vtRenderer_DrawImage(run->renderer, &frame, pixels, &error), error);
    Seen* before = &seen[run->which][frame.technique][size];
    if (frame.samples > 1) {
        return;
    }
    if (before->isThere) {
        const size_t bytes = 4 * (size_t)frame.width * (size_t)frame.height;
        if (memcmp(before->pixels, pixels, bytes) != 0) {
            fail_msg("frame %d: another picture of technique %s, size %d than before", number,
                     vtTechnique_Info(frame.technique)->id, size);
        }
    }
    before->isThere = true;
    memcpy(before->pixels, pixels, sizeof pixels);
}

static void everyFrameIsAsBefore(void** state)
{
    (void)state;
    Run run = {.which = -1};
    const int frames = readNumber("VITRINE_FRAMES", usualFrames());
    const char* path = getenv("VITRINE_CURVE");
    FILE* curve = path != NULL ? fopen(path, "w") : NULL;
    double early = 0.0, late = 0.0;
    for (int i = 0; i < frames; ++i) {
        change(&run, i);
        drawNext(&run, i);
        if (i == frames / 3 || i == frames - 1) {
            *(i == frames - 1 ? &late : &early) = residentMegabytes();
        }
        if ((i + 1) % (frames / 20 + (frames < 20)) == 0) {
            print_message("| %d | %.1f | %d |\n", i + 1, residentMegabytes(), objectsAlive());
        }
        if (curve != NULL && i % (frames / 200 + 1) == 0) {
            fprintf(curve, "%d %.2f %d\n", i, residentMegabytes(), objectsAlive());
        }
    }
    if (curve != NULL) {
        fclose(curve);
    }
    vtDestroyRenderer(run.renderer);
    assert_int_equal(objectsAlive(), 0);
    vtDestroyContext(&run.context);
    vtDestroyScene(&run.scene);
    print_message("%d frames: %.1f MB resident after a third, %.1f MB at the end\n", frames, early, late);
#ifndef __SANITIZE_ADDRESS__ // which keeps what was freed
    assert_true(late - early < 16.0);
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(everyFrameIsAsBefore)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
