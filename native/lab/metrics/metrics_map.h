// Difference pictures: what the metrics say, pixel by pixel, as colours.
#pragma once

#include <stddef.h>
#include <stdint.h>

/// The colour map "magma" of matplotlib (S. van der Walt and N. Smith, CC0), black to pale yellow, from 17
/// of its 256 entries; in between linear, which is within 3 codes of the map. `value` 0 to 1, clamped.
void vtMagma(float value, uint8_t rgb[3]);

/// A FLIP map in magma: `count` numbers to 3 * count bytes.
void vtDrawFlip(const float* flipMap, size_t count, uint8_t* rgb);

/// Angles to the truth: 0 degrees dark blue, over blue and yellow to red at 5 and above; lost magenta. White
/// is background in both, light grey glass only in the result, grey what the truth itself lost.
void vtDrawDirectionDifference(const float* directions, const float* truth, size_t count, uint8_t* rgb);
