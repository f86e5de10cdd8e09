#include "cli/load.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "base/math.h"
#include "cli/files.h"
#include "cli/hash.h"
#include "cli/load_notes.h"
#include "cli/object_help.h"
#include "cli/object_image.h"
#include "cli/relief_input.h"
#include "cli/trace.h"
#include "image/image.h"
#include "mesh/height_field.h"
#include "relief/relief.h"
#include "scene/material.h"
#include "scene/objects.h"
#include "shapes/shapes.h"
#include "technique/background.h"
#include "technique/technique.h"

static bool isShape(const char* name)
{
    int i = 0;
    while (vtShapeName(i) != NULL && strcmp(vtShapeName(i), name) != 0) {
        ++i;
    }
    return vtShapeName(i) != NULL;
}

static vtResult loadEnvironment(const char* name, const vtLimits* limits, vtEnvironment* environment,
                                uint64_t* contents, vtError* error)
{
    // Built-in names hold neither a dot nor a slash.
    if (strpbrk(name, "./") == NULL) {
        return vtCreateEnvironment(name, environment, error);
    }
    uint8_t* bytes;
    size_t size;
    vtResult result = vtReadInput(name, limits, &bytes, &size, error);
    if (result == vt_ok) {
        *contents = vtHash(*contents, bytes, size);
        result = vtLoadEnvironmentWithin(bytes, size, name, limits, environment, error);
        vtFree(bytes);
    }
    if (result == vt_ok && environment->width != 2 * environment->height) {
        fprintf(
            stderr,
            "vitrine: note: environment '%s' is %d x %d pixels, not twice as wide as high; it is stretched "
            "over the sphere\n",
            name, environment->width, environment->height);
    }
    return result;
}

// ----------------------------------------------------------------------------------------------- objects

/// What a name names. `spec`: of an --object, NULL: of MODEL.
typedef struct Named {
    const vtOptions* options;
    const vtObjectSpec* spec;
    const char* name;
    uint64_t* contents; ///< the hash of what is read is added to it
} Named;

static vtResult checkKind(const Named* named, vtObjectKind kind, vtError* error)
{
    return named->spec != NULL ? vtObjectSpec_Check(named->spec, kind, "--object", error)
                               : vtCheckReliefOptions(named->options, kind, error);
}

static vtResult findWalls(const char* word, vtWalls* walls, vtError* error)
{
    int index = 0;
    while (word != NULL && vtWallsName(index) != NULL && strcmp(vtWallsName(index), word) != 0) {
        ++index;
    }
    *walls = (vtWalls)index;
    return vtWallsName(index) != NULL
               ? vt_ok
               : vtFail(error, vt_errorArgument, "--walls is '%.100s'; it must be auto, thin or solid", word);
}

/// *model: where animations are played.
static vtResult loadModel(const Named* named, const void* bytes, size_t size, vtScene* scene, vtModel** model,
                          vtError* error)
{
    vtModelFolders folders;
    vtWalls walls;
    vtResult result = findWalls(named->options->walls, &walls, error);
    if (result != vt_ok) {
        return result;
    }
    result = vtFindModelFolders(named->name, named->options->root, &folders, error);
    folders.contents = named->contents;
    const vtModelDef def = {.bytes = bytes,
                            .size = size,
                            .name = named->name,
                            .directory = folders.directory,
                            .root = folders.root[0] != '\0' ? folders.root : NULL,
                            .variant = named->options->variant,
                            .readFile = vtReadFileForModel,
                            .userData = &folders,
                            .limits = named->options->limits};
    if (result == vt_ok) {
        result =
            named->options->plays ? vtOpenModel(&def, model, scene, error) : vtLoadScene(&def, scene, error);
    }
    if (result == vt_ok) {
        vtScene_SetWalls(scene, walls);
    }
    return result;
}

/// A model or a picture of heights, by what it begins with: standard input has no name.
static vtResult loadFile(const Named* named, vtScene* scene, vtModel** model, vtError* error)
{
    uint8_t* bytes;
    size_t size;
    vtResult result = vtReadInput(named->name, &named->options->limits, &bytes, &size, error);
    if (result != vt_ok) {
        return result;
    }
    *named->contents = vtHash(*named->contents, bytes, size);
    const bool isRelief = vtIsPicture(bytes, size);
    result = checkKind(named, isRelief ? vt_kindReliefFile : vt_kindMesh, error);
    if (result == vt_ok && isRelief) {
        result =
            vtCheckPicture(bytes, size, named->name, &named->options->limits, sizeof(float), NULL, error);
    }
    if (result == vt_ok && isRelief) {
        const vtReliefDef def = vtMakeReliefDef(named->options, named->spec, -1);
        result = vtLoadReliefFile(named->name, bytes, size, &def, scene, error);
    } else if (result == vt_ok) {
        result = loadModel(named, bytes, size, scene, model, error);
    }
    vtFree(bytes);
    return result;
}

/// `triangles`: about so many, 0: as built in.
static vtResult loadShape(const char* name, int triangles, const vtObjectSpec* spec, vtScene* scene,
                          vtError* error)
{
    vtMesh mesh;
    vtResult result = triangles > 0 ? vtCreateFineShape(name, (uint32_t)triangles, &mesh, error)
                                    : vtObjectSpec_CreateShape(spec, name, &mesh, error);
    if (result == vt_ok) {
        vtMaterial material = vtDefaultMaterial();
        material.opaque = strcmp(name, "plane") == 0; // it has no volume
        result = vtCreateMeshScene(&mesh, &material, scene, error);
        vtDestroyMesh(&mesh);
    }
    if (result == vt_ok) {
        snprintf(scene->objects[0].name, sizeof scene->objects[0].name, "%.63s", name);
    }
    return result;
}

static vtResult failUnknown(const char* what, const char* name, vtError* error)
{
    return vtFail(
        error, vt_errorFile,
        "%s '%.200s' is neither a built-in shape or relief (see 'vitrine list') nor a file that can "
        "be read",
        what, name);
}

/// What a name names: built in, or in a file.
static vtResult loadNamed(const Named* named, vtScene* scene, vtModel** model, vtError* error)
{
    *model = NULL;
    const int pattern = vtFindReliefPattern(named->name);
    if (pattern >= 0 || isShape(named->name)) {
        *named->contents = vtHashText(*named->contents, named->name);
    }
    if (pattern >= 0) {
        const vtResult result = checkKind(named, vt_kindReliefPattern, error);
        const vtReliefDef def = vtMakeReliefDef(named->options, named->spec, pattern);
        return result == vt_ok ? vtLoadReliefPattern(pattern, &def, scene, error) : result;
    }
    if (isShape(named->name)) {
        const vtResult result = checkKind(named, vtKindOfShape(named->name), error);
        return result == vt_ok ? loadShape(named->name, 0, named->spec, scene, error) : result;
    }
    return loadFile(named, scene, model, error);
}

/// Loads what one --object names and puts it into the scene.
static vtResult addObject(const vtOptions* options, const char* text, vtInput* input, vtError* error)
{
    vtObjectSpec spec;
    vtModel* model = NULL;
    vtScene added = {0};
    vtResult result = vtParseObject(text, "--object", access(text, R_OK) == 0, &spec, error);
    if (result != vt_ok) {
        return result;
    }
    const bool isBuiltIn = isShape(spec.name) || vtFindReliefPattern(spec.name) >= 0;
    if (!isBuiltIn && strcmp(spec.name, "-") != 0 && access(spec.name, R_OK) != 0) {
        char what[256];
        snprintf(what, sizeof what, "--object '%.200s':", text);
        return failUnknown(what, spec.name, error);
    }
    result = loadNamed(&(Named){options, &spec, spec.name, &input->contents}, &added, &model, error);
    if (result == vt_ok) {
        vtObjectSpec_Apply(&spec, &added);
        result = spec.image[0] != '\0'
                     ? vtAddObjectImage(spec.image, &options->limits, &added, &input->contents, error)
                     : vt_ok;
    }
    if (result == vt_ok) {
        vtPrintLoaded(spec.name, &added, options->verbose);
        const vtTransform transform = vtObjectSpec_Place(&spec);
        const vtModelPlace place = vtScene_NextPlace(&input->scene, &transform);
        result = vtScene_Append(&input->scene, &added, &transform, error);
        vtMotion_Add(&input->motion, model, &place);
        model = NULL;
    }
    vtCloseModel(model);
    vtDestroyScene(&added);
    return result;
}

static vtResult loadMain(const vtOptions* options, vtInput* input, vtError* error)
{
    vtScene* scene = &input->scene;
    const char* model = options->model;
    if (model == NULL && options->objectCount == 0) {
        return vtFail(
            error, vt_errorArgument,
            "no model given; name a .glb or .gltf file, a picture of heights or a built-in shape or "
            "relief (see 'vitrine list')");
    }
    if (model == NULL || options->triangles > 0) {
        const vtResult result = vtCheckReliefOptions(options, vt_kindMesh, error);
        return result == vt_ok && options->triangles > 0
                   ? loadShape(model != NULL ? model : "", options->triangles, NULL, scene, error)
                   : result;
    }
    // A name without dot or slash was hardly meant as a file.
    const bool isBuiltIn = isShape(model) || vtFindReliefPattern(model) >= 0;
    if (!isBuiltIn && strpbrk(model, "./-") == NULL && access(model, R_OK) != 0) {
        return failUnknown("model", model, error);
    }
    vtModel* moving;
    const vtModelPlace place = vtScene_NextPlace(scene, NULL);
    const vtResult result =
        loadNamed(&(Named){options, NULL, model, &input->contents}, scene, &moving, error);
    vtMotion_Add(&input->motion, moving, &place);
    return result;
}

static vtResult loadObjects(const vtOptions* options, vtInput* input, vtError* error)
{
    vtResult result = loadMain(options, input, error);
    if (result == vt_ok && options->model != NULL) {
        vtPrintLoaded(options->model, &input->scene, options->verbose);
    }
    for (int i = 0; i < options->objectCount && result == vt_ok; ++i) {
        result = addObject(options, options->objects[i], input, error);
    }
    return result;
}

/// What is played, and the scene as it begins.
static vtResult beginMotion(const vtOptions* options, vtInput* input, vtError* error)
{
    vtMotion* motion = &input->motion;
    const float aspect = (float)options->frame.width / (float)options->frame.height;
    vtResult result = vtMotion_Choose(motion, options, error);
    if (result != vt_ok || motion->count == 0) {
        return result;
    }
    result = vtMotion_Survey(motion, options->frame.view.fovY, aspect, &input->scene, error);
    if (isnan(input->ground.height)) {
        input->ground.height = motion->lowest;
    }
    return result == vt_ok ? vtMotion_SetTime(motion, fmax(options->time, 0.0), &input->scene, error)
                           : result;
}

/// Whatever the command draws has what it needs.
static vtResult prepareMeshes(const vtOptions* options, vtScene* scene, vtError* error)
{
    if (vtIsReference(options) && !options->innerDistances && !options->triangulates) {
        return vtSucceed(error); // it takes reliefs by their heights
    }
    vtTechnique technique = options->innerDistances ? vt_techniqueWyman
                            : options->triangulates ? vt_techniqueExact
                                                    : vtFindTechnique(vtChooseTechnique(options, scene));
    if (technique == vt_techniqueCount) {
        technique = vt_techniqueExact; // several are named, or what the command refuses later
    } else if (!options->innerDistances) {
        vtPrintLeftOut(technique, scene, &options->frame);
        if (options->ground.isThere && !vtTechnique_Row(technique)->traces) {
            fprintf(stderr,
                    "vitrine: note: technique %s draws no ground, and no light or shadow of its sun; exact, "
                    "heightfield and reference do\n",
                    vtTechnique_Info(technique)->id);
        }
        if (options->backdrop != NULL && !vtTechnique_Row(technique)->traces) {
            fprintf(stderr,
                    "vitrine: note: technique %s shows no backdrop; exact, heightfield and reference do\n",
                    vtTechnique_Info(technique)->id);
        }
    }
    return vtPrepareScene(scene, technique, NULL, error);
}

static vtResult loadPicture(const char* name, const vtLimits* limits, vtImage* picture, uint64_t* contents,
                            vtError* error)
{
    uint8_t* bytes;
    size_t size;
    vtResult result = vtReadInput(name, limits, &bytes, &size, error);
    if (result == vt_ok) {
        *contents = vtHash(*contents, bytes, size);
        result = vtCheckPicture(bytes, size, name, limits, 4, NULL, error);
        result = result == vt_ok ? vtDecodeImage(bytes, size, name, picture, error) : result;
        vtFree(bytes);
    }
    return result;
}

/// The picture that a background names, if it does.
static vtResult loadBackground(const char* text, const vtLimits* limits, vtImage* picture, uint64_t* contents,
                               vtError* error)
{
    vtFrame frame = vtDefaultFrame();
    const vtResult result = vtFrame_SetBackground(&frame, text, error);
    const bool isPicture = result == vt_ok && frame.background == vt_backgroundPicture;
    return isPicture ? loadPicture(text, limits, picture, contents, error) : result;
}

vtResult vtLoadInputModel(const vtOptions* options, vtInput* fresh, vtError* error)
{
    *fresh = (vtInput){.ground = options->ground.ground, .contents = VT_NO_HASH};
    vtResult result = loadObjects(options, fresh, error);
    if (result == vt_ok) {
        result = vtValidateScene(&fresh->scene, error);
    }
    if (result == vt_ok) {
        result = beginMotion(options, fresh, error);
    }
    if (result == vt_ok) {
        result = prepareMeshes(options, &fresh->scene, error);
    }
    if (result != vt_ok) {
        vtDestroyInput(fresh);
    }
    return result;
}

void vtInput_TakeModel(vtInput* input, const vtInput* fresh)
{
    vtDestroyMotion(&input->motion);
    vtDestroyScene(&input->scene);
    input->scene = fresh->scene;
    input->motion = fresh->motion;
    input->ground = fresh->ground;
    input->contents = fresh->contents;
}

vtResult vtLoadInput(const vtOptions* options, vtInput* input, vtError* error)
{
    vtResult result = vtLoadInputModel(options, input, error);
    input->ior = options->frame.ior;
    input->surroundings = VT_NO_HASH;
    if (result == vt_ok) {
        result = loadEnvironment(options->environment, &options->limits, &input->environment,
                                 &input->surroundings, error);
    }
    if (result == vt_ok && options->background != NULL) {
        result = loadBackground(options->background, &options->limits, &input->background,
                                &input->surroundings, error);
    }
    if (result == vt_ok && options->backdrop != NULL) {
        result =
            loadPicture(options->backdrop, &options->limits, &input->backdrop, &input->surroundings, error);
    }
    if (result != vt_ok) {
        vtDestroyInput(input);
        return result;
    }
    return vtSucceed(error);
}

vtResult vtInput_SetTime(vtInput* input, const vtOptions* options, double seconds, vtError* error)
{
    const vtResult result = vtMotion_SetTime(&input->motion, seconds, &input->scene, error);
    const bool isWyman = options->innerDistances || vtFindTechnique(options->technique) == vt_techniqueWyman;
    return result == vt_ok && isWyman ? vtPrepareScene(&input->scene, vt_techniqueWyman, NULL, error)
                                      : result;
}

void vtDestroyInput(vtInput* input)
{
    vtDestroyMotion(&input->motion);
    vtDestroyScene(&input->scene);
    vtDestroyEnvironment(&input->environment);
    vtFree(input->background.pixels);
    vtFree(input->backdrop.pixels);
    *input = (vtInput){0};
}

float vtCommonIor(const vtInput* input)
{
    const vtScene* scene = &input->scene;
    float common = 0.0f;
    for (uint32_t i = 0; i < scene->objectCount && input->ior == 0.0f; ++i) {
        const float ior = scene->materials[scene->objects[i].material].ior;
        if (!scene->materials[scene->objects[i].material].opaque) {
            if (common > 0.0f && ior != common) {
                return 0.0f;
            }
            common = ior;
        }
    }
    return input->ior > 0.0f ? input->ior : common;
}

uint32_t vtCountTriangles(const vtScene* scene)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        count += scene->meshes[scene->objects[i].mesh].indexCount / 3;
    }
    return count;
}
