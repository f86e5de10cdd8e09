#include "cli/ground_options.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"

/// Numbers between commas, at most `most`; how many, or -1 where there is something else.
static int readNumbers(const char* text, float* numbers, int most)
{
    int count = 0;
    while (count < most) {
        char* end;
        numbers[count] = strtof(text, &end);
        if (end == text || !isfinite(numbers[count]) || (*end != '\0' && *end != ',')) {
            return -1;
        }
        ++count;
        if (*end == '\0') {
            return count;
        }
        text = end + 1;
    }
    return -1;
}

static vtResult readSun(const char* text, vtGround* ground, vtError* error)
{
    float numbers[7];
    const int count = readNumbers(text, numbers, 7);
    if (count != 3 && count != 4 && count != 7) {
        return vtFail(error, vt_errorArgument,
                      "--sun is '%.200s'; it must be X,Y,Z towards it, and after that may come its size in "
                      "degrees, and after that its irradiance R,G,B",
                      text);
    }
    ground->sunDirection = (vtVec3){numbers[0], numbers[1], numbers[2]};
    if (numbers[0] == 0.0f && numbers[1] == 0.0f && numbers[2] == 0.0f) {
        return vtFail(error, vt_errorArgument, "--sun is '%.200s'; it must have a direction other than 0,0,0",
                      text);
    }
    ground->sunSize = count > 3 ? numbers[3] : ground->sunSize;
    ground->sunColor = count > 4 ? (vtVec3){numbers[4], numbers[5], numbers[6]} : ground->sunColor;
    return vt_ok;
}

vtResult vtReadGroundOption(const char* option, const char* text, vtGroundOptions* options, vtError* error)
{
    vtGround* ground = &options->ground;
    const bool isGround = strcmp(option, "ground") == 0;
    options->isThere = options->isThere || isGround;
    options->needed = isGround ? options->needed : option;
    if (strcmp(option, "sun") == 0) {
        return readSun(text, ground, error);
    }
    float numbers[3];
    if (strcmp(option, "ground-color") == 0) {
        if (readNumbers(text, numbers, 3) != 3) {
            return vtFail(error, vt_errorArgument,
                          "--ground-color is '%.200s'; it must be three numbers R,G,B from 0 to 1", text);
        }
        ground->color = (vtVec3){numbers[0], numbers[1], numbers[2]};
        ground->matt = true;
        return vt_ok;
    }
    if (isGround && text == NULL) {
        return vt_ok;
    }
    if (readNumbers(text, numbers, 1) != 1) {
        return vtFail(error, vt_errorArgument, "--%s is '%.200s'; it must be a number", option, text);
    }
    *(isGround                                 ? &ground->height
      : strcmp(option, "shadow-softness") == 0 ? &ground->shadowSoftness
                                               : &ground->shadowIntensity) = numbers[0];
    return vt_ok;
}

vtResult vtCheckGroundOptions(const vtGroundOptions* options, vtError* error)
{
    if (options->needed != NULL && !options->isThere) {
        return vtFail(error, vt_errorArgument, "--%s says something of a ground; add --ground",
                      options->needed);
    }
    return vtValidateGround(&options->ground, error);
}
