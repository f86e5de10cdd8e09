#include "load.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "base/math.h"
#include "files.h"
#include "objects.h"
#include "scene/shapes.h"
#include "trace.h"

static vtResult loadModelFile(const char* path, vtScene* scene, vtError* error)
{
    uint8_t* bytes;
    size_t size;
    vtResult result = vtReadFile(path, &bytes, &size, error);
    if (result != vt_ok) {
        return result;
    }
    char directory[4096] = "";
    const char* slash = strrchr(path, '/');
    if (slash != NULL && (size_t)(slash - path) + 1 < sizeof directory) {
        memcpy(directory, path, (size_t)(slash - path) + 1);
    }
    vtModelDef def = {
        .bytes = bytes, .size = size, .name = path, .directory = directory, .readFile = vtReadFileForModel};
    result = vtLoadScene(&def, scene, error);
    free(bytes);
    return result;
}

static bool isShape(const char* name)
{
    int i = 0;
    while (vtShapeName(i) != NULL && strcmp(vtShapeName(i), name) != 0) {
        ++i;
    }
    return vtShapeName(i) != NULL;
}

static vtResult loadEnvironment(const char* name, vtEnvironment* environment, vtError* error)
{
    // Built-in names hold neither a dot nor a slash.
    if (strpbrk(name, "./") == NULL) {
        return vtCreateEnvironment(name, environment, error);
    }
    uint8_t* bytes;
    size_t size;
    vtResult result = vtReadFile(name, &bytes, &size, error);
    if (result == vt_ok) {
        result = vtLoadEnvironment(bytes, size, name, environment, error);
        free(bytes);
    }
    return result;
}

// ----------------------------------------------------------------------------------------------- objects

/// `triangles`: about so many, 0: as built in.
static vtResult loadShape(const char* name, int triangles, vtScene* scene, vtError* error)
{
    vtMesh mesh;
    vtResult result = triangles > 0 ? vtCreateFineShape(name, (uint32_t)triangles, &mesh, error)
                                    : vtCreateShape(name, &mesh, error);
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

static bool isGlass(const vtScene* scene, uint32_t object)
{
    return !scene->materials[scene->objects[object].material].opaque;
}

static bool isGlassMesh(const vtScene* scene, uint32_t mesh)
{
    bool glass = false;
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        glass = glass || (scene->objects[i].mesh == mesh && isGlass(scene, i));
    }
    return glass;
}

/// "x.glb", or where it has several meshes "x.glb, mesh 2".
static void printMeshNotes(const char* name, const vtScene* scene, uint32_t index, bool verbose)
{
    const vtMesh* mesh = &scene->meshes[index];
    char which[32] = "";
    if (scene->meshCount > 1) {
        snprintf(which, sizeof which, ", mesh %u,", index);
    }
    if (mesh->openEdgeCount > 0) {
        fprintf(
            stderr,
            "vitrine: warning: '%s'%s is not closed (%u open edges); light that enters through a hole never "
            "finds its way out there\n",
            name, which, mesh->openEdgeCount);
    }
    if (mesh->normalsComputed) {
        fprintf(stderr, "vitrine: note: '%s'%s lacks normals; they are computed, smooth over its edges\n",
                name, which);
    }
    if (verbose) {
        fprintf(stderr, "vitrine: '%s'%s: %u triangles, %u vertices, box %g %g %g to %g %g %g\n", name, which,
                mesh->indexCount / 3, mesh->vertexCount, (double)mesh->boundsMin.x, (double)mesh->boundsMin.y,
                (double)mesh->boundsMin.z, (double)mesh->boundsMax.x, (double)mesh->boundsMax.y,
                (double)mesh->boundsMax.z);
    }
}

static void printNotes(const char* name, const vtScene* scene, bool verbose)
{
    for (uint32_t i = 0; i < scene->meshCount; ++i) {
        if (isGlassMesh(scene, i)) {
            printMeshNotes(name, scene, i, verbose);
        }
    }
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        const vtObject* object = &scene->objects[i];
        if (scene->materials[object->material].checker > 0.0f && !isGlass(scene, i) &&
            scene->meshes[object->mesh].texcoords == NULL) {
            fprintf(stderr, "vitrine: note: '%s' has no texture coordinates, so it shows no checker\n", name);
            break;
        }
    }
    if (verbose && scene->allGlass) {
        fprintf(stderr,
                "vitrine: note: '%s' has no material that is glass; all of them are taken for glass\n", name);
    }
}

static vtResult failUnknown(const char* spec, const char* name, vtError* error)
{
    return vtFail(
        error, vt_errorFile,
        "--object '%.200s': '%.200s' is neither a built-in shape (see 'vitrine list') nor a file that "
        "can be read",
        spec, name);
}

/// Loads what one --object names and puts it into the scene.
static vtResult addObject(const vtOptions* options, const char* text, vtScene* scene, vtError* error)
{
    vtObjectSpec spec;
    vtScene added = {0};
    vtResult result = vtParseObject(text, "--object", access(text, R_OK) == 0, &spec, error);
    if (result != vt_ok) {
        return result;
    }
    if (isShape(spec.name)) {
        result = loadShape(spec.name, 0, &added, error);
    } else if (strcmp(spec.name, "-") != 0 && access(spec.name, R_OK) != 0) {
        result = failUnknown(text, spec.name, error);
    } else {
        result = loadModelFile(spec.name, &added, error);
    }
    if (result == vt_ok) {
        vtObjectSpec_Apply(&spec, &added);
        printNotes(spec.name, &added, options->verbose);
        const vtTransform place = vtObjectSpec_Place(&spec);
        result = vtScene_Append(scene, &added, &place, error);
    }
    vtDestroyScene(&added);
    return result;
}

static vtResult loadObjects(const vtOptions* options, vtScene* scene, vtError* error)
{
    const char* model = options->model;
    if (model == NULL && options->objectCount == 0) {
        return vtFail(error, vt_errorArgument,
                      "no model given; name a .glb or .gltf file or a built-in shape (see 'vitrine list')");
    }
    vtResult result = vt_ok;
    if (options->triangles > 0) {
        result = loadShape(model != NULL ? model : "", options->triangles, scene, error);
    } else if (model != NULL) {
        result = isShape(model) ? loadShape(model, 0, scene, error) : loadModelFile(model, scene, error);
    }
    if (result == vt_ok && model != NULL) {
        printNotes(model, scene, options->verbose);
    }
    for (int i = 0; i < options->objectCount && result == vt_ok; ++i) {
        result = addObject(options, options->objects[i], scene, error);
    }
    return result;
}

/// What technique `wyman` needs.
static vtResult measureInnerDistances(vtScene* scene, vtError* error)
{
    vtResult result = vt_ok;
    for (uint32_t i = 0; i < scene->meshCount && result == vt_ok; ++i) {
        result = isGlassMesh(scene, i) ? vtComputeInnerDistances(&scene->meshes[i], error) : vt_ok;
    }
    return result;
}

vtResult vtLoadInput(const vtOptions* options, vtInput* input, vtError* error)
{
    *input = (vtInput){.ior = options->ior};
    vtResult result = loadObjects(options, &input->scene, error);
    if (result == vt_ok) {
        result = vtValidateScene(&input->scene, error);
    }
    if (result == vt_ok) {
        result = loadEnvironment(options->environment, &input->environment, error);
    }
    if (result == vt_ok &&
        (options->innerDistances || vtFindTechnique(options->technique) == vt_techniqueWyman)) {
        result = measureInnerDistances(&input->scene, error);
    }
    if (result != vt_ok) {
        vtDestroyInput(input);
        return result;
    }
    return vtSucceed(error);
}

void vtDestroyInput(vtInput* input)
{
    vtDestroyScene(&input->scene);
    vtDestroyEnvironment(&input->environment);
    *input = (vtInput){0};
}

float vtCommonIor(const vtInput* input)
{
    const vtScene* scene = &input->scene;
    float common = 0.0f;
    for (uint32_t i = 0; i < scene->objectCount && input->ior == 0.0f; ++i) {
        const float ior = scene->materials[scene->objects[i].material].ior;
        if (isGlass(scene, i)) {
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

// ------------------------------------------------------------------------------------------------- frame

/// The eye that the options ask for, else the file's camera, else one that shows the whole scene.
static vtResult chooseView(const vtOptions* options, const vtScene* scene, float aspect, vtView* view,
                           vtError* error)
{
    const int index = options->cameraIndex;
    if (index >= 0 && (uint32_t)index >= scene->cameraCount) {
        return vtFail(error, vt_errorArgument,
                      scene->cameraCount == 0
                          ? "--camera-index is %d, but there are %u cameras in what is drawn; leave it out"
                          : "--camera-index is %d, but there are %u cameras in what is drawn; the first is 0",
                      index, scene->cameraCount);
    }
    if (index >= 0) {
        *view = scene->cameras[index];
        view->fovY = options->hasFov ? options->fov : view->fovY;
        view->eye = options->hasCamera ? options->camera : view->eye;
        view->target = options->hasTarget ? options->target : view->target;
        return vt_ok;
    }
    const vtView framed = vtFrameScene(scene, options->fov, aspect);
    const vtVec3 target = options->hasTarget ? options->target : framed.target;
    const vtVec3 offset = vtSub(framed.eye, framed.target);
    const vtVec3 eye = options->hasCamera ? options->camera : vtAdd(target, offset);
    *view = (vtView){eye, target, options->fov};
    return vt_ok;
}

vtResult vtMakeFrame(const vtOptions* options, const vtInput* input, vtFrame* frame, vtError* error)
{
    *frame = vtDefaultFrame();
    bool isReference = vtIsReference(options);
    frame->technique = isReference ? frame->technique : vtFindTechnique(options->technique);
    if (frame->technique == vt_techniqueCount) {
        return vtFail(error, vt_errorArgument, "technique '%s' is unknown; see 'vitrine list'",
                      options->technique);
    }
    frame->output = options->analysis ? vt_outputAnalysis : vt_outputPicture;
    frame->width = options->size[0];
    frame->height = options->size[1];
    frame->ior = input->ior;
    frame->fresnel = options->fresnel;
    frame->branches = options->branches;
    frame->layers = options->layers;
    frame->steps = options->steps;
    frame->refine = options->refine;
    frame->maxEvents = options->maxEvents;
    frame->layerSize = options->layerSize;
    frame->cubeSize = options->cubeSize;
    frame->topLevel = options->topLevel;
    bool fromEye = strcmp(options->layerSource, "eye") == 0;
    if (!fromEye && strcmp(options->layerSource, "cube") != 0) {
        return vtFail(error, vt_errorArgument, "--layer-source is '%s'; it must be cube or eye",
                      options->layerSource);
    }
    int preset = 0;
    while (preset < vt_presetCount && strcmp(options->preset, vtPresetName(preset)) != 0) {
        ++preset;
    }
    if (preset == vt_presetCount) {
        return vtFail(error, vt_errorArgument, "--preset is '%s'; it must be low, medium or high",
                      options->preset);
    }
    frame->preset = (vtPreset)preset;
    frame->layerSource = fromEye ? vt_layersFromEye : vt_layersFromCube;
    frame->exposure = options->exposure;
    frame->samples = isReference ? 1 : options->samples; // the reference takes more
    frame->transmittance = options->transmittance;
    frame->maxTransmittance = options->maxTransmittance;
    frame->minTransmittance = options->minTransmittance;
    frame->power = options->power;
    frame->wallThickness = options->wallThickness;
    bool farthest = strcmp(options->backSurface, "farthest") == 0;
    if (!farthest && strcmp(options->backSurface, "second") != 0) {
        return vtFail(error, vt_errorArgument, "--back-surface is '%s'; it must be second or farthest",
                      options->backSurface);
    }
    frame->backSurface = farthest ? vt_backFarthest : vt_backSecond;

    bool ordered = strcmp(options->multi, "ordered") == 0;
    if (!ordered && strcmp(options->multi, "any") != 0) {
        return vtFail(error, vt_errorArgument, "--multi is '%s'; it must be any or ordered", options->multi);
    }
    frame->multi = ordered ? vt_multiOrdered : vt_multiAny;
    bool cells = strcmp(options->search, "cells") == 0;
    if (!cells && strcmp(options->search, "steps") != 0) {
        return vtFail(error, vt_errorArgument, "--search is '%s'; it must be steps or cells",
                      options->search);
    }
    frame->search = cells ? vt_searchCells : vt_searchSteps;
    const float aspect = (float)frame->width / (float)frame->height;
    const vtResult result = chooseView(options, &input->scene, aspect, &frame->view, error);
    return result == vt_ok ? vtValidateFrame(frame, error) : result;
}
