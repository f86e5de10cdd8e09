// AgX; the twin of agx in src/light/tone_mapping.c, where its source is.
#define WITH_TONE
vec3 toneMap(vec3 light)
{
    const mat3 TO_REC2020 = mat3(0.6274, 0.0691, 0.0164, 0.3293, 0.9195, 0.0880, 0.0433, 0.0113, 0.8956);
    const mat3 FROM_REC2020 = mat3(1.6605, -0.1246, -0.0182, -0.5876, 1.1329, -0.1006, -0.0728, -0.0083, 1.1187);
    const mat3 INSET = mat3(0.856627153, 0.137318973, 0.111898213, 0.0951212405, 0.761241991, 0.0767994186,
                            0.0482516061, 0.101439036, 0.811302368);
    const mat3 OUTSET = mat3(1.12710058, -0.141329763, -0.141329763, -0.110606643, 1.15782370, -0.110606643,
                             -0.0164939387, -0.0164939387, 1.25193641);
    const float LEAST = -12.47393, MOST = 4.026069; // log2 of 0.18, 10 stops below and 6.5 above
    vec3 c = log2(max(INSET * (TO_REC2020 * light), 1e-10));
    c = clamp((c - LEAST) / (MOST - LEAST), 0.0, 1.0);
    vec3 c2 = c * c, c4 = c2 * c2;
    c = 15.5 * c4 * c2 - 40.14 * c4 * c + 31.96 * c4 - 6.868 * c2 * c + 0.4298 * c2 + 0.1191 * c - 0.00232;
    c = pow(max(OUTSET * c, 0.0), vec3(2.2));
    return clamp(FROM_REC2020 * c, 0.0, 1.0);
}
