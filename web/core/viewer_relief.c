// Reliefs of a viewer's scene. The one added last is kept, so that its depth can be a slider. The calls are
// like those of viewer.c.
#include <emscripten.h>
#include <stdlib.h>

#include "core/viewer.h"
#include "image/image.h"
#include "relief/relief.h"

static vtReliefDef makeReliefDef(const vtObjectSpec* spec, int pattern)
{
    vtReliefDef def = vtDefaultRelief();
    def.depth = pattern >= 0 ? vtReliefPatternDepth(pattern) : def.depth;
    vtObjectSpec_ApplyToRelief(spec, &def);
    return def;
}

/// Keeps a relief of depth 1.
static void keep(vtViewer* viewer, const vtMesh* unit, int source, const vtReliefDef* def)
{
    vtDestroyMesh(&viewer->kept.unit);
    viewer->kept = (vtKeptRelief){*unit, source, def->smoothing, def->width};
}

static bool keeps(const vtViewer* viewer, int source, const vtReliefDef* def)
{
    const vtKeptRelief* kept = &viewer->kept;
    return source != 0 && kept->source == source && kept->smoothing == def->smoothing &&
           kept->samples == def->width;
}

static vtReliefDef withDepthOne(const vtReliefDef* def)
{
    vtReliefDef unit = *def;
    unit.depth = 1.0f;
    return unit;
}

/// Adds the relief that is kept.
static vtResult addKept(vtViewer* viewer, const vtReliefDef* def, const char* name, const vtObjectSpec* spec)
{
    vtMesh mesh;
    const vtResult result =
        vtCreateReliefOfDepth(&viewer->kept.unit, def->depth, def->thickness, name, &mesh, &viewer->error);
    return result == vt_ok ? vtViewer_AddMesh(viewer, &mesh, name, spec) : result;
}

vtResult vtViewer_AddPattern(vtViewer* viewer, int pattern, const vtObjectSpec* spec)
{
    const char* name = vtReliefPatternName(pattern);
    const vtReliefDef def = makeReliefDef(spec, pattern), unit = withDepthOne(&def);
    const int source = -1 - pattern;
    vtResult result = vt_ok;
    if (!keeps(viewer, source, &def)) {
        vtMesh mesh;
        result = vtCreateReliefPattern(name, &unit, &mesh, &viewer->error);
        if (result == vt_ok) {
            keep(viewer, &mesh, source, &def);
        }
    }
    return result == vt_ok ? addKept(viewer, &def, name, spec) : result;
}

/// Whether AddRelief and AddPicture need no contents of the source, for an object of that text.
EMSCRIPTEN_KEEPALIVE bool vtViewer_Keeps(vtViewer* viewer, const char* text, int source)
{
    vtObjectSpec spec;
    if (vtViewer_ReadSpec(viewer, text, vt_kindReliefFile, &spec) != vt_ok) {
        return false;
    }
    const vtReliefDef def = makeReliefDef(&spec, -1);
    return keeps(viewer, source, &def);
}

/// Adds heights: a picture that the browser has decoded, RGBA, top row first. Without a width: the contents
/// of a .hdr or .pfm. NULL: too large or kept.
static const char* addHeights(vtViewer* viewer, uint8_t* bytes, size_t size, int width, int height,
                              const char* name, const char* text, int source)
{
    vtMesh mesh;
    vtObjectSpec spec;
    vtReliefDef def;
    vtResult result = vtViewer_ReadSpec(viewer, text, vt_kindReliefFile, &spec);
    if (result == vt_ok) {
        def = makeReliefDef(&spec, -1);
        if (!keeps(viewer, source, &def)) {
            const vtReliefDef unit = withDepthOne(&def);
            result = VT_IS_FULL && width == 0 ? vtCheckPicture(bytes, size, name, &viewer->limits,
                                                               sizeof(float), NULL, &viewer->error)
                                              : vtViewer_CheckPicture(viewer, name, width, height);
            if (result == vt_ok) {
                result = width == 0 ? vtLoadRelief(bytes, size, name, &unit, &mesh, &viewer->error)
                                    : vtCreateReliefOfPixels(bytes, width, height, name, &unit, &mesh,
                                                             &viewer->error);
            }
            if (result == vt_ok) {
                keep(viewer, &mesh, source, &def);
            }
        }
    }
    free(bytes);
    result = result == vt_ok ? addKept(viewer, &def, name, &spec) : result;
    return result == vt_ok ? NULL : viewer->error.message;
}

/// Adds the contents of a .hdr or .pfm as heights. `source`: a number of these contents.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_AddRelief(vtViewer* viewer, uint8_t* bytes, size_t size,
                                                    const char* name, const char* text, int source)
{
    return addHeights(viewer, bytes, size, 0, 0, name, text, source);
}

/// The same of a picture that the browser has decoded, RGBA, top row first; NULL where it is too large.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_AddPicture(vtViewer* viewer, uint8_t* pixels, int width, int height,
                                                     const char* name, const char* text, int source)
{
    return addHeights(viewer, pixels, 0, width, height, name, text, source);
}
