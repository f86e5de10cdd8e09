// Numbers for choices by chance: the same whenever a picture is traced again, in whatever order.
#pragma once

#include <stdint.h>

/// What a number is for. A path has new ones at each of its events, by its key.
typedef enum vtChance {
    vt_chanceFacet = 1, ///< which way the surface faces where a rough one is met
    vt_chanceWalk,      ///< how deep that is, and whether what leaves is met again
    vt_chanceWave,      ///< the wavelength
    vt_chanceKeep,      ///< whether a path of little light goes on
    vt_chanceSun,       ///< a point of the sun
    vt_chanceMore,      ///< all that follows
} vtChance;

/// Mixes two words to one that looks like neither.
uint32_t vtMixWords(uint32_t a, uint32_t b);

/// Two numbers in [0, 1). Those of one key and purpose over samples 0, 1, 2... fill the square evenly, those
/// of different keys or purposes have nothing to do with one another.
void vtChance_Pair(uint32_t key, vtChance purpose, uint32_t sample, float pair[2]);

/// The next one of a row that is only random; `state` begins as vtMixWords of whatever tells rows apart.
float vtChance_Next(uint32_t* state);
