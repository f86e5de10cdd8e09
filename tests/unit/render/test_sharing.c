// Renderers of one context share their programs.
#include <GLES3/gl3.h>

#include "rendering.h"

static vtGetProcAddressFcn* getReal;
static PFNGLCREATEPROGRAMPROC createProgram;
static int programsMade;

static GLuint countProgram(void)
{
    ++programsMade;
    return createProgram();
}

static vtProc getCounting(const char* name)
{
    return strcmp(name, "glCreateProgram") == 0 ? (vtProc)countProgram : getReal(name);
}

static void setScene(vtRenderer* renderer, const char* shape, const char* environment)
{
    setShape(renderer, shape);
    setEnvironment(renderer, environment);
}

// Made for the first, used by the second, kept for it when the first goes; what the first never asked for is
// made anew.
static void programsAreMadeOnce(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    vtRenderer *first, *second;
    vtFrame frame = smallFrame(vt_techniqueExact);
    uint8_t* alone = malloc(sizeof fixture->pixels);
    getReal = fixture->context.getProcAddress;
    createProgram = (PFNGLCREATEPROGRAMPROC)getReal("glCreateProgram");
    vtRendererDef def = {.getProcAddress = getCounting};
    assert_ok(vtCreateRenderer(&def, &first, &error), error);
    setScene(first, "goblet", "sky");
    assert_ok(vtRenderer_DrawImage(first, &frame, alone, &error), error);
    assert_int_equal(programsMade, 2); // trace and present

    def.shares = first;
    assert_ok(vtCreateRenderer(&def, &second, &error), error);
    setScene(second, "torus", "checker");
    assert_ok(vtRenderer_DrawImage(second, &frame, fixture->pixels, &error), error);
    assert_int_equal(programsMade, 2);
    frame.toneMapping = vt_toneMappingAces;
    assert_ok(vtRenderer_DrawImage(second, &frame, fixture->pixels, &error), error);
    assert_int_equal(programsMade, 3);

    vtDestroyRenderer(first);
    setScene(second, "goblet", "sky");
    frame = smallFrame(vt_techniqueExact);
    assert_ok(vtRenderer_DrawImage(second, &frame, fixture->pixels, &error), error);
    assert_int_equal(programsMade, 3);
    assert_memory_equal(alone, fixture->pixels, sizeof fixture->pixels);
    vtDestroyRenderer(second);
    free(alone);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(programsAreMadeOnce, setUp, tearDown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
