// A renderer with room for a small picture: what the tests that draw share.
#pragma once

#include "base/math.h"
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

/// One in the fixture's context; to be destroyed.
static inline vtRenderer* createRenderer(const Fixture* fixture)
{
    vtRenderer* renderer;
    vtError error;
    const vtRendererDef def = {.getProcAddress = fixture->context.getProcAddress};
    assert_ok(vtCreateRenderer(&def, &renderer, &error), error);
    return renderer;
}

static inline int setUp(void** state)
{
    Fixture* fixture = calloc(1, sizeof *fixture);
    vtError error;
    assert_ok(vtCreateContext(vt_backendAuto, &fixture->context, &error), error);
    fixture->renderer = createRenderer(fixture);
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

/// Unit direction through a place of the picture, pixels from its upper left corner, by the documented
/// formula.
static inline vtVec3 eyeRayAt(const vtFrame* frame, float x, float y)
{
    const vtVec3 forward = vtNormalize(vtSub(frame->view.target, frame->view.eye));
    const vtVec3 right = vtNormalize(vtCross(forward, (vtVec3){0, 1, 0}));
    const vtVec3 up = vtCross(right, forward);
    const float tangent = tanf(frame->view.fovY * VT_PI / 360.0f);
    const float across = (2.0f * x - (float)frame->width) / (float)frame->height * tangent;
    const float along = (1.0f - 2.0f * y / (float)frame->height) * tangent;
    return vtNormalize(vtMulAdd(vtMulAdd(forward, across, right), along, up));
}

/// The same of a pixel's centre, row 0 on top.
static inline vtVec3 eyeRay(const vtFrame* frame, int column, int row)
{
    return eyeRayAt(frame, (float)column + 0.5f, (float)row + 0.5f);
}

static inline float degreesBetween(vtVec3 a, vtVec3 b)
{
    return atan2f(vtLength(vtCross(a, b)), vtDot(a, b)) * 180.0f / VT_PI;
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

// ----------------------------------------------------------------------------------------------- sheets

/// A parallelogram. It faces where `across` times `up` points, and shines as if its normal were `normal`,
/// unless that is 0.
typedef struct Sheet {
    vtVec3 corner, across, up, normal;
} Sheet;

static inline vtVec3 sheetNormal(const Sheet* sheet)
{
    return vtNormalize(vtDot(sheet->normal, sheet->normal) > 0.0f ? sheet->normal
                                                                  : vtCross(sheet->across, sheet->up));
}

/// Sheets of glass as one mesh.
static inline void setSheets(vtRenderer* renderer, const Sheet* sheets, int count)
{
    static const uint32_t corners[6] = {0, 1, 2, 0, 2, 3};
    float positions[8 * 4 * 3], normals[8 * 4 * 3];
    uint32_t indices[8 * 6];
    assert_true(count <= 8);
    for (int i = 0; i < 4 * count; ++i) {
        const Sheet* sheet = &sheets[i / 4];
        const int k = i % 4;
        vtVec3 p = vtMulAdd(sheet->corner, k == 1 || k == 2 ? 1.0f : 0.0f, sheet->across);
        p = vtMulAdd(p, k >= 2 ? 1.0f : 0.0f, sheet->up);
        const vtVec3 n = sheetNormal(sheet);
        memcpy(positions + 3 * i, &p, 3 * sizeof(float));
        memcpy(normals + 3 * i, &n, 3 * sizeof(float));
    }
    for (int i = 0; i < 6 * count; ++i) {
        indices[i] = 4 * (uint32_t)(i / 6) + corners[i % 6];
    }
    vtMeshDef def = {.positions = positions,
                     .normals = normals,
                     .indices = indices,
                     .vertexCount = 4 * (uint32_t)count,
                     .indexCount = 6 * (uint32_t)count};
    vtMesh mesh;
    vtError error;
    assert_ok(vtCreateMesh(&def, "sheets", &mesh, &error), error);
    assert_ok(vtComputeInnerDistances(&mesh, &error), error);
    assert_ok(vtRenderer_SetMesh(renderer, &mesh, &error), error);
    vtDestroyMesh(&mesh);
}
