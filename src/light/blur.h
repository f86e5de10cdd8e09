#pragma once

#include "vitrine.h"

/// The environment as a picture, equirectangular, blurred by a Gaussian over the sphere with that standard
/// deviation, degrees, 1 to 90. Light is kept: the mean over the sphere stays. Fails with vt_errorMemory;
/// then *blurred is zeroed.
vtResult vtBlurEnvironment(const vtEnvironment* environment, float degrees, vtEnvironment* blurred,
                           vtError* error);
