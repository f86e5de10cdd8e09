// Khronos PBR Neutral; the twin of neutral in src/light/tone_mapping.c, where its source is.
#define WITH_TONE
vec3 toneMap(vec3 light)
{
    const float BASE = 0.04, KNEE = 0.8 - BASE, DESATURATION = 0.15;
    float least = min(light.r, min(light.g, light.b));
    light -= least < 2.0 * BASE ? least - least * least / (4.0 * BASE) : BASE;
    float peak = max(light.r, max(light.g, light.b));
    float room = 1.0 - KNEE, above = max(peak - KNEE, 0.0);
    float shown = peak < KNEE ? peak : 1.0 - room * room / (above + room);
    float grey = 1.0 - 1.0 / (1.0 + DESATURATION * (peak - shown));
    return peak < KNEE ? light : mix(light * (shown / peak), vec3(shown), grey);
}
