// This work is based on: Chris Wyman, Peter-Pike Sloan, Peter Shirley. Simple Analytic Approximations to the
// CIE XYZ Color Matching Functions. 2013 (the fit of several lobes), and IEC 61966-2-1 (sRGB).
// Departures: wavelengths are taken as often as they weigh, and each channel of sRGB is scaled so that light
// of the same strength at all wavelengths is white.
#include "lab/reference/reference_spectrum.h"

/// A lobe with a width of its own on each side of its peak.
static double lobe(double at, double height, double peak, double below, double above)
{
    const double t = (at - peak) / (at < peak ? below : above);
    return height * exp(-0.5 * t * t);
}

static void matchColor(double at, double rgb[3])
{
    const double x = lobe(at, 1.056, 599.8, 37.9, 31.0) + lobe(at, 0.362, 442.0, 16.0, 26.7) -
                     lobe(at, 0.065, 501.1, 20.4, 26.2);
    const double y = lobe(at, 0.821, 568.8, 46.9, 40.5) + lobe(at, 0.286, 530.9, 16.3, 31.1);
    const double z = lobe(at, 1.217, 437.0, 11.8, 36.0) + lobe(at, 0.681, 459.0, 26.0, 13.8);
    rgb[0] = 3.2404542 * x - 1.5371385 * y - 0.4985314 * z;
    rgb[1] = -0.9692660 * x + 1.8760108 * y + 0.0415560 * z;
    rgb[2] = 0.0556434 * x - 0.2040259 * y + 1.0572252 * z;
}

void vtMakeSpectrum(vtSpectrum* spectrum)
{
    enum { first = 380, count = 350 };
    double weights[count], total = 0.0, sums[3] = {0.0};
    for (int i = 0; i < count; ++i) {
        double rgb[3];
        matchColor(first + i + 0.5, rgb);
        weights[i] = fabs(rgb[0]) + fabs(rgb[1]) + fabs(rgb[2]);
        total += weights[i];
    }
    double below = 0.0; // of all weights before nanometre i
    for (int k = 0, i = 0; k < vt_spectrumSteps; ++k) {
        const double wanted = total * (k + 0.5) / vt_spectrumSteps;
        while (i < count - 1 && below + weights[i] < wanted) {
            below += weights[i++];
        }
        const double at = first + i + (wanted - below) / weights[i];
        double rgb[3];
        matchColor(at, rgb);
        const double share = 1.0 / weights[i];
        spectrum->nanometres[k] = (float)at;
        spectrum->colors[k] =
            (vtVec3){(float)(rgb[0] * share), (float)(rgb[1] * share), (float)(rgb[2] * share)};
        for (int c = 0; c < 3; ++c) {
            sums[c] += rgb[c] * share / vt_spectrumSteps;
        }
    }
    for (int k = 0; k < vt_spectrumSteps; ++k) {
        vtVec3* color = &spectrum->colors[k];
        *color = (vtVec3){(float)((double)color->x / sums[0]), (float)((double)color->y / sums[1]),
                          (float)((double)color->z / sums[2])};
    }
}

float vtSpectrum_At(const vtSpectrum* spectrum, float at, vtVec3* color)
{
    const int step = (int)vtClamp(at * (float)vt_spectrumSteps, 0.0f, (float)(vt_spectrumSteps - 1));
    *color = spectrum->colors[step];
    return vtSpread(spectrum->nanometres[step]);
}
