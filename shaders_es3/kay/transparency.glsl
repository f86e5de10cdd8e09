// The equations of Kay & Greenberg 1979. The same names and numbers in src/base/optics.h.

// Equation 2. cosine: |Nz|, the part of the unit normal along the view.
float nonlinearTransmittance(float cosine, float maximum, float minimum, float power)
{
    return (maximum - minimum) * (1.0 - pow(1.0 - clamp(cosine, 0.0, 1.0), power)) + minimum;
}

// Equations 4 and 5 and the way through a wall whose thickness along its normal is 1, for a ray along +z that
// meets the unit normal N (N.z <= 0). Gives the path's length; `shift` is its x and y.
float wallPath(vec3 N, float ior, out vec2 shift)
{
    // With I = (0, 0, 1): S = (I - N.z N) / ior, and 1 - |S|^2 written so that index 1 gives N.z exactly.
    float cosine = sqrt(ior * ior - 1.0 + N.z * N.z) / ior;
    vec2 S = -N.z * N.xy / ior;
    vec2 R = S - cosine * N.xy;
    float path = 1.0 / max(cosine, 1e-3);
    shift = path * R;
    return path;
}
