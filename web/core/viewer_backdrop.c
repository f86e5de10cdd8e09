// The picture behind a viewer's scene, which the page puts into its texture by itself: a video's frames never
// come through the core's memory. Calls are like those of viewer.c.
#include <emscripten.h>

#include "core/viewer.h"
#include "render/renderer.h"

#if VT_IS_FULL
/// GL's name of the texture for a picture of that size, sRGB with all its levels, which the page fills; 0:
/// see vtViewer_Error.
EMSCRIPTEN_KEEPALIVE unsigned vtViewer_SizeBackdrop(vtViewer* viewer, int width, int height)
{
    const vtResult result = vtRenderer_SizeBackdrop(viewer->renderer, width, height, &viewer->error);
    return result == vt_ok ? viewer->renderer->backdropPicture.name : 0;
}

/// Shows it at that distance, 0: beyond all glass, its part from left and top to right and bottom filling the
/// canvas. Below 0: there is none any more.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_SetBackdrop(vtViewer* viewer, float distance, float left, float top,
                                                      float right, float bottom)
{
    const vtBackdrop backdrop = {distance, {left, top, right, bottom}};
    const vtResult result =
        vtRenderer_SetBackdrop(viewer->renderer, NULL, distance < 0.0f ? NULL : &backdrop, &viewer->error);
    viewer->changed = true;
    return result == vt_ok ? NULL : viewer->error.message;
}
#endif
