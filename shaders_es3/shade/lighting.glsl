// What an environment does to a surface. The twin of src/light/lighting.c, which names the sources. Wants
// environment.glsl before it.
uniform sampler2D u_lighting;    // src/gl/lighting_texture.h: the blurred environment; a row of nine texels
uniform sampler2D u_environment; // read where the environment is a picture

const int LIGHTING_SIDE = 256;
const int LIGHTING_LEAST = 32;
const int LIGHTING_LEVELS = 5;

vec3 lightingTexel(int column, int row)
{
    return texelFetch(u_lighting, ivec2(column, row), 0).rgb;
}

// Radiance of a matt white surface.
vec3 diffuseLight(vec3 n)
{
    int row = LIGHTING_SIDE;
    vec3 light = lightingTexel(0, row) + n.y * lightingTexel(1, row) + n.z * lightingTexel(2, row);
    light += n.x * lightingTexel(3, row) + n.x * n.y * lightingTexel(4, row) + n.y * n.z * lightingTexel(5, row);
    light += (3.0 * n.z * n.z - 1.0) * lightingTexel(6, row) + n.x * n.z * lightingTexel(7, row);
    light += (n.x * n.x - n.y * n.y) * lightingTexel(8, row);
    return max(light, 0.0);
}

// Bilinear by hand: levels lie below each other and their sides are joined.
vec3 lightingLevel(int level, vec2 uv)
{
    int width = max(LIGHTING_SIDE >> level, LIGHTING_LEAST), height = width / 2;
    int first = LIGHTING_SIDE - (LIGHTING_SIDE >> level);
    float x = (uv.x + 1.0) * float(width) - 0.5; // a turn more: never negative
    float y = clamp((1.0 - uv.y) * float(height) - 0.5, 0.0, float(height - 1));
    int left = int(x) & (width - 1), right = (int(x) + 1) & (width - 1);
    int upper = first + int(y), lower = min(upper + 1, first + height - 1);
    vec3 above = mix(lightingTexel(left, upper), lightingTexel(right, upper), fract(x));
    vec3 below = mix(lightingTexel(left, lower), lightingTexel(right, lower), fract(x));
    return mix(above, below, fract(y));
}

// Radiance about the direction a surface of that roughness reflects to. `width`: the angle that is covered.
vec3 specularLight(vec3 direction, float roughness, float width)
{
    // Level i holds roughness 0.025 (i + 1) (i + 4); -1 is the environment itself.
    float at = 0.5 * (sqrt(9.0 + 160.0 * clamp(roughness, 0.0, 1.0)) - 5.0);
    int level = min(int(floor(at)), LIGHTING_LEVELS - 1);
    vec2 uv = environmentCoordinates(direction);
    vec3 light;
    if (level < 0) {
        light = environmentRadiance(u_output.z, u_environment, direction, width);
    } else {
        light = lightingLevel(level, uv);
    }
    if (at > float(level)) {
        light = mix(light, lightingLevel(min(level + 1, LIGHTING_LEVELS - 1), uv), at - float(level));
    }
    return light;
}
