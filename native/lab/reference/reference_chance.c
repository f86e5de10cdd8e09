// This work is based on: Brent Burley. Practical Hash-based Owen Scrambling. 2020: Sobol's first two
// dimensions for each purpose anew, the order of its points and its points scrambled as Owen 1995 does.
// Departure: each bit is turned by a hash of the bits above it, as Owen has it, down to the last that float
// holds; the paper has a faster hash that comes near it.
#include "lab/reference/reference_chance.h"

uint32_t vtMixWords(uint32_t a, uint32_t b)
{
    // Two rounds of multiply and shift; the constants are odd and have about as many ones as zeros.
    uint32_t x = a * 0x9e3779b1u ^ (b + 0x7f4a7c15u) * 0x85ebca77u;
    x = (x ^ x >> 15) * 0x2c1b3c6du;
    x = (x ^ x >> 12) * 0x297a2d39u;
    return x ^ x >> 15;
}

/// Turns each of `count` bits, from the highest that counts on, by a hash of those above it.
static uint32_t scramble(uint32_t x, uint32_t seed, int highest, int count)
{
    uint32_t turned = x;
    for (int bit = highest; bit > highest - count; --bit) {
        const uint32_t above = bit < 31 ? x >> (bit + 1) : 0;
        turned ^= (vtMixWords(seed, 1u << (31 - bit) | above) & 1u) << bit;
    }
    return turned;
}

static uint32_t reverse(uint32_t x)
{
    uint32_t reversed = 0;
    for (int i = 0; i < 32; ++i) {
        reversed = reversed << 1 | (x >> i & 1u);
    }
    return reversed;
}

/// Sobol's second dimension of a point whose number is `index`.
static uint32_t secondDimension(uint32_t index)
{
    uint32_t sum = 0;
    for (uint32_t column = 1u << 31; index != 0; index >>= 1, column ^= column >> 1) {
        sum ^= index & 1u ? column : 0u;
    }
    return sum;
}

static float toUnit(uint32_t x)
{
    return (float)(x >> 8) * (1.0f / 16777216.0f);
}

void vtChance_Pair(uint32_t key, vtChance purpose, uint32_t sample, float pair[2])
{
    const uint32_t seed = vtMixWords(key, (uint32_t)purpose);
    const uint32_t index = scramble(sample, seed, 16, 17); // VT_MAX_TRACED_SAMPLES have no more bits
    pair[0] = toUnit(scramble(reverse(index), vtMixWords(seed, 1), 31, 24));
    pair[1] = toUnit(scramble(secondDimension(index), vtMixWords(seed, 2), 31, 24));
}

float vtChance_Next(uint32_t* state)
{
    *state = vtMixWords(*state, 0x51ed270bu);
    return toUnit(*state);
}
