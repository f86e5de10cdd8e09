// Numbers between 0 and 1 for what a sample leaves to chance: another for every pixel, sample and use. Based on:
//   Mark Jarzynski, Marc Olano. Hash Functions for GPU Rendering. JCGT 2020: pcg3d;
//   R. Cranley, T. N. L. Patterson. Randomization of Number Theoretic Methods for Multiple Integration. 1976: a sequence
//   shifted by another number in every pixel.
// Needs frame. Of photons the numbers are photon_chance.glsl's.

// Does chance choose? In all samples but the first, and for photons.
#ifdef WITH_PHOTONS
#define BY_CHANCE true
#else
#define BY_CHANCE (u_sample.y != 0)
#endif

vec3 mixedNumbers(uvec3 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return vec3(v >> 8u) / 16777216.0;
}

// Of the sample's path number `round`: of the first two they are spread evenly over the samples.
float chanceOf(int round)
{
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    float shift = mixedNumbers(uvec3(pixel, uint(round) + (round < 2 ? 0u : 64u * uint(u_sample.x)))).x;
    return fract(shift + (round == 0 ? u_eye.w : round == 1 ? fract(43.0 * u_eye.w) : 0.0));
}

#ifdef WITH_ROUGH
// Numbers for the facet that the sample meets, by path.glsl's count: of its first two the first two are spread evenly over
// the samples, by steps of the root of x^5 = x + 1.
vec3 chanceOfFacet(int facet)
{
#ifdef WITH_PHOTONS
    if (facet < 2) {
        return chanceOfPhoton(facet);
    }
#endif
    bool isSpread = facet < 2;
    uint use = 0x10000u + uint(facet);
    uint sampled = 0x100000u * uint(u_sample.x);
    vec3 number = mixedNumbers(uvec3(gl_FragCoord.xy, use + (isSpread ? 0u : sampled)));
    vec2 steps = facet == 0 ? vec2(0.85667488, 0.73389185) : vec2(0.62870672, 0.53859726);
    return fract(number + (isSpread ? fract(float(u_sample.x) * vec3(steps, 0.43359780)) : vec3(0.0)));
}
#endif
