// The filmic curve of ACES; the twin of aces in src/light/tone_mapping.c, where its source is.
#define WITH_TONE
vec3 toneMap(vec3 light)
{
    const mat3 FROM_SRGB = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
    const mat3 TO_SRGB = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
    vec3 c = FROM_SRGB * (light / 0.6);
    c = (c * (c + 0.0245786) - 0.000090537) / (c * (0.983729 * c + 0.4329510) + 0.238081);
    return clamp(TO_SRGB * c, 0.0, 1.0);
}
