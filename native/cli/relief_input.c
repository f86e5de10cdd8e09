#include "cli/relief_input.h"

#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "relief/relief.h"
#include "scene/objects.h"

vtReliefDef vtMakeReliefDef(const vtOptions* options, const vtObjectSpec* spec, int pattern)
{
    vtReliefDef def = vtDefaultRelief();
    def.depth = pattern >= 0 ? vtReliefPatternDepth(pattern) : def.depth;
    if (spec != NULL) {
        vtObjectSpec_ApplyToRelief(spec, &def);
        return def;
    }
    def.depth = options->relief >= 0.0f ? options->relief : def.depth;
    def.thickness = options->slab >= 0.0f ? options->slab : def.thickness;
    def.smoothing = options->smooth >= 0.0f ? options->smooth : def.smoothing;
    def.width = def.height = options->reliefSize;
    return def;
}

vtResult vtCheckReliefOptions(const vtOptions* options, vtObjectKind kind, vtError* error)
{
    const char* given = options->relief >= 0.0f   ? "relief"
                        : options->slab >= 0.0f   ? "slab"
                        : options->smooth >= 0.0f ? "smooth"
                        : options->reliefSize > 0 ? "relief-size"
                                                  : NULL;
    if (given == NULL || kind == vt_kindReliefPattern) {
        return vt_ok;
    }
    if (options->model == NULL) {
        return vtFail(error, vt_errorArgument,
                      "--%s is given, but no MODEL; an --object has keys for it, see 'vitrine render --help'",
                      given);
    }
    if (kind < vt_kindReliefFile) {
        return vtFail(
            error, vt_errorArgument,
            "--%s is given, but '%.200s' is no relief; give a picture of heights or a built-in relief (see "
            "'vitrine list')",
            given, options->model);
    }
    return options->reliefSize == 0
               ? vt_ok
               : vtFail(
                     error, vt_errorArgument,
                     "--relief-size is given, but '%.200s' has the samples that the file has; leave it out",
                     options->model);
}

/// Takes the mesh over.
static vtResult makeScene(const char* name, vtMesh* mesh, vtScene* scene, vtError* error)
{
    const vtMaterial material = vtDefaultMaterial();
    const vtResult result = vtCreateMeshScene(mesh, &material, scene, error);
    vtDestroyMesh(mesh);
    if (result == vt_ok) {
        snprintf(scene->objects[0].name, sizeof scene->objects[0].name, "%.63s", name);
    }
    return result;
}

vtResult vtLoadReliefPattern(int pattern, const vtReliefDef* def, vtScene* scene, vtError* error)
{
    vtMesh mesh;
    const char* name = vtReliefPatternName(pattern);
    const vtResult result = vtCreateReliefPattern(name, def, &mesh, error);
    return result == vt_ok ? makeScene(name, &mesh, scene, error) : result;
}

vtResult vtLoadReliefFile(const char* name, const void* bytes, size_t size, const vtReliefDef* def,
                          vtScene* scene, vtError* error)
{
    vtMesh mesh;
    int bits;
    const vtResult result = vtLoadReliefOfBits(bytes, size, name, def, &mesh, &bits, error);
    if (result == vt_ok && bits == 8 && def->smoothing < 0.0f) {
        fprintf(stderr, "vitrine: note: '%s' has 8 bits a height; smoothed over 2 samples (--smooth)\n",
                name);
    }
    return result == vt_ok ? makeScene(name, &mesh, scene, error) : result;
}

const char* vtChooseTechnique(const vtOptions* options, const vtScene* scene)
{
    return vtScene_HasRelief(scene) && !options->hasTechnique ? VT_RELIEF_TECHNIQUE : options->technique;
}
