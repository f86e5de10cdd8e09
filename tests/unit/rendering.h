// A renderer with room for a small picture: what the tests that draw share.
#pragma once

#include "context/context.h"
#include "lab/reference/reference.h"
#include "scene/objects.h"
#include "testing.h"

enum { side = 128 };

typedef struct Fixture {
    vtContext context;
    vtRenderer* renderer;
    uint8_t pixels[4 * side * side];
    float directions[3 * side * side];
} Fixture;

static inline int setUp(void** state)
{
    Fixture* fixture = calloc(1, sizeof *fixture);
    vtError error;
    assert_ok(vtCreateContext(vt_backendAuto, &fixture->context, &error), error);
    assert_ok(vtCreateRenderer(&(vtRendererDef){.getProcAddress = fixture->context.getProcAddress},
                               &fixture->renderer, &error),
              error);
    *state = fixture;
    return 0;
}

static inline int tearDown(void** state)
{
    Fixture* fixture = *state;
    vtDestroyRenderer(fixture->renderer);
    vtDestroyContext(&fixture->context);
    free(fixture);
    return 0;
}

static inline void setShape(vtRenderer* renderer, const char* name)
{
    vtMesh mesh;
    vtError error;
    assert_ok(vtCreateShape(name, &mesh, &error), error);
    assert_ok(vtComputeInnerDistances(&mesh, &error), error);
    assert_ok(vtRenderer_SetMesh(renderer, &mesh, &error), error);
    vtDestroyMesh(&mesh);
}

static inline void setEnvironment(vtRenderer* renderer, const char* name)
{
    vtEnvironment environment;
    vtError error;
    assert_ok(vtCreateEnvironment(name, &environment, &error), error);
    assert_ok(vtRenderer_SetEnvironment(renderer, &environment, &error), error);
}

static inline vtFrame smallFrame(vtTechnique technique)
{
    vtFrame frame = vtDefaultFrame();
    frame.technique = technique;
    frame.width = frame.height = side;
    frame.ior = 1.5f;
    frame.fresnel = false; // paths as the reference's: they refract, or reflect where they must
    return frame;
}

/// False, and it says so, where nothing can be traced for want of Embree.
static inline bool canTrace(const vtScene* scene, const vtFrame* frame, vtReferenceImage* truth)
{
    vtReference* reference;
    vtError error;
    if (vtCreateReference(scene, &reference, &error) != vt_ok) {
        print_message("skipped: %s\n", error.message);
        return false;
    }
    assert_ok(vtReference_Trace(reference, &(vtReferenceDef){.frame = frame}, truth, &error), error);
    vtDestroyReference(reference);
    return true;
}

/// Traces a scene, or one mesh of glass; without Embree the test is skipped, the scene or mesh freed.
static inline void traceScene(vtScene* scene, const vtFrame* frame, vtReferenceImage* truth)
{
    if (!canTrace(scene, frame, truth)) {
        vtDestroyScene(scene);
        skip();
    }
}

static inline void traceMesh(vtMesh* mesh, const vtFrame* frame, vtReferenceImage* truth)
{
    vtBorrowedMesh borrowed;
    if (!canTrace(vtBorrowMesh(mesh, &borrowed), frame, truth)) {
        vtDestroyMesh(mesh);
        skip();
    }
}

/// Draws and reads both the picture and the directions.
static inline void draw(Fixture* fixture, const vtFrame* frame)
{
    vtError error;
    assert_true(frame->width * frame->height <= side * side);
    assert_ok(vtRenderer_DrawImage(fixture->renderer, frame, fixture->pixels, &error), error);
    assert_ok(vtRenderer_ReadDirections(fixture->renderer, fixture->directions, &error), error);
}

/// With one object in the scene --multi ordered draws what any does.
static inline void assertOrderedIsAny(Fixture* fixture, vtFrame frame)
{
    static uint8_t pixels[sizeof fixture->pixels];
    static float directions[sizeof fixture->directions / sizeof(float)];
    draw(fixture, &frame);
    memcpy(pixels, fixture->pixels, sizeof pixels);
    memcpy(directions, fixture->directions, sizeof directions);
    frame.multi = vt_multiOrdered;
    draw(fixture, &frame);
    assert_memory_equal(pixels, fixture->pixels, sizeof pixels);
    assert_memory_equal(directions, fixture->directions, sizeof directions);
}
