// A program that knows Vitrine as its users do: the installed headers and library. It draws a picture where
// it has OSMesa, and else makes a scene.
#include <stdio.h>
#include <string.h>
#include <vitrine/vitrine.h>

#ifdef WITH_OSMESA
#include <GL/osmesa.h>

enum { width = 64, height = 48 };

/// How many neighbours along the rows differ: none in a picture of nothing.
static int countEdges(const uint8_t* pixels)
{
    int count = 0;
    for (int i = 1; i < width * height; ++i) {
        count += memcmp(&pixels[4 * i], &pixels[4 * (i - 1)], 3) != 0;
    }
    return count;
}

static vtResult draw(const vtScene* scene, uint8_t* pixels, vtError* error)
{
    vtEnvironment environment;
    vtRenderer* renderer;
    vtFrame frame = vtDefaultFrame();
    frame.width = width;
    frame.height = height;
    frame.view = vtViewOfScene(scene, 45.0f, (float)width / height);
    vtResult result = vtCreateEnvironment("studio", &environment, error);
    if (result == vt_ok) {
        result = vtCreateRenderer(&(vtRendererDef){.getProcAddress = OSMesaGetProcAddress}, &renderer, error);
    }
    if (result != vt_ok) {
        return result;
    }
    result = vtRenderer_SetScene(renderer, scene, error);
    if (result == vt_ok) {
        result = vtRenderer_SetEnvironment(renderer, &environment, error);
    }
    if (result == vt_ok) {
        result = vtRenderer_DrawImage(renderer, &frame, pixels, error);
    }
    vtDestroyRenderer(renderer);
    vtDestroyEnvironment(&environment);
    return result;
}

static int drawOffScreen(const vtScene* scene)
{
    static uint8_t pixels[4 * width * height];
    static const int attributes[] = {OSMESA_FORMAT,
                                     OSMESA_RGBA,
                                     OSMESA_PROFILE,
                                     OSMESA_CORE_PROFILE,
                                     OSMESA_CONTEXT_MAJOR_VERSION,
                                     3,
                                     OSMESA_CONTEXT_MINOR_VERSION,
                                     3,
                                     0};
    vtError error;
    OSMesaContext context = OSMesaCreateContextAttribs(attributes, NULL);
    if (context == NULL || !OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, width, height)) {
        fprintf(stderr, "user: no OSMesa context\n");
        return 1;
    }
    if (draw(scene, pixels, &error) != vt_ok) {
        fprintf(stderr, "user: %s\n", error.message);
        return 1;
    }
    printf("edges %d\n", countEdges(pixels));
    OSMesaDestroyContext(context);
    return 0;
}
#endif

int main(void)
{
    vtMesh mesh;
    vtScene scene;
    vtError error;
    const vtMaterial glass = vtDefaultMaterial();
    printf("header %s, library %s\n", VT_VERSION, vtVersion());
    if (vtCreateShape("knot", &mesh, &error) != vt_ok ||
        vtCreateMeshScene(&mesh, &glass, &scene, &error) != vt_ok) {
        fprintf(stderr, "user: %s\n", error.message);
        return 1;
    }
    int status = 0;
#ifdef WITH_OSMESA
    status = drawOffScreen(&scene);
#endif
    vtDestroyScene(&scene);
    return status;
}
