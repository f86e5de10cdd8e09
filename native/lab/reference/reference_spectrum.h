// Light of single wavelengths, and the index of glass there.
#pragma once

#include "base/math.h"

/// Where the index of glass stands between its ends at a wavelength: 0 at 587.6 nm.
static inline float vtSpread(float nanometres)
{
    return 523655.0f / (nanometres * nanometres) - 1.5168f;
}

/// The index where the spread is that (KHR_materials_dispersion, by Cauchy's formula). `dispersion`: 20 over
/// the Abbe number.
static inline float vtDispersedIndex(float ior, float dispersion, float spread)
{
    const float index = ior + (ior - 1.0f) * dispersion * 0.05f * spread;
    return dispersion > 0.0f ? fmaxf(index, 1.0f) : ior;
}

/// The mean spread of what red, green and blue of a picture see of white light.
#define VT_SPREAD_RED (-0.228f)
#define VT_SPREAD_GREEN 0.237f
#define VT_SPREAD_BLUE 1.182f

enum { vt_spectrumSteps = 1024 };

/// Wavelengths of equal share, and the colour of each, linear sRGB; the mean of all colours is white.
typedef struct vtSpectrum {
    float nanometres[vt_spectrumSteps];
    vtVec3 colors[vt_spectrumSteps];
} vtSpectrum;
void vtMakeSpectrum(vtSpectrum* spectrum);

/// The wavelength at `at`, 0 to 1, of all, as its spread; its colour, which has parts below 0.
float vtSpectrum_At(const vtSpectrum* spectrum, float at, vtVec3* color);
