// How far neighbouring paths lie apart: what one step of a pixel, to the right and up, does to a path's place and
// direction. It says how much of the environment, or of an opaque thing's picture, a pixel covers. This work is based on:
//   Homan Igehy. Tracing Ray Differentials. SIGGRAPH 1999;
//   Zhen-Qian Weng. Direct Rendering of Height Fields: the change of the smooth normal, dN = dN/du du + dN/dv dv.
// Departures:
// - The change of the normal is a matrix over the place, so that it is found where the triangle is read, once.
// - With several samples a pixel each covers less than it: sample n covers 1 / n of the pixel's area.
// Needs frame. Columns: a step to the right, a step up; WITH_FAN: a step of the spread (spectral.glsl), too.
#define WITH_FOOTPRINT
#ifdef WITH_FAN
#define STEPS mat3
#define CHANGES vec3
#else
#define STEPS mat2x3
#define CHANGES vec2
#endif

struct Footprint {
    STEPS place, direction;
};

// Of the eye ray through a point of the plane at depth 1.
Footprint eyeFootprint(vec2 tangent, vec3 direction)
{
    vec2 pixel = (u_pictureFrustum.zw - u_pictureFrustum.xy) / (vec2(u_size.xy) * sqrt(max(u_optics.w, 1.0)));
    STEPS step = STEPS(0.0);
    step[0] = vec3(pixel.x, 0.0, 0.0) * mat3(u_worldToCamera);
    step[1] = vec3(0.0, pixel.y, 0.0) * mat3(u_worldToCamera);
    float depth = inversesqrt(1.0 + dot(tangent, tangent));
    return Footprint(u_clip.w * step, (1.0 - u_clip.w) * depth * (step - outerProduct(direction, direction * step)));
}

// The steps' places where the surface of normal G is met, not at the same distance.
STEPS alongSurface(STEPS place, vec3 I, vec3 G)
{
    return place - outerProduct(I, (G * place) / dot(G, I));
}

// Of the direction that meetInterface (optics.glsl) gives, with N as it has left it: `turn` is N's change.
STEPS bendFootprint(STEPS direction, vec3 I, vec3 N, STEPS turn, float eta, bool reflected)
{
    float c = dot(N, I);
    CHANGES change = I * turn + N * direction; // of c
    float s = sqrt(max(1.0 - eta * eta * (1.0 - c * c), 1e-4));
    float a = mix(eta, 1.0, reflected), b = mix(eta * c + s, 2.0 * c, reflected); // the new direction is a I - b N
    float more = mix(eta + eta * eta * c / s, 2.0, reflected);
    return a * direction - outerProduct(N, more * change) - b * turn;
}

#ifdef WITH_FAN
// What a change of eta does to the direction that goes through.
vec3 bentByIndex(vec3 I, vec3 N, float eta, float change)
{
    float c = dot(N, I), s = sqrt(max(1.0 - eta * eta * (1.0 - c * c), 1e-4));
    return change * (I - (c - eta * (1.0 - c * c) / s) * N);
}
#endif

// How wide the parallelogram between the steps is: between the side of a square as large and the longer axis of the
// ellipse about it, whose mean in powers gave the least error.
float footprintWidth(STEPS steps)
{
    vec3 area = cross(steps[0], steps[1]);
    float sum = dot(steps[0], steps[0]) + dot(steps[1], steps[1]), square = dot(area, area);
    float longer = 0.5 * (sum + sqrt(max(sum * sum - 4.0 * square, 0.0))); // squared
    return sqrt(sqrt(sqrt(square) * longer));
}
