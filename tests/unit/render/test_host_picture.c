// What glass sees of a host's picture: blurred, beyond what a ray passes behind, and of what is opaque.
#include <string.h>

#include "gl/gl.h"
#include "rendering.h"

// A host's picture with depth, looked at from (0, 0, 4) at 45 degrees, and what it draws over that.
typedef struct Host {
    vtGL gl;
    GLuint color, depth, target, framebuffer;
    float view[16], projection[16];
} Host;

static const float nearPlane = 0.1f, farPlane = 100.0f, wallDepth = 9.0f;

static GLuint makeTexture(const vtGL* gl, int levels, GLenum format)
{
    GLuint name;
    gl->GenTextures(1, &name);
    gl->BindTexture(GL_TEXTURE_2D, name);
    gl->TexStorage2D(GL_TEXTURE_2D, levels, format, side, side);
    return name;
}

/// One colour in a level of the picture.
static void fillLevel(const Host* host, int level, const uint8_t* rgb)
{
    static uint8_t pixels[4 * side * side];
    for (int i = 0; i < side * side; ++i) {
        memcpy(pixels + 4 * i, rgb, 3);
        pixels[4 * i + 3] = 255;
    }
    host->gl.BindTexture(GL_TEXTURE_2D, host->color);
    host->gl.TexSubImage2D(GL_TEXTURE_2D, level, 0, 0, side >> level, side >> level, GL_RGBA,
                           GL_UNSIGNED_BYTE, pixels);
}

/// A red wall, with a post of that depth before its middle, as wide as so many pixels on either side.
static void fillPicture(const Host* host, float postDepth, int halfWidth)
{
    static float depths[side * side];
    static const uint8_t red[3] = {200, 0, 0};
    for (int i = 0; i < side * side; ++i) {
        const bool isPost = abs(i % side - side / 2) < halfWidth;
        const float depth = isPost ? postDepth : wallDepth;
        depths[i] = 0.5f * (host->projection[14] / depth - host->projection[10]) + 0.5f;
    }
    fillLevel(host, 0, red);
    host->gl.BindTexture(GL_TEXTURE_2D, host->depth);
    host->gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, side, side, GL_DEPTH_COMPONENT, GL_FLOAT, depths);
}

static void createHost(const Fixture* fixture, Host* host)
{
    vtError error;
    *host = (Host){0};
    assert_ok(vtLoadGL(fixture->context.getProcAddress, &host->gl, &error), error);
    const vtGL* gl = &host->gl;
    gl->ActiveTexture(GL_TEXTURE0);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    host->color = makeTexture(gl, 8, GL_RGBA8);
    host->depth = makeTexture(gl, 1, GL_DEPTH_COMPONENT32F);
    host->target = makeTexture(gl, 1, GL_RGBA8);
    gl->GenFramebuffers(1, &host->framebuffer);
    gl->BindFramebuffer(GL_FRAMEBUFFER, host->framebuffer);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, host->target, 0);
    const float scale = 1.0f / tanf(0.125f * VT_PI);
    const float a = (farPlane + nearPlane) / (nearPlane - farPlane),
                b = 2.0f * farPlane * nearPlane / (nearPlane - farPlane);
    const float view[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -4, 1};
    const float projection[16] = {scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, a, -1, 0, 0, b, 0};
    memcpy(host->view, view, sizeof view);
    memcpy(host->projection, projection, sizeof projection);
    fillPicture(host, wallDepth, 0);
}

static void destroyHost(const Host* host)
{
    const GLuint textures[] = {host->color, host->depth, host->target};
    host->gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    host->gl.DeleteTextures(3, textures);
    host->gl.DeleteFramebuffers(1, &host->framebuffer);
}

static vtFrame frameOver(const Host* host)
{
    vtFrame frame = smallFrame(vt_techniqueExact);
    frame.ior = 0.0f;
    frame.viewMatrix = host->view;
    frame.projectionMatrix = host->projection;
    frame.framebuffer = host->framebuffer;
    frame.overlay = true;
    frame.hostColor = host->color;
    frame.hostDepth = host->depth;
    return frame;
}

/// Draws over a target of that blue, and reads it.
static void drawOver(Fixture* fixture, const Host* host, const vtFrame* frame)
{
    static uint8_t blue[4 * side * side];
    vtError error;
    for (int i = 0; i < side * side; ++i) {
        blue[4 * i + 2] = 100;
    }
    host->gl.BindTexture(GL_TEXTURE_2D, host->target);
    host->gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, side, side, GL_RGBA, GL_UNSIGNED_BYTE, blue);
    assert_ok(vtRenderer_Draw(fixture->renderer, frame, &error), error);
    host->gl.ReadPixels(0, 0, side, side, GL_RGBA, GL_UNSIGNED_BYTE, fixture->pixels);
    assert_int_equal(host->gl.GetError(), GL_NO_ERROR);
}

static const uint8_t* pixelAt(const Fixture* fixture, int x, int y)
{
    return fixture->pixels + 4 * (side * y + x);
}

/// Level 0 is red, all others are green: rough glass looks into them, where they are told of.
static void roughGlassSeesLevels(void** state)
{
    Fixture* fixture = *state;
    Host host;
    createHost(fixture, &host);
    static const uint8_t green[3] = {0, 200, 0};
    for (int level = 1; level < 8; ++level) {
        fillLevel(&host, level, green);
    }
    setShape(fixture->renderer, "sphere");
    for (int i = 0; i < 4; ++i) {
        vtFrame frame = frameOver(&host);
        frame.roughness = i % 2 == 0 ? 0.0f : 0.4f;
        frame.hostLevels = i >= 2;
        drawOver(fixture, &host, &frame);
        const uint8_t* middle = pixelAt(fixture, side / 2, side / 2);
        assert_int_equal(middle[0] > 100, i != 3);
        assert_int_equal(middle[1] > 100, i == 3);
    }
    destroyHost(&host);
}

/// A ball turns the picture round: light at its right comes from the left of the wall, behind a post before
/// the ball.
static void raysGoOnBeyondWhatTheyPassBehind(void** state)
{
    Fixture* fixture = *state;
    Host host;
    createHost(fixture, &host);
    setShape(fixture->renderer, "sphere");
    setEnvironment(fixture->renderer, "checker");
    fillPicture(&host, 2.0f, 4);
    const vtFrame frame = frameOver(&host);
    drawOver(fixture, &host, &frame);
    for (int i = 0; i < 2; ++i) {
        const uint8_t* seen = pixelAt(fixture, side / 2 + (2 * i - 1) * side / 8, side / 2);
        assert_near(seen[0], 200.0f, 1.0f);
        assert_int_equal(seen[1], 0);
    }
    assert_int_equal(pixelAt(fixture, side / 2, side / 2)[2], 100); // the post
    destroyHost(&host);
}

/// A green thing behind a thin pane that covers its left half.
static void setPaneBeforeThing(Fixture* fixture, bool unlit)
{
    vtScene scene = {0};
    vtError error;
    vtMaterial materials[2] = {vtDefaultMaterial(), vtDefaultMaterial()};
    materials[0].thin = true;
    materials[1].opaque = true;
    materials[1].unlit = unlit;
    materials[1].baseColor = (vtVec3){0.0f, 0.5f, 0.0f};
    for (uint32_t i = 0; i < 2; ++i) {
        vtMesh mesh;
        vtObject object = {.toWorld = vtIdentityTransform()};
        assert_ok(vtCreateShape("plane", &mesh, &error), error);
        object.toWorld.rows[0][3] = i == 0 ? -mesh.boundsMax.x : 0.0f;
        object.toWorld.rows[2][3] = i == 0 ? 0.0f : 4.0f - wallDepth;
        assert_ok(vtScene_AddMesh(&scene, &mesh, &object.mesh, &error), error);
        assert_ok(vtScene_AddMaterial(&scene, &materials[i], &object.material, &error), error);
        assert_ok(vtScene_AddObject(&scene, &object, NULL, &error), error);
    }
    assert_ok(vtRenderer_SetScene(fixture->renderer, &scene, &error), error);
    vtDestroyScene(&scene);
}

/// That thing is where the host has drawn a red one.
static void whatIsOpaqueCanBeTheHosts(void** state)
{
    Fixture* fixture = *state;
    Host host;
    createHost(fixture, &host);
    setEnvironment(fixture->renderer, "studio");
    for (int i = 0; i < 4; ++i) {
        setPaneBeforeThing(fixture, i != 3);         // shaded by looks.glsl, or by shading.glsl
        fillPicture(&host, 2.0f, i == 2 ? side : 0); // the wall is hidden by what fills the picture
        vtFrame frame = frameOver(&host);
        frame.hostOpaque = i > 0;
        frame.overlay = i != 2;
        frame.background = vt_backgroundTransparent;
        drawOver(fixture, &host, &frame);
        const uint8_t *behind = pixelAt(fixture, side / 2 - side / 12, side / 2),
                      *beside = pixelAt(fixture, side / 2 + side / 12, side / 2);
        const bool isHosts = i % 2 == 1;
        assert_int_equal(behind[0] > 150, isHosts);
        assert_int_equal(behind[1] > 150, !isHosts);
        assert_int_equal(beside[1] > 150, i == 0);
        assert_int_equal(beside[2], isHosts ? 100 : 0);
    }
    destroyHost(&host);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(roughGlassSeesLevels),
        cmocka_unit_test(raysGoOnBeyondWhatTheyPassBehind),
        cmocka_unit_test(whatIsOpaqueCanBeTheHosts),
    };
    return cmocka_run_group_tests(tests, setUp, tearDown);
}
