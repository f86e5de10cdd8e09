// What surrounds the glass: linear radiance from a unit direction. The twin of src/light/environment.c,
// with the same names and numbers; a change here is a change there.

const float ENVIRONMENT_PI = 3.14159265;

// u, v of the equirectangular map, v = 1 up. atan instead of asin: exact near the poles, the same elsewhere.
vec2 environmentCoordinates(vec3 d)
{
    float across = length(d.xz);
    float azimuth = across > 0.0 ? atan(d.z, d.x) : 0.0; // atan(0, 0) is undefined in GLSL
    return vec2(0.5 + azimuth / (2.0 * ENVIRONMENT_PI), 0.5 + atan(d.y, across) / ENVIRONMENT_PI);
}

// 32 x 16 cells. At the seam u = 1 is the cell of u = 0; at the upper pole v = 1 stays in the last row.
vec3 environmentChecker(vec3 d)
{
    vec2 uv = environmentCoordinates(d);
    float column = mod(floor(32.0 * uv.x), 32.0);
    float row = min(floor(16.0 * uv.y), 15.0);
    float q = mod(column + row, 2.0);
    return (0.15 + 0.75 * q) * (0.675 + 0.325 * d);
}

// How much of an upright rectangular lamp lies in direction d: 1 inside, 0 outside, soft at its edge.
// The lamp stands at distance 1 along `centre` and faces the origin; sizes are half its width and height.
float environmentLamp(vec3 d, vec3 centre, float halfWidth, float halfHeight, float softness)
{
    vec3 forward = normalize(centre);
    vec3 right = normalize(vec3(forward.z, 0.0, -forward.x));
    vec3 up = cross(forward, right);
    float facing = dot(d, forward);
    if (facing <= 0.001) {
        return 0.0;
    }
    float x = abs(dot(d, right)) / facing - halfWidth;
    float y = abs(dot(d, up)) / facing - halfHeight;
    return (1.0 - smoothstep(-softness, softness, x)) * (1.0 - smoothstep(-softness, softness, y));
}

// A product photographer's dark field: a dark room with a pool of light on the backdrop (at -z) behind the
// glass, a floor that sweeps up into it, strips at the sides that draw the rims, a large box above.
vec3 environmentStudio(vec3 d)
{
    vec3 wall = mix(vec3(0.030, 0.033, 0.040), vec3(0.006, 0.007, 0.009), smoothstep(-0.1, 0.9, d.y));
    vec3 ground = mix(vec3(0.020, 0.021, 0.025), vec3(0.110, 0.103, 0.092), 0.5 + 0.5 * d.x);
    vec3 light = mix(ground, wall, smoothstep(-0.55, 0.10, d.y));

    // The backdrop's pool and a weak warm wall behind the camera: no direction is flat.
    float towards = 0.5 - 0.5 * d.z;
    float away = 1.0 - towards;
    float narrow = towards * towards * towards * towards;
    float pool = narrow * narrow * narrow * narrow;
    light += vec3(0.38, 0.45, 0.56) * (pool * (1.0 - 0.8 * d.y));
    light += vec3(0.035, 0.029, 0.023) * (away * away);

    float overhead = environmentLamp(d, vec3(0.0, 0.96, -0.28), 0.62, 0.36, 0.10);
    light += vec3(4.2, 4.2, 4.1) * ((0.70 + 0.50 * d.x) * overhead);
    light += vec3(5.6, 5.8, 6.0) * environmentLamp(d, vec3(-0.96, 0.10, -0.28), 0.16, 1.10, 0.04);
    light += vec3(6.0, 5.6, 5.0) * environmentLamp(d, vec3(0.96, 0.10, -0.28), 0.16, 1.10, 0.04);
    light += vec3(2.4, 2.4, 2.3) * environmentLamp(d, vec3(-0.45, 0.42, 0.79), 0.26, 0.32, 0.02);
    light += vec3(1.2, 1.2, 1.3) * environmentLamp(d, vec3(0.62, 0.05, 0.78), 0.06, 0.90, 0.02);
    return light;
}

// Clear sky in one scattering: 1 - exp(-depth), the depths of red, green and blue in Rayleigh's ratio of
// 1 / wavelength^4 (680, 550, 440 nm) times the air along the ray.
vec3 environmentAir(float height, float towardsSun)
{
    float air = 1.0 / (max(height, 0.0) + 0.08);
    vec3 scattered = 1.0 - exp(-vec3(0.058, 0.135, 0.331) * air);
    return scattered * (0.75 + 0.35 * towardsSun * towardsSun);
}

vec3 environmentSky(vec3 d)
{
    const vec3 SUN = vec3(-0.5, 0.5, -0.70710678); // behind the glass, upper left
    float towardsSun = dot(d, SUN);
    vec3 haze = environmentAir(0.0, towardsSun);
    vec3 light;
    if (d.y >= 0.0) {
        light = environmentAir(d.y, towardsSun);
    } else {
        // A plane one unit below, in tiles of one unit; the tiles fade before they get too fine to show.
        float below = max(-d.y, 0.001);
        vec2 tile = floor(d.xz / below);
        float q = mod(tile.x + tile.y, 2.0) - 0.5;
        float contrast = smoothstep(0.03, 0.30, below);
        vec3 ground = vec3(0.30, 0.26, 0.20) * (1.0 + 0.55 * contrast * q);
        light = mix(ground, haze, exp(-9.0 * below));
    }

    // The sun's disc (drawn 2.5 degrees wide so that it survives sampling), its glare and its wide halo.
    if (d.y > -0.05) {
        float apart = 1.0 - towardsSun;
        vec3 glow = vec3(1.0, 0.9, 0.7) * (2.5 * exp(-300.0 * apart) + 0.45 * exp(-14.0 * apart));
        glow += vec3(48.0, 45.0, 40.0) * (1.0 - smoothstep(0.00018, 0.00030, apart));
        light += glow * smoothstep(-0.05, 0.0, d.y);
    }
    return min(light, vec3(50.0));
}

// How much of the covered angle is blurred: half of it, since the two blended levels blur as much again, and never more
// than 0.03 radians, since beyond that a path's neighbours go elsewhere than its steps say. (method.md has the errors.)
const float BLURRED = 0.5, MOST_BLURRED = 0.03;

// Row 0 of the texture is the picture's top row, so t runs against v. The texture repeats in s and clamps in
// t; the level is named because derivatives jump at the seam and where paths part. `width`: the angle that is covered.
vec3 environmentImage(highp sampler2D image, vec3 d, float width)
{
    vec2 uv = environmentCoordinates(d);
    float texels = min(BLURRED * width, MOST_BLURRED) * float(textureSize(image, 0).y) / ENVIRONMENT_PI;
    return textureLod(image, vec2(uv.x, 1.0 - uv.y), log2(max(texels, 1.0))).rgb;
}

// `kind` is a vtEnvironmentKind; `width`: the angle that is covered, of which only a picture takes the mean.
vec3 environmentRadiance(int kind, highp sampler2D image, vec3 d, float width)
{
    if (kind == 0) {
        return environmentChecker(d);
    }
    if (kind == 1) {
        return environmentStudio(d);
    }
    if (kind == 2) {
        return environmentSky(d);
    }
    return environmentImage(image, d, width);
}
