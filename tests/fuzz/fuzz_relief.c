// libFuzzer target: whatever the bytes of a picture of heights and the numbers of its relief, it becomes a
// slab of finite numbers, with its triangles too, or a sentence. The input's last 12 bytes are depth,
// thickness and smoothing.
#include <string.h>

#include "fuzz.h"

enum { mostVertices = 1 << 14 };

int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size)
{
    float numbers[3];
    if (size < sizeof numbers) {
        return 0;
    }
    size -= sizeof numbers;
    memcpy(numbers, bytes + size, sizeof numbers);
    vtReliefDef def = vtDefaultRelief();
    def.depth = numbers[0];
    def.thickness = numbers[1];
    def.smoothing = numbers[2];
    vtMesh mesh;
    vtError error = {0};
    vtResult result = vtLoadRelief(bytes, size, "fuzz", &def, &mesh, &error);
    require((result == vt_ok) == (mesh.heights != NULL));
    requireSentence(result, &error);
    const vtMaterial material = vtDefaultMaterial();
    vtScene scene = {0};
    if (result == vt_ok) {
        result = vtCreateMeshScene(&mesh, &material, &scene, &error);
        requireSentence(result, &error);
    }
    if (result == vt_ok) {
        requireScene(&scene);
        requireSentence(vtTriangulateRelief(&scene.meshes[0], &error), &error);
        if (scene.meshes[0].vertexCount <= mostVertices) {
            requireScene(&scene);
            result = vtValidateScene(&scene, &error);
            require(result == vt_ok || scene.meshes[0].indexCount == 0);
        }
    }
    vtDestroyMesh(&mesh);
    vtDestroyScene(&scene);
    return 0;
}
