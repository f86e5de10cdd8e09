// Unit vectors in 32 bits: the octahedral map of Meyer et al. 2010 ("On floating-point normal vectors"),
// two 16-bit signed numbers. The largest error is about 0.003 degrees.

uint packNormal(vec3 n)
{
    n /= abs(n.x) + abs(n.y) + abs(n.z);
    vec2 flip = vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
    return packSnorm2x16(n.z >= 0.0 ? n.xy : (1.0 - abs(n.yx)) * flip);
}

vec3 unpackNormal(uint bits)
{
    vec2 e = unpackSnorm2x16(bits);
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    float fold = max(-n.z, 0.0);
    n.xy -= fold * (2.0 * step(0.0, n.xy) - 1.0); // no ?: here: each in a loop doubles what SwiftShader takes to compile
    return normalize(n);
}
