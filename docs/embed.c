// Vitrine in a program of your own, in 70 lines: make a context current, create a renderer, give it a scene
// and an environment, draw. Only vitrine.h is needed; the context here comes from native/context/context.h so
// that the example runs anywhere, your program has its own (GLFW, SDL, EGL, a browser canvas).
#include <stdio.h>
#include <stdlib.h>
#include <vitrine/vitrine.h>

#include "context/context.h"

static int fail(const char* doing, const vtError* error)
{
    fprintf(stderr, "%s: %s\n", doing, error->message);
    return 1;
}

/// Adds a built-in shape to a scene.
static vtResult add(vtScene* scene, const char* shape, const vtMaterial* material, float z, vtError* error)
{
    vtMesh mesh;
    vtObject object = {.toWorld = vtIdentityTransform()};
    object.toWorld.rows[2][3] = z;
    vtResult result = vtCreateShape(shape, &mesh, error);
    result = result == vt_ok ? vtScene_AddMesh(scene, &mesh, &object.mesh, error) : result;
    result = result == vt_ok ? vtScene_AddMaterial(scene, material, &object.material, error) : result;
    return result == vt_ok ? vtScene_AddObject(scene, &object, NULL, error) : result;
}

int main(int argc, char** argv)
{
    enum { width = 320, height = 240 };
    vtError error;

    // 1. A current GL context.
    vtContext context;
    if (vtCreateContext(vt_backendAuto, &context, &error) != vt_ok) {
        return fail("context", &error);
    }

    // 2. The renderer, with the context's function loader.
    vtRenderer* renderer;
    if (vtCreateRenderer(&(vtRendererDef){.getProcAddress = context.getProcAddress}, &renderer, &error) !=
        vt_ok) {
        return fail("renderer", &error);
    }

    // 3. What to draw. The renderer copies; nothing needs to be kept.
    vtScene scene = {0};
    vtEnvironment environment;
    vtMaterial glass = vtDefaultMaterial(), clay = vtDefaultMaterial();
    glass.ior = 1.52f;
    clay.opaque = true;
    clay.baseColor = (vtVec3){0.8f, 0.3f, 0.1f};
    if (add(&scene, "goblet", &glass, 0.0f, &error) != vt_ok ||
        add(&scene, "knot", &clay, -2.5f, &error) != vt_ok ||
        vtCreateEnvironment("studio", &environment, &error) != vt_ok ||
        vtRenderer_SetScene(renderer, &scene, &error) != vt_ok ||
        vtRenderer_SetEnvironment(renderer, &environment, &error) != vt_ok) {
        return fail("scene", &error);
    }

    // 4. One frame. vtRenderer_Draw would draw it into a framebuffer of yours; this reads it back.
    vtFrame frame = vtDefaultFrame();
    frame.width = width;
    frame.height = height;
    frame.view = vtViewOfScene(&scene, 45.0f, (float)width / height);
    static uint8_t pixels[width * height * 4];
    if (vtRenderer_DrawImage(renderer, &frame, pixels, &error) != vt_ok) {
        return fail("draw", &error);
    }

    FILE* file = argc > 1 ? fopen(argv[1], "wb") : NULL;
    if (file != NULL) {
        fprintf(file, "P6 %d %d 255\n", width, height);
        for (int i = 0; i < width * height; ++i) {
            fwrite(&pixels[4 * i], 1, 3, file);
        }
        fclose(file);
    }

    // 5. In the reverse order, with the context still current.
    vtDestroyRenderer(renderer);
    vtDestroyScene(&scene);
    vtDestroyEnvironment(&environment);
    vtDestroyContext(&context);
    return 0;
}
