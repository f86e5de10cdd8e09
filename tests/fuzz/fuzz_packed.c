// libFuzzer target: whatever the packed bytes of a glTF file, geometry of Draco's or meshoptimizer's, they
// become a scene of finite numbers or a sentence. The input is packed data, and before them five bytes that
// choose how the file has them.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"

enum { headSize = 5, mostPacked = 1 << 16 };

static const char* const rest =
    "\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
    "\"extensionsUsed\":[\"KHR_mesh_quantization\"]";

/// Views of packed bytes, and a triangle's places behind them.
static int describeMeshopt(const uint8_t* head, size_t size, char* json, size_t room)
{
    static const char* const modes[] = {"ATTRIBUTES", "TRIANGLES", "INDICES", "ATTRIBUTES"};
    static const char* const filters[] = {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"};
    static const char* const names[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};
    static const char* const uses[] = {"POSITION", "NORMAL", "TEXCOORD_0", "COLOR_0"};
    const int mode = head[0] >> 1 & 3, count = head[2],
              stride = mode % 3 == 0 ? 4 * (head[3] & 31) : 2 + (head[3] & 2);
    const int use = head[4] & 3, type = 5120 + (head[4] >> 2) % 7;
    char primitive[160];
    const char* kind = use == 2 ? "VEC2" : use == 3 && type < 5126 ? "VEC4" : "VEC3";
    if (mode % 3 != 0) {
        snprintf(primitive, sizeof primitive, "\"attributes\":{\"POSITION\":1},\"indices\":0");
        kind = "SCALAR";
    } else {
        snprintf(primitive, sizeof primitive, "\"attributes\":{%s\"%s\":0}", use > 0 ? "\"POSITION\":1," : "",
                 uses[use]);
    }
    return snprintf(
        json, room,
        "{%s,\"buffers\":[{\"byteLength\":%zu},{\"byteLength\":%d}],"
        "\"bufferViews\":[{\"buffer\":1,\"byteLength\":%d%s%s,\"extensions\":{\"%s\":{\"buffer\":0,"
        "\"byteLength\":%zu,"
        "\"byteStride\":%d,\"count\":%d,\"mode\":\"%s\",\"filter\":\"%s\"}}},{\"buffer\":0,\"byteOffset\":%"
        "zu,"
        "\"byteLength\":36}],\"accessors\":[{\"bufferView\":0,\"componentType\":%d,\"count\":%d,\"type\":\"%"
        "s\","
        "\"normalized\":%s},{\"bufferView\":1,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"meshes\":[{\"primitives\":[{%s}]}]}",
        rest, size + 36, count * stride, count * stride, mode % 3 == 0 ? ",\"byteStride\":" : "",
        mode % 3 == 0
            ? (char[8]){(char)('0' + stride / 100), (char)('0' + stride / 10 % 10), (char)('0' + stride % 10)}
            : "",
        names[head[0] >> 3 & 1], size, stride, count, modes[mode], filters[head[1] % 5], size,
        mode % 3 == 0 ? type : 5121 + 2 * (stride / 2), count, kind, type < 5126 ? "true" : "false",
        primitive);
}

static int describeDraco(const uint8_t* head, size_t size, char* json, size_t room)
{
    static const char* const types[] = {"VEC3", "VEC2", "VEC4", "SCALAR"};
    return snprintf(
        json, room,
        "{%s,\"buffers\":[{\"byteLength\":%zu}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu}],"
        "\"accessors\":[{\"componentType\":5126,\"count\":%d,\"type\":\"VEC3\"},"
        "{\"componentType\":%d,\"count\":%d,\"type\":\"%s\",\"normalized\":%s},"
        "{\"componentType\":5123,\"count\":%d,\"type\":\"SCALAR\"}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"%s\":1},\"indices\":2,\"extensions\":"
        "{"
        "\"KHR_draco_mesh_compression\":{\"bufferView\":0,\"attributes\":{\"POSITION\":%d,\"%s\":%d}}}}]}]}",
        rest, size + 36, size, head[1], 5120 + head[2] % 7, head[1], types[head[2] >> 3 & 3],
        head[2] >> 5 & 1 ? "true" : "false", 3 * head[3], head[4] & 1 ? "NORMAL" : "TEXCOORD_0",
        head[4] >> 1 & 3, head[4] & 1 ? "NORMAL" : "TEXCOORD_0", head[4] >> 3 & 3);
}

/// A .glb of that text, the packed bytes and a triangle's places.
static size_t writeGlb(const char* json, const uint8_t* packed, size_t size, uint8_t* glb)
{
    static const float triangle[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const size_t length = strlen(json), textSize = (length + 3) / 4 * 4;
    const size_t binSize = (size + sizeof triangle + 3) / 4 * 4, whole = 12 + 8 + textSize + 8 + binSize;
    const uint32_t head[] = {0x46546C67, 2, (uint32_t)whole, (uint32_t)textSize, 0x4E4F534A};
    const uint32_t bin[] = {(uint32_t)binSize, 0x004E4942};
    memset(glb, ' ', whole);
    memcpy(glb, head, sizeof head);
    memcpy(glb + 20, json, length);
    memcpy(glb + 20 + textSize, bin, sizeof bin);
    memcpy(glb + 28 + textSize, packed, size);
    memcpy(glb + 28 + textSize + size, triangle, sizeof triangle);
    return whole;
}

int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size)
{
    if (size < headSize || size > mostPacked) {
        return 0;
    }
    char json[2048];
    const size_t packed = (size - headSize) / 4 * 4; // places begin at a multiple of 4
    const bool isDraco = (bytes[0] & 1) != 0;
    const int length = (isDraco ? describeDraco : describeMeshopt)(bytes, packed, json, sizeof json);
    require(length > 0 && (size_t)length < sizeof json);
    uint8_t* glb = malloc(sizeof json + mostPacked + 128);
    require(glb != NULL);
    const vtModelDef def = {
        .bytes = glb, .size = writeGlb(json, bytes + headSize, packed, glb), .name = "fuzz"};
    vtScene scene;
    vtError error = {0};
    const vtResult result = vtLoadScene(&def, &scene, &error);
    require((result == vt_ok) == (scene.objectCount > 0));
    requireSentence(result, &error);
    requireScene(&scene);
    requireSentence(vtValidateScene(&scene, &error), &error);
    vtDestroyScene(&scene);
    free(glb);
    return 0;
}
