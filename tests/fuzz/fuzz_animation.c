// libFuzzer target: whatever the numbers of an animated file, keys, joints, weights and morph targets, each
// moment of it is a scene of finite numbers, or a sentence, its hierarchy is refitted and a ray finds its
// way. The input is what the accessors hold, and before it eight bytes that choose how they are used.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"

enum { headSize = 8, payload = 1152, cubeSize = 8 * 12 + 36 * 2, binSize = cubeSize + payload };

static const int8_t cubeCorners[8][3] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                                         {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};
static const uint16_t cubeIndices[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                         2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};

/// Accessors of the payload: places in it, as they are used; behind them come no more than 1152 bytes.
static int describe(const uint8_t* head, char* json, size_t room)
{
    static const char* const ways[] = {"LINEAR", "STEP", "CUBICSPLINE", "LINEAR"};
    static const char* const paths[] = {"translation", "rotation", "scale", "weights"};
    const int keys = 1 + head[0] % 4;
    char samplers[512] = "", channels[512] = "";
    size_t used = 0, more = 0;
    int outputs[4];
    for (int i = 0; i < 4; ++i) {
        const char* way = ways[head[1] >> (2 * i) & 3];
        outputs[i] = (strcmp(way, "CUBICSPLINE") == 0 ? 3 : 1) * keys;
        used += (size_t)snprintf(samplers + used, sizeof samplers - used,
                                 "%s{\"input\":2,\"output\":%d,\"interpolation\":\"%s\"}", i > 0 ? "," : "",
                                 3 + i, way);
        more += (size_t)snprintf(channels + more, sizeof channels - more,
                                 "%s{\"sampler\":%d,\"target\":{\"node\":%d,\"path\":\"%s\"}}",
                                 i > 0 ? "," : "", i, i == 3 ? 0 : (head[2] >> i & 1), paths[i]);
    }
    return snprintf(
        json, room,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],"
        "\"nodes\":[{\"mesh\":0%s},{\"children\":[2]},{\"translation\":[0,1,0]}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"JOINTS_0\":7,\"WEIGHTS_0\":8},"
        "\"indices\":1,"
        "\"targets\":[{\"POSITION\":9},{\"POSITION\":9}]}]}],"
        "\"skins\":[{\"joints\":[1,2]%s}],"
        "\"animations\":[{\"samplers\":[%s],\"channels\":[%s]}],"
        "\"buffers\":[{\"byteLength\":%d}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":96},"
        "{\"buffer\":0,\"byteOffset\":96,\"byteLength\":72},{\"buffer\":0,\"byteOffset\":%d,\"byteLength\":%"
        "d}],"
        "\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":8,\"type\":\"VEC3\"},"
        "{\"bufferView\":1,\"componentType\":5123,\"count\":36,\"type\":\"SCALAR\"},"
        "{\"bufferView\":2,\"componentType\":5126,\"count\":%d,\"type\":\"SCALAR\"},"
        "{\"bufferView\":2,\"byteOffset\":16,\"componentType\":5126,\"count\":%d,\"type\":\"VEC3\"},"
        "{\"bufferView\":2,\"byteOffset\":160,\"componentType\":5126,\"count\":%d,\"type\":\"VEC4\"},"
        "{\"bufferView\":2,\"byteOffset\":352,\"componentType\":5126,\"count\":%d,\"type\":\"VEC3\"},"
        "{\"bufferView\":2,\"byteOffset\":496,\"componentType\":5126,\"count\":%d,\"type\":\"SCALAR\"},"
        "{\"bufferView\":2,\"byteOffset\":592,\"componentType\":5121,\"count\":8,\"type\":\"VEC4\"},"
        "{\"bufferView\":2,\"byteOffset\":624,\"componentType\":5126,\"count\":8,\"type\":\"VEC4\"},"
        "{\"bufferView\":2,\"byteOffset\":752,\"componentType\":5126,\"count\":8,\"type\":\"VEC3\"},"
        "{\"bufferView\":2,\"byteOffset\":848,\"componentType\":5126,\"count\":2,\"type\":\"MAT4\"}]}",
        head[2] & 8 ? ",\"skin\":0" : "", head[2] & 16 ? ",\"inverseBindMatrices\":10" : "", samplers,
        channels, binSize, cubeSize, payload, keys, outputs[0], outputs[1], outputs[2], 2 * outputs[3]);
}

static size_t writeGlb(const char* json, const uint8_t* bytes, size_t size, uint8_t* glb)
{
    const size_t length = strlen(json), textSize = (length + 3) / 4 * 4, whole = 28 + textSize + binSize;
    const uint32_t head[] = {0x46546C67, 2, (uint32_t)whole, (uint32_t)textSize, 0x4E4F534A};
    const uint32_t binHead[] = {binSize, 0x004E4942};
    float corners[8][3];
    for (int i = 0; i < 24; ++i) {
        corners[i / 3][i % 3] = cubeCorners[i / 3][i % 3];
    }
    uint8_t* bin = glb + 28 + textSize;
    memset(glb, ' ', 20 + textSize);
    memcpy(glb, head, sizeof head);
    memcpy(glb + 20, json, length);
    memcpy(bin - 8, binHead, sizeof binHead);
    memcpy(bin, corners, sizeof corners);
    memcpy(bin + 96, cubeIndices, sizeof cubeIndices);
    memset(bin + cubeSize, 0, payload);
    memcpy(bin + cubeSize, bytes, size < payload ? size : payload);
    return whole;
}

/// A ray through what there is now.
static void trace(const vtScene* scene)
{
    vtError error = {0};
    vtTracer* tracer;
    vtPath path;
    vtResult result = vtCreateTracer(scene, &tracer, &error);
    requireSentence(result, &error);
    if (result != vt_ok) {
        return;
    }
    vtFrame frame = vtDefaultFrame();
    frame.view = vtViewOfScene(scene, 45.0f, 1.0f);
    result = vtTracer_Path(tracer, &frame, 250.0f, 240.0f, &path, &error);
    requireSentence(result, &error);
    if (result == vt_ok) {
        requireFinite(&path.direction.x, 3);
        require(path.eventCount >= 0 && path.eventCount <= VT_MAX_EVENTS);
        for (int i = 0; i < path.eventCount; ++i) {
            requireFinite(&path.events[i].position.x, 3);
        }
    }
    vtDestroyTracer(tracer);
}

static void play(vtModel* model, vtScene* scene, const uint8_t* head)
{
    vtError error = {0};
    vtPreparation* preparation = vtBeginPreparation(scene);
    while (preparation != NULL && !vtPreparation_Step(preparation, UINT32_MAX)) {
    }
    requireSentence(vtEndPreparation(preparation, &error), &error);
    const vtAnimation* animation = vtModel_Animation(model, 0);
    for (int i = 0; i < 3; ++i) {
        const double share = head[3 + i] / 200.0; // beyond its end, too
        const double seconds = animation != NULL ? share * animation->duration : share;
        const vtResult result =
            vtModel_SetTime(model, animation != NULL && i < 2 ? 0 : -1, seconds, NULL, scene, &error);
        requireSentence(result, &error);
        if (result == vt_ok) {
            requireScene(scene);
            if (vtValidateScene(scene, &error) == vt_ok) {
                trace(scene);
            }
        }
    }
}

int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size)
{
    if (size < headSize) {
        return 0;
    }
    char json[4096];
    uint8_t glb[sizeof json + binSize + 64];
    const int length = describe(bytes, json, sizeof json);
    require(length > 0 && (size_t)length < sizeof json);
    const vtModelDef def = {
        .bytes = glb, .size = writeGlb(json, bytes + headSize, size - headSize, glb), .name = "fuzz"};
    vtModel* model;
    vtScene scene;
    vtError error = {0};
    const vtResult result = vtOpenModel(&def, &model, &scene, &error);
    require((result == vt_ok) == (scene.objectCount > 0) && (result == vt_ok) == (model != NULL));
    requireSentence(result, &error);
    if (result == vt_ok) {
        requireScene(&scene);
        play(model, &scene, bytes);
    }
    vtCloseModel(model);
    vtDestroyScene(&scene);
    return 0;
}
