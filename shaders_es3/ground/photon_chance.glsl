// Numbers between 0 and 1 for what a photon leaves to chance: spread evenly over photons that lie side by side. Based on:
//   Abdalla Ahmed, Peter Wonka. Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering of
//   Pixels. SIGGRAPH Asia 2020: one sequence along the Z curve;
//   Martin Roberts. The Unreasonable Effectiveness of Quasirandom Sequences. 2018: steps of the root of x^8 = x + 1.
#define WITH_PHOTONS

uniform int u_groundSeed; // of the drawing: 0 to 3

// A photon's number on the curve, where four drawings have a place each.
uint numberOfPhoton()
{
    uvec2 v = uvec2(gl_FragCoord.xy);
    v = (v | v << 8u) & 0x00ff00ffu;
    v = (v | v << 4u) & 0x0f0f0f0fu;
    v = (v | v << 2u) & 0x33333333u;
    v = (v | v << 1u) & 0x55555555u;
    return 4u * (v.x | v.y << 1u) + uint(u_groundSeed);
}

// For its wavelength: of 32.
uint wavelengthOfPhoton()
{
    return numberOfPhoton() * 0xe95e1dd1u >> 27u;
}

// For the first and second facet that it meets.
vec3 chanceOfPhoton(int facet)
{
    uvec3 steps = facet == 0 ? uvec3(0xd4bc74e1u, 0xc1edbc5bu, 0xb0c8ac51u) : uvec3(0xa127a31du, 0x92e852c9u, 0x85eb75c3u);
    return vec3(steps * numberOfPhoton() >> 8u) / 16777216.0;
}
