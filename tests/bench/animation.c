// What a frame of glass that deforms costs beside one that stands still: a skinned knot of about 70,000
// triangles, frames in turns. Run by hand: cmake --build --preset release --target bench_animation, then
// build/release/tests/bench_animation [SIDE [ROUNDS]].
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "context/context.h"
#include "lab/metrics/timing.h"
#include "shapes/shapes.h"

enum { mostRounds = vt_maxTimingRounds };

static void check(vtResult result, const vtError* error)
{
    if (result != vt_ok) {
        fprintf(stderr, "bench_animation: %s\n", error->message);
        exit(1);
    }
}

/// A .gltf's JSON and its data, which readData hands out as its buffer.
typedef struct File {
    char json[2400];
    uint8_t* data;
    size_t size;
} File;

static vtResult readData(const char* path, size_t limit, uint8_t** bytes, size_t* size, void* userData,
                         vtError* error)
{
    const File* file = userData;
    (void)path, (void)limit, (void)error;
    *bytes = vtAllocate(file->size, 1);
    *size = file->size;
    memcpy(*bytes, file->data, file->size);
    return vt_ok;
}

/// A knot between two joints, one of which turns to and fro.
static void makeFile(const vtMesh* mesh, File* file)
{
    const size_t vertices = mesh->vertexCount, vectors = 12 * vertices,
                 indices = 4 * (size_t)mesh->indexCount;
    const float keys[15] = {0, 0.5f, 1, 0, 0, 0, 1, 0, 0.3f, 0, 0.9539392f, 0, 0, 0, 1};
    file->size = 2 * vectors + indices + 4 * vertices + 16 * vertices + sizeof keys;
    file->data = calloc(file->size, 1);
    uint8_t* at = file->data;
    memcpy(at, mesh->positions, vectors);
    memcpy(at + vectors, mesh->normals, vectors);
    memcpy(at + 2 * vectors, mesh->indices, indices);
    uint8_t* joints = at + 2 * vectors + indices;
    float* weights = (float*)(void*)(joints + 4 * vertices);
    for (size_t i = 0; i < vertices; ++i) {
        const float share = 0.5f + 0.5f * mesh->positions[3 * i + 1] / mesh->boundsMax.y;
        joints[4 * i + 1] = 1;
        weights[4 * i] = 1.0f - share;
        weights[4 * i + 1] = share;
    }
    memcpy(joints + 20 * vertices, keys, sizeof keys);
    const size_t end = 2 * vectors + indices + 20 * vertices;
    snprintf(
        file->json, sizeof file->json,
        "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"uri\":\"data.bin\",\"byteLength\":%zu}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":%zu,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":%zu,\"componentType\":5126,\"count\":%zu,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":%zu,\"componentType\":5125,\"count\":%u,\"type\":\"SCALAR\"},"
        "{\"bufferView\":0,\"byteOffset\":%zu,\"componentType\":5121,\"count\":%zu,\"type\":\"VEC4\"},"
        "{\"bufferView\":0,\"byteOffset\":%zu,\"componentType\":5126,\"count\":%zu,\"type\":\"VEC4\"},"
        "{\"bufferView\":0,\"byteOffset\":%zu,\"componentType\":5126,\"count\":3,\"type\":\"SCALAR\"},"
        "{\"bufferView\":0,\"byteOffset\":%zu,\"componentType\":5126,\"count\":3,\"type\":\"VEC4\"}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"JOINTS_0\":3,"
        "\"WEIGHTS_0\":4},\"indices\":2}]}],\"skins\":[{\"joints\":[1,2]}],\"scenes\":[{\"nodes\":[0,1]}],"
        "\"nodes\":[{\"mesh\":0,\"skin\":0},{\"children\":[2]},{}],\"animations\":[{\"samplers\":[{"
        "\"input\":5,\"output\":6}],\"channels\":[{\"sampler\":0,\"target\":{\"node\":2,\"path\":"
        "\"rotation\"}}]}]}",
        file->size, file->size, vertices, vectors, vertices, 2 * vectors, mesh->indexCount,
        2 * vectors + indices, vertices, 2 * vectors + indices + 4 * vertices, vertices, end, end + 12);
}

static vtModel* openKnot(vtScene* scene)
{
    vtError error;
    vtMesh mesh;
    vtModel* model;
    File file;
    check(vtCreateFineShape("knot", 70000, &mesh, &error), &error);
    makeFile(&mesh, &file);
    vtDestroyMesh(&mesh);
    const vtModelDef def = {.bytes = file.json,
                            .size = strlen(file.json),
                            .name = "knot.gltf",
                            .readFile = readData,
                            .userData = &file};
    check(vtOpenModel(&def, &model, scene, &error), &error);
    free(file.data);
    vtPreparation* preparation = vtBeginPreparation(scene);
    while (!vtPreparation_Step(preparation, UINT32_MAX)) {
    }
    check(vtEndPreparation(preparation, &error), &error);
    return model;
}

/// What a step cost since the marks.
static vtTiming since(vtTiming mark)
{
    return (vtTiming){vtNow() - mark.wall, vtProcessorTime() - mark.processor};
}

static vtTiming now(void)
{
    return (vtTiming){vtNow(), vtProcessorTime()};
}

int main(int count, char** words)
{
    const int side = count > 1 ? atoi(words[1]) : 512, given = count > 2 ? atoi(words[2]) : 9;
    const int rounds = given > 0 && given < mostRounds ? given : mostRounds;
    static double pose[2][mostRounds], upload[2][mostRounds], moved[2][mostRounds], still[2][mostRounds];
    vtError error;
    vtContext context;
    vtRenderer* renderer;
    vtScene scene;
    vtEnvironment environment;
    vtModel* model = openKnot(&scene);
    check(vtCreateContext(vt_backendAuto, &context, &error), &error);
    check(vtCreateRenderer(&(vtRendererDef){.getProcAddress = context.getProcAddress}, &renderer, &error),
          &error);
    check(vtCreateEnvironment("studio", &environment, &error), &error);
    check(vtRenderer_SetScene(renderer, &scene, &error), &error);
    check(vtRenderer_SetEnvironment(renderer, &environment, &error), &error);
    vtFrame frame = vtDefaultFrame();
    frame.width = frame.height = side;
    frame.view = vtViewOfScene(&scene, frame.view.fovY, 1.0f);
    for (int i = -1; i < rounds; ++i) { // the first warms it up
        const int at = i < 0 ? 0 : i;
        vtTiming times[4], mark = now();
        check(vtModel_SetTime(model, 0, fmod(0.13 * (i + 2), 1.0), NULL, &scene, &error), &error);
        times[0] = since(mark);
        check(vtRenderer_UpdateScene(renderer, &scene, &error), &error);
        times[1] = since(mark);
        check(vtRenderer_DrawImage(renderer, &frame, NULL, &error), &error);
        times[2] = since(mark);
        mark = now();
        check(vtRenderer_DrawImage(renderer, &frame, NULL, &error), &error);
        times[3] = since(mark);
        pose[0][at] = times[0].wall, pose[1][at] = times[0].processor;
        upload[0][at] = times[1].wall - times[0].wall,
        upload[1][at] = times[1].processor - times[0].processor;
        moved[0][at] = times[2].wall, moved[1][at] = times[2].processor;
        still[0][at] = times[3].wall, still[1][at] = times[3].processor;
    }
    printf("%u triangles, %d x %d, medians of %d rounds in turns, milliseconds\n",
           scene.meshes[0].indexCount / 3, side, side, rounds);
    for (int k = 0; k < 2; ++k) {
        const double with = vtMedian(moved[k], rounds), without = vtMedian(still[k], rounds);
        printf(
            "%-10s posed and refitted %.1f, taken over %.1f, frame with both %.1f, still %.1f: ratio %.3f\n",
            k == 0 ? "clock" : "processors", vtMedian(pose[k], rounds), vtMedian(upload[k], rounds), with,
            without, with / without);
    }
    vtDestroyRenderer(renderer);
    vtDestroyContext(&context);
    vtDestroyEnvironment(&environment);
    vtCloseModel(model);
    vtDestroyScene(&scene);
    return 0;
}
