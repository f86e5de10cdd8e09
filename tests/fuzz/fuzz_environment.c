// libFuzzer target: whatever the bytes, they become surroundings that give light from every direction, as one
// picture or of a cube's faces, or a sentence.
#include <math.h>

#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size)
{
    vtEnvironment environment;
    vtError error = {0};
    const vtResult result = vtLoadEnvironment(bytes, size, "fuzz", &environment, &error);
    require((result == vt_ok) == (environment.pixels != NULL));
    requireSentence(result, &error);
    for (int i = 0; i < 26 && result == vt_ok; ++i) {
        const int cell = i < 13 ? i : i + 1; // of 27 about the middle, all but that
        const vtVec3 to = {(float)(cell % 3 - 1), (float)(cell / 3 % 3 - 1), (float)(cell / 9 - 1)};
        const float length = sqrtf(to.x * to.x + to.y * to.y + to.z * to.z);
        const vtVec3 light =
            vtEnvironment_Sample(&environment, (vtVec3){to.x / length, to.y / length, to.z / length});
        require(light.x >= 0.0f && light.y >= 0.0f && light.z >= 0.0f);
        require(light.x <= 65504.0f && light.y <= 65504.0f && light.z <= 65504.0f);
    }
    vtDestroyEnvironment(&environment);
    return 0;
}
