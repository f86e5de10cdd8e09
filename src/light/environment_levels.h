// Environment pictures at half the size and less, for directions that cover many pixels.
#pragma once

#include "vitrine.h"

typedef struct vtEnvironmentLevel {
    float* pixels; ///< 3 * width * height, top row first
    int width, height;
} vtEnvironmentLevel;

/// Levels of a picture, itself among them: the last is one texel.
int vtEnvironmentLevelCount(int width, int height);

/// Halves a level, in place. The first call, with level->pixels NULL, halves the picture. Fails where memory
/// is out; level->pixels is to be freed with vtFree.
bool vtHalveEnvironment(const vtEnvironment* picture, vtEnvironmentLevel* level);

/// The level as it is shown: each texel the mean over a part of the sphere as wide as it is high. `out` has
/// its size.
void vtWidenEnvironment(const vtEnvironmentLevel* level, float* out);
