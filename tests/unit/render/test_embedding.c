// Glass in a host's program: in its context, whatever state that is in, and into its picture.
#include <math.h>
#include <string.h>

#include "base/math.h"
#include "gl/gl.h"
#include "image/image.h"
#include "rendering.h"
#include "scene/camera.h"

#define VT_HOSTILE_UNITS 32

typedef struct Host {
    vtGL gl;
    GLuint framebuffer, color, depth; // drawn into
    GLuint behindColor, behindDepth;  // read from
    GLuint sampler, buffer, array, texture;
} Host;

static void loadHost(const Fixture* fixture, Host* host)
{
    vtError error;
    *host = (Host){0};
    assert_ok(vtLoadGL(fixture->context.getProcAddress, &host->gl, &error), error);
}

static GLuint makeTexture(const vtGL* gl, GLenum format, int width, int height)
{
    GLuint name;
    gl->GenTextures(1, &name);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, name);
    gl->TexStorage2D(GL_TEXTURE_2D, 1, format, width, height); // filtered with mipmaps that it does not have
    return name;
}

/// A framebuffer with colour and depth of its own.
static void makeTarget(Host* host, int width, int height)
{
    const vtGL* gl = &host->gl;
    host->color = makeTexture(gl, GL_RGBA8, width, height);
    host->depth = makeTexture(gl, GL_DEPTH_COMPONENT32F, width, height);
    gl->GenFramebuffers(1, &host->framebuffer);
    gl->BindFramebuffer(GL_FRAMEBUFFER, host->framebuffer);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, host->color, 0);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, host->depth, 0);
    assert_int_equal(gl->CheckFramebufferStatus(GL_FRAMEBUFFER), GL_FRAMEBUFFER_COMPLETE);
}

static void freeHost(Host* host)
{
    const vtGL* gl = &host->gl;
    const GLuint textures[] = {host->color, host->depth, host->behindColor, host->behindDepth, host->texture};
    gl->DeleteTextures(5, textures);
    gl->DeleteFramebuffers(1, &host->framebuffer);
    gl->DeleteBuffers(1, &host->buffer);
    gl->DeleteSamplers(1, &host->sampler);
    gl->DeleteVertexArrays(1, &host->array);
}

/// All that a host may have left on, or bound.
static void makeHostile(Host* host)
{
    const vtGL* gl = &host->gl;
    const GLenum switches[] = {GL_BLEND,
                               GL_CULL_FACE,
                               GL_DEPTH_TEST,
                               GL_POLYGON_OFFSET_FILL,
                               GL_SCISSOR_TEST,
                               GL_STENCIL_TEST,
                               GL_RASTERIZER_DISCARD,
                               GL_SAMPLE_COVERAGE,
                               GL_SAMPLE_ALPHA_TO_COVERAGE};
    for (size_t i = 0; i < sizeof switches / sizeof switches[0]; ++i) {
        gl->Enable(switches[i]);
    }
    gl->DepthFunc(GL_NEVER);
    gl->DepthMask(GL_FALSE);
    gl->FrontFace(GL_CW);
    gl->ColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
    gl->PixelStorei(GL_UNPACK_ROW_LENGTH, 7);
    gl->PixelStorei(GL_UNPACK_SKIP_ROWS, 3);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 8);
    gl->PixelStorei(GL_PACK_SKIP_PIXELS, 5);
    if (host->sampler == 0) {
        gl->GenSamplers(1, &host->sampler);
        gl->SamplerParameteri(host->sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        gl->GenBuffers(1, &host->buffer);
        gl->GenVertexArrays(1, &host->array);
        host->texture = makeTexture(gl, GL_RGBA8, 4, 4);
    }
    for (GLuint unit = 0; unit < VT_HOSTILE_UNITS; ++unit) {
        gl->BindSampler(unit, host->sampler);
        gl->ActiveTexture(GL_TEXTURE0 + unit);
        gl->BindTexture(GL_TEXTURE_2D, host->texture);
    }
    gl->BindVertexArray(host->array);
    gl->BindBuffer(GL_PIXEL_UNPACK_BUFFER, host->buffer);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, host->buffer);
    gl->BindBuffer(GL_UNIFORM_BUFFER, host->buffer);
    gl->Enable(0xDEAD); // and an error that nobody asked for
}

static vtFrame makeFrame(vtTechnique technique)
{
    vtFrame frame = vtDefaultFrame();
    frame.technique = technique;
    frame.width = frame.height = side;
    return frame;
}

static void createScene(vtScene* scene)
{
    vtError error;
    vtMesh mesh;
    const vtMaterial glass = vtDefaultMaterial();
    assert_ok(vtCreateShape("knot", &mesh, &error), error);
    assert_ok(vtComputeInnerDistances(&mesh, &error), error);
    assert_ok(vtCreateMeshScene(&mesh, &glass, scene, &error), error);
    vtScene plane;
    vtMaterial opaque = vtDefaultMaterial();
    opaque.opaque = true;
    opaque.checker = 4.0f;
    assert_ok(vtCreateShape("plane", &mesh, &error), error);
    assert_ok(vtCreateMeshScene(&mesh, &opaque, &plane, &error), error);
    vtTransform place = vtIdentityTransform();
    place.rows[2][3] = -3.0f;
    assert_ok(vtScene_Append(scene, &plane, &place, &error), error);
}

/// Everything, from the first upload on, in a context that was left in a bad state before each call.
static void hostileStateDoesNotMatter(void** state)
{
    Fixture* fixture = *state;
    static uint8_t clean[4 * side * side];
    const vtTechnique techniques[] = {vt_techniqueExact, vt_techniqueLayered, vt_techniqueWyman,
                                      vt_techniqueKayNonlinear};
    Host host;
    vtError error;
    vtScene scene;
    vtEnvironment environment;
    loadHost(fixture, &host);
    createScene(&scene);
    assert_ok(vtCreateEnvironment("studio", &environment, &error), error);
    for (size_t i = 0; i < sizeof techniques / sizeof techniques[0]; ++i) {
        vtFrame frame = makeFrame(techniques[i]);
        vtRenderer* renderer = createRenderer(fixture);
        assert_ok(vtRenderer_SetScene(renderer, &scene, &error), error);
        assert_ok(vtRenderer_SetEnvironment(renderer, &environment, &error), error);
        assert_ok(vtRenderer_DrawImage(renderer, &frame, clean, &error), error);
        vtDestroyRenderer(renderer);

        makeHostile(&host);
        renderer = createRenderer(fixture);
        makeHostile(&host);
        assert_ok(vtRenderer_SetScene(renderer, &scene, &error), error);
        makeHostile(&host);
        assert_ok(vtRenderer_SetEnvironment(renderer, &environment, &error), error);
        for (int samples = 1; samples <= 2; ++samples) {
            frame.samples = samples;
            makeHostile(&host);
            assert_ok(vtRenderer_DrawImage(renderer, &frame, fixture->pixels, &error), error);
            if (samples == 1) {
                assert_memory_equal(fixture->pixels, clean, sizeof clean);
            }
            makeHostile(&host);
            assert_ok(vtRenderer_ReadDirections(renderer, fixture->directions, &error), error);
        }
        vtDestroyRenderer(renderer);
    }
    vtDestroyScene(&scene);
    freeHost(&host);
}

static GLint getInteger(const vtGL* gl, GLenum what)
{
    GLint value = -1;
    gl->GetIntegerv(what, &value);
    return value;
}

/// What vitrine.h says the host finds afterwards.
static void stateAfterwardsIsAsDocumented(void** state)
{
    Fixture* fixture = *state;
    Host host;
    vtError error;
    setShape(fixture->renderer, "torus");
    loadHost(fixture, &host);
    makeTarget(&host, side, side);
    makeHostile(&host);
    vtFrame frame = makeFrame(vt_techniqueLayered);
    frame.framebuffer = host.framebuffer;
    assert_ok(vtRenderer_Draw(fixture->renderer, &frame, &error), error);
    const vtGL* gl = &host.gl;
    const struct {
        GLenum what;
        GLint value;
    } expected[] = {{GL_VERTEX_ARRAY_BINDING, 0},
                    {GL_ARRAY_BUFFER_BINDING, 0},
                    {GL_UNIFORM_BUFFER_BINDING, 0},
                    {GL_PIXEL_UNPACK_BUFFER_BINDING, 0},
                    {GL_PIXEL_PACK_BUFFER_BINDING, 0},
                    {GL_CURRENT_PROGRAM, 0},
                    {GL_ACTIVE_TEXTURE, GL_TEXTURE0},
                    {GL_SAMPLER_BINDING, 0},
                    {GL_DRAW_FRAMEBUFFER_BINDING, (GLint)host.framebuffer},
                    {GL_READ_FRAMEBUFFER_BINDING, (GLint)host.framebuffer},
                    {GL_DEPTH_FUNC, GL_LESS},
                    {GL_DEPTH_WRITEMASK, GL_TRUE},
                    {GL_FRONT_FACE, GL_CCW},
                    {GL_BLEND, 0},
                    {GL_CULL_FACE, 0},
                    {GL_DEPTH_TEST, 0},
                    {GL_DITHER, 0},
                    {GL_POLYGON_OFFSET_FILL, 0},
                    {GL_RASTERIZER_DISCARD, 0},
                    {GL_SAMPLE_ALPHA_TO_COVERAGE, 0},
                    {GL_SAMPLE_COVERAGE, 0},
                    {GL_SCISSOR_TEST, 0},
                    {GL_STENCIL_TEST, 0},
                    {GL_UNPACK_ALIGNMENT, 4},
                    {GL_UNPACK_ROW_LENGTH, 0},
                    {GL_UNPACK_SKIP_ROWS, 0},
                    {GL_PACK_ALIGNMENT, 4},
                    {GL_PACK_SKIP_PIXELS, 0}};
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; ++i) {
        if (getInteger(gl, expected[i].what) != expected[i].value) {
            fail_msg("GL state 0x%04x is 0x%x, not 0x%x", (unsigned)expected[i].what,
                     (unsigned)getInteger(gl, expected[i].what), (unsigned)expected[i].value);
        }
    }
    assert_int_equal(gl->GetError(), GL_NO_ERROR);
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
    freeHost(&host);
}

// -------------------------------------------------------------------------------------- views as matrices

typedef struct Matrices {
    float view[16], projection[16];
} Matrices;

/// Of a frame's eye and target, as a host has them.
static Matrices matricesOf(const vtFrame* frame, float near, float far)
{
    const vtCamera camera = vtMakeCamera(frame);
    const vtVec3 r = camera.right, u = camera.up, f = camera.forward, e = camera.eye;
    const float x = camera.high[0], y = camera.high[1];
    return (Matrices){
        {r.x, u.x, -f.x, 0, r.y, u.y, -f.y, 0, r.z, u.z, -f.z, 0, -vtDot(r, e), -vtDot(u, e), vtDot(f, e), 1},
        {1 / x, 0, 0, 0, 0, 1 / y, 0, 0, 0, 0, -(far + near) / (far - near), -1, 0, 0,
         -2 * far * near / (far - near), 0}};
}

static void readTarget(const Host* host, int x, int y, int width, int height, uint8_t* pixels)
{
    host->gl.BindFramebuffer(GL_FRAMEBUFFER, host->framebuffer);
    host->gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    host->gl.ReadPixels(x, y, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
}

/// The first row on top, as vtRenderer_DrawImage gives it.
static void flip(uint8_t* pixels, int width, int height)
{
    for (int top = 0; top < height / 2; ++top) {
        for (int i = 0; i < 4 * width; ++i) {
            uint8_t *a = pixels + 4 * width * top + i, *b = pixels + 4 * width * (height - 1 - top) + i;
            const uint8_t swapped = *a;
            *a = *b;
            *b = swapped;
        }
    }
}

static int countDifferent(const uint8_t* a, const uint8_t* b, size_t pixels, int least)
{
    int count = 0;
    for (size_t i = 0; i < pixels; ++i) {
        int most = 0;
        for (int k = 0; k < 3; ++k) {
            most = abs(a[4 * i + k] - b[4 * i + k]) > most ? abs(a[4 * i + k] - b[4 * i + k]) : most;
        }
        count += most >= least;
    }
    return count;
}

static void matricesSeeWhatEyeAndTargetSee(void** state)
{
    Fixture* fixture = *state;
    static uint8_t byView[4 * side * side];
    const vtTechnique techniques[] = {vt_techniqueExact, vt_techniqueLayered, vt_techniqueSingle};
    vtError error;
    setShape(fixture->renderer, "torus");
    for (int i = 0; i < 3; ++i) {
        vtFrame frame = makeFrame(techniques[i]);
        const Matrices m = matricesOf(&frame, 0.1f, 100.0f);
        assert_ok(vtRenderer_DrawImage(fixture->renderer, &frame, byView, &error), error);
        frame.viewMatrix = m.view;
        frame.projectionMatrix = m.projection;
        frame.view = (vtView){{9, 9, 9}, {9, 9, 9}, 45.0f}; // not looked at
        assert_ok(vtRenderer_DrawImage(fixture->renderer, &frame, fixture->pixels, &error), error);
        assert_true(countDifferent(byView, fixture->pixels, side * side, 3) <= side * side / 500);
    }
}

/// The right half of a picture by an off-axis projection, and the whole turned upside down by a roll.
static void offAxisAndRolledViews(void** state)
{
    Fixture* fixture = *state;
    static uint8_t whole[4 * side * side], half[4 * side * side];
    vtError error;
    setShape(fixture->renderer, "torus");
    vtFrame frame = makeFrame(vt_techniqueExact);
    Matrices m = matricesOf(&frame, 0.1f, 100.0f);
    assert_ok(vtRenderer_DrawImage(fixture->renderer, &frame, whole, &error), error);
    frame.viewMatrix = m.view;
    frame.projectionMatrix = m.projection;
    m.projection[0] *= 2.0f; // from the middle to the right side
    m.projection[8] = 1.0f;
    frame.width = side / 2;
    assert_ok(vtRenderer_DrawImage(fixture->renderer, &frame, half, &error), error);
    int differing = 0;
    for (int row = 0; row < side; ++row) {
        differing +=
            countDifferent(whole + 4 * (side * row + side / 2), half + 4 * side / 2 * row, side / 2, 3);
    }
    assert_true(differing <= side * side / 500);

    frame.width = side;
    m = matricesOf(&frame, 0.1f, 100.0f); // of matrices as they are: eye and target are not looked at
    m.projection[0] = m.projection[5] = 1.0f / tanf(22.5f * VT_PI / 180.0f);
    m.projection[8] = 0.0f;
    for (int column = 0; column < 4; ++column) { // half a turn about the line of sight
        m.view[4 * column] = -m.view[4 * column];
        m.view[4 * column + 1] = -m.view[4 * column + 1];
    }
    assert_ok(vtRenderer_DrawImage(fixture->renderer, &frame, half, &error), error);
    flip(half, side, side);
    differing = 0;
    for (int i = 0; i < side * side; ++i) {
        const int mirrored = i / side * side + side - 1 - i % side;
        differing += countDifferent(whole + 4 * i, half + 4 * mirrored, 1, 3);
    }
    assert_true(differing <= side * side / 500);
}

/// Parallel rays onto a cube's face go straight on: the picture behind it is that without it, sides apart.
static void orthographicRaysAreParallel(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    setShape(fixture->renderer, "cube");
    vtFrame frame = makeFrame(vt_techniqueExact);
    frame.fresnel = false;
    const Matrices m = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -4, 1},
                        {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -0.2f, 0, 0, 0, -1, 1}};
    frame.viewMatrix = m.view;
    frame.projectionMatrix = m.projection;
    draw(fixture, &frame);
    int seen = 0;
    for (int i = 0; i < side * side; ++i) {
        const float* d = fixture->directions + 3 * i;
        if (d[0] != 0.0f || d[1] != 0.0f || d[2] != 0.0f) {
            ++seen;
            assert_near(d[2], -1.0f, 1e-5f);
        }
    }
    vtMesh cube;
    assert_ok(vtCreateShape("cube", &cube, &error), error);
    const float across = cube.boundsMax.x - cube.boundsMin.x, down = cube.boundsMax.y - cube.boundsMin.y;
    const float share = fminf(across, 2.0f) * fminf(down, 2.0f) / 4.0f;
    vtDestroyMesh(&cube);
    assert_near((float)seen / (side * side), share, 0.03f);
    frame.technique = vt_techniqueLayered;
    assert_int_equal(vtRenderer_DrawImage(fixture->renderer, &frame, fixture->pixels, &error),
                     vt_errorArgument);
    assert_non_null(strstr(error.message, "orthographic"));
}

static void badMatricesAreRefused(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    setShape(fixture->renderer, "cube");
    vtFrame frame = makeFrame(vt_techniqueExact);
    const Matrices good = matricesOf(&frame, 0.1f, 100.0f);
    const struct {
        int matrix, element;
        float value;
    } faults[] = {{0, 0, 2.0f},  {0, 3, 0.5f},  {0, 12, NAN},  {1, 0, 0.0f},     {1, 1, 0.1f},
                  {1, 5, -1.0f}, {1, 14, 0.0f}, {1, 11, 1.0f}, {1, 10, INFINITY}};
    for (size_t i = 0; i < sizeof faults / sizeof faults[0]; ++i) {
        Matrices m = good;
        (faults[i].matrix == 0 ? m.view : m.projection)[faults[i].element] = faults[i].value;
        frame.viewMatrix = m.view;
        frame.projectionMatrix = m.projection;
        assert_int_equal(vtRenderer_DrawImage(fixture->renderer, &frame, fixture->pixels, &error),
                         vt_errorArgument);
        assert_non_null(strstr(error.message, "matrix"));
    }
    frame.viewMatrix = NULL;
    frame.projectionMatrix = good.projection;
    assert_int_equal(vtRenderer_DrawImage(fixture->renderer, &frame, fixture->pixels, &error),
                     vt_errorArgument);
}

// ------------------------------------------------------------------------------- into the host's picture

enum { redHalf = 0xC0, greenHalf = 0x90 };

/// Left half red, right half green, with a depth of its own for each half.
static void fillHalves(const vtGL* gl, GLuint color, GLuint depth, float left, float right)
{
    static uint8_t colors[4 * side * side];
    static float depths[side * side];
    for (int i = 0; i < side * side; ++i) {
        const bool isLeft = i % side < side / 2;
        const uint8_t pixel[4] = {isLeft ? redHalf : 0, isLeft ? 0 : greenHalf, 0, 255};
        memcpy(colors + 4 * i, pixel, 4);
        depths[i] = isLeft ? left : right;
    }
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl->BindTexture(GL_TEXTURE_2D, color);
    gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, side, side, GL_RGBA, GL_UNSIGNED_BYTE, colors);
    gl->BindTexture(GL_TEXTURE_2D, depth);
    gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, side, side, GL_DEPTH_COMPONENT, GL_FLOAT, depths);
}

/// What the host's depth buffer holds of a depth in front of the eye.
static float windowDepth(const Matrices* m, float depth)
{
    return 0.5f * (m->projection[14] / depth - m->projection[10]) + 0.5f;
}

/// A host that has drawn a wall, red and green, 3 behind the middle, and a frame over it.
static vtFrame beginOverlay(const Fixture* fixture, Host* host, Matrices* m, vtTechnique technique)
{
    loadHost(fixture, host);
    makeTarget(host, side, side);
    host->behindColor = makeTexture(&host->gl, GL_RGBA8, side, side);
    host->behindDepth = makeTexture(&host->gl, GL_DEPTH_COMPONENT32F, side, side);
    vtFrame frame = makeFrame(technique);
    frame.view = (vtView){{0, 0, 4}, {0, 0, 0}, 45.0f};
    *m = matricesOf(&frame, 0.1f, 100.0f);
    frame.viewMatrix = m->view;
    frame.projectionMatrix = m->projection;
    frame.framebuffer = host->framebuffer;
    frame.overlay = true;
    frame.hostColor = host->behindColor;
    frame.hostDepth = host->behindDepth;
    frame.fresnel = false;
    const float wall = windowDepth(m, 7.0f);
    fillHalves(&host->gl, host->behindColor, host->behindDepth, wall, wall);
    fillHalves(&host->gl, host->color, host->depth, wall, wall);
    return frame;
}

static const uint8_t* pixelAt(const Fixture* fixture, int x, int y)
{
    return fixture->pixels + 4 * (side * y + x);
}

static void drawOver(Fixture* fixture, const Host* host, const vtFrame* frame)
{
    vtError error;
    assert_ok(vtRenderer_Draw(fixture->renderer, frame, &error), error);
    assert_int_equal(host->gl.GetError(), GL_NO_ERROR);
    readTarget(host, 0, 0, side, side, fixture->pixels);
}

static void glassOfAirChangesNothing(void** state)
{
    Fixture* fixture = *state;
    static uint8_t before[4 * side * side];
    const vtTechnique techniques[] = {vt_techniqueExact, vt_techniqueLayered, vt_techniqueSingle};
    setShape(fixture->renderer, "torus");
    for (int i = 0; i < 6; ++i) {
        Host host;
        Matrices m;
        vtFrame frame = beginOverlay(fixture, &host, &m, techniques[i % 3]);
        frame.ior = 1.0f;
        frame.exposure = 1.5f; // not for the host's light
        frame.samples = i < 3 ? 1 : 4;
        frame.hostDepth = i % 2 == 0 ? frame.hostDepth : 0;
        readTarget(&host, 0, 0, side, side, before);
        drawOver(fixture, &host, &frame);
        assert_true(countDifferent(before, fixture->pixels, side * side, 3) <=
                    (i < 3 ? 0 : side)); // the middle's line
        host.gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
        freeHost(&host);
    }
}

/// A ball turns the wall behind it round: red is right, far from where the ray entered.
static void aBallTurnsThePictureRound(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    vtRenderer* shared =
        fixture->renderer; // this one has drawn nothing else, so its paths are of the overlay
    fixture->renderer = createRenderer(fixture);
    setShape(fixture->renderer, "sphere");
    for (int i = 0; i < 2; ++i) {
        Host host;
        Matrices m;
        vtFrame frame = beginOverlay(fixture, &host, &m, i == 0 ? vt_techniqueExact : vt_techniqueLayered);
        drawOver(fixture, &host, &frame);
        const uint8_t *left = pixelAt(fixture, side / 2 - side / 8, side / 2),
                      *right = pixelAt(fixture, side / 2 + side / 8, side / 2);
        assert_int_equal(left[0], 0);
        assert_int_equal(left[1], greenHalf);
        assert_int_equal(right[0], redHalf);
        assert_int_equal(right[1], 0);
        assert_int_equal(pixelAt(fixture, 2, side / 2)[0], redHalf); // beside the ball
        assert_ok(vtRenderer_ReadDirections(fixture->renderer, fixture->directions, &error), error);
        const float* d = fixture->directions + 3 * (side * side / 2 + side / 2);
        assert_near(d[0] * d[0] + d[1] * d[1] + d[2] * d[2], 1.0f, 1e-4f);
        assert_int_equal(pixelAt(fixture, side - 3, side / 2)[1], greenHalf);
        host.gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
        freeHost(&host);
    }
    vtDestroyRenderer(fixture->renderer);
    fixture->renderer = shared;
}

/// Where the ball is, and not beside it.
static void tonesOfWhatIsDrawnOverAreMapped(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "sphere");
    for (int i = 0; i < 4; ++i) {
        Host host;
        Matrices m;
        uint8_t plain[4];
        vtFrame frame =
            beginOverlay(fixture, &host, &m, i % 2 == 0 ? vt_techniqueExact : vt_techniqueLayered);
        frame.samples = i < 2 ? 1 : 2;
        drawOver(fixture, &host, &frame);
        memcpy(plain, pixelAt(fixture, side / 2 - side / 8, side / 2), 4);
        frame.toneMapping = vt_toneMappingAces;
        drawOver(fixture, &host, &frame);
        const vtVec3 shown = vtToneMap(frame.toneMapping, (vtVec3){vtSrgbToLinear((float)plain[0] / 255.0f),
                                                                   vtSrgbToLinear((float)plain[1] / 255.0f),
                                                                   vtSrgbToLinear((float)plain[2] / 255.0f)});
        assert_near((float)pixelAt(fixture, side / 2 - side / 8, side / 2)[1],
                    255.0f * vtLinearToSrgb(shown.y), 1.1f);
        assert_true(fabsf(shown.y - vtSrgbToLinear((float)plain[1] / 255.0f)) > 0.02f);
        assert_int_equal(pixelAt(fixture, 2, side / 2)[0], redHalf);
        host.gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
        freeHost(&host);
    }
}

/// Hidden by a depth texture, and by the framebuffer's own depth; an eye ray's hit is 3 from the eye in the
/// middle.
static void whatIsBeforeTheGlassHidesIt(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "sphere");
    for (int i = 0; i < 4; ++i) {
        Host host;
        Matrices m;
        vtFrame frame =
            beginOverlay(fixture, &host, &m, i % 2 == 0 ? vt_techniqueExact : vt_techniqueLayered);
        const float near = windowDepth(&m, 2.0f), wall = windowDepth(&m, 7.0f);
        if (i < 2) {
            fillHalves(&host.gl, host.behindColor, host.behindDepth, near, wall);
        } else {
            fillHalves(&host.gl, host.color, host.depth, near, wall);
        }
        drawOver(fixture, &host, &frame);
        assert_int_equal(pixelAt(fixture, side / 2 - side / 8, side / 2)[0], redHalf); // as the host left it
        assert_int_equal(pixelAt(fixture, side / 2 - side / 8, side / 2)[1], 0);
        assert_int_not_equal(pixelAt(fixture, side / 2 + side / 8, side / 2)[1], greenHalf);
        host.gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
        freeHost(&host);
    }
}

/// The depth that is written hides what the host draws behind it afterwards: here a second frame of ours.
static void aSecondPassGoesOnFromThere(void** state)
{
    Fixture* fixture = *state;
    static uint8_t first[4 * side * side];
    Host host;
    Matrices m;
    vtError error;
    setShape(fixture->renderer, "sphere");
    vtFrame frame = beginOverlay(fixture, &host, &m, vt_techniqueExact);
    vtEnvironment environment;
    assert_ok(vtCreateEnvironment("checker", &environment, &error), error);
    assert_ok(vtRenderer_SetEnvironment(fixture->renderer, &environment, &error), error);
    drawOver(fixture, &host, &frame);
    memcpy(first, fixture->pixels, sizeof first);
    frame.hostColor = frame.hostDepth = 0; // what comes next shows the environment
    const vtInstanceId ball = vtRenderer_SceneInstance(fixture->renderer, 0);
    vtInstanceDef def;
    assert_ok(vtRenderer_GetInstance(fixture->renderer, ball, &def, &error), error);
    def.toWorld.rows[2][3] = -0.5f;
    assert_ok(vtRenderer_SetInstance(fixture->renderer, ball, &def, &error), error);
    drawOver(fixture, &host, &frame);
    assert_true(countDifferent(first, fixture->pixels, side * side, 3) <= side); // its rim looks out at most
    def.toWorld.rows[2][3] = 0.5f;
    assert_ok(vtRenderer_SetInstance(fixture->renderer, ball, &def, &error), error);
    drawOver(fixture, &host, &frame);
    assert_true(countDifferent(first, fixture->pixels, side * side, 3) > side * side / 10);
    host.gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    freeHost(&host);
}

static void aPartOfTheFramebufferIsDrawnTo(void** state)
{
    Fixture* fixture = *state;
    enum { more = 40, offsetX = 25, offsetY = 7 };
    static uint8_t offscreen[4 * side * side], all[4 * (side + more) * (side + more)];
    Host host;
    vtError error;
    setShape(fixture->renderer, "torus");
    loadHost(fixture, &host);
    makeTarget(&host, side + more, side + more);
    for (int samples = 1; samples <= 3; samples += 2) {
        vtFrame frame = makeFrame(vt_techniqueExact);
        frame.samples = samples;
        assert_ok(vtRenderer_DrawImage(fixture->renderer, &frame, offscreen, &error), error);
        const float grey[4] = {0.5f, 0.5f, 0.5f, 0.5f};
        host.gl.BindFramebuffer(GL_FRAMEBUFFER, host.framebuffer);
        host.gl.ClearBufferfv(GL_COLOR, 0, grey);
        frame.framebuffer = host.framebuffer;
        frame.x = offsetX;
        frame.y = offsetY;
        assert_ok(vtRenderer_Draw(fixture->renderer, &frame, &error), error);
        readTarget(&host, offsetX, offsetY, side, side, fixture->pixels);
        flip(fixture->pixels, side, side);
        assert_memory_equal(fixture->pixels, offscreen, sizeof offscreen);
        readTarget(&host, 0, 0, side + more, side + more, all);
        int untouched = 0;
        for (int i = 0; i < (side + more) * (side + more); ++i) {
            untouched += all[4 * i + 3] == 128;
        }
        assert_int_equal(untouched, (side + more) * (side + more) - side * side);
    }
    host.gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    freeHost(&host);
}

static void linearLightIsNotCut(void** state)
{
    Fixture* fixture = *state;
    static float pixels[4 * side * side];
    Host host;
    vtError error;
    setShape(fixture->renderer, "torus");
    vtEnvironment environment;
    assert_ok(vtCreateEnvironment("studio", &environment, &error), error);
    assert_ok(vtRenderer_SetEnvironment(fixture->renderer, &environment, &error), error);
    loadHost(fixture, &host);
    const vtGL* gl = &host.gl;
    host.color = makeTexture(gl, GL_RGBA16F, side, side);
    gl->GenFramebuffers(1, &host.framebuffer);
    gl->BindFramebuffer(GL_FRAMEBUFFER, host.framebuffer);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, host.color, 0);
    if (gl->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        freeHost(&host);
        skip();
    }
    for (int samples = 1; samples <= 2; ++samples) {
        vtFrame frame = makeFrame(vt_techniqueExact);
        frame.framebuffer = host.framebuffer;
        frame.linear = true;
        frame.samples = samples;
        frame.exposure = 2.0f;
        assert_ok(vtRenderer_Draw(fixture->renderer, &frame, &error), error);
        gl->ReadPixels(0, 0, side, side, GL_RGBA, GL_FLOAT, pixels);
        float most = 0.0f;
        for (int i = 0; i < 4 * side * side; ++i) {
            most = fmaxf(most, pixels[i]);
        }
        assert_true(most > 4.0f);
    }
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
    freeHost(&host);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hostileStateDoesNotMatter),
        cmocka_unit_test(stateAfterwardsIsAsDocumented),
        cmocka_unit_test(matricesSeeWhatEyeAndTargetSee),
        cmocka_unit_test(offAxisAndRolledViews),
        cmocka_unit_test(orthographicRaysAreParallel),
        cmocka_unit_test(badMatricesAreRefused),
        cmocka_unit_test(glassOfAirChangesNothing),
        cmocka_unit_test(aBallTurnsThePictureRound),
        cmocka_unit_test(tonesOfWhatIsDrawnOverAreMapped),
        cmocka_unit_test(whatIsBeforeTheGlassHidesIt),
        cmocka_unit_test(aSecondPassGoesOnFromThere),
        cmocka_unit_test(aPartOfTheFramebufferIsDrawnTo),
        cmocka_unit_test(linearLightIsNotCut),
    };
    return cmocka_run_group_tests(tests, setUp, tearDown);
}
