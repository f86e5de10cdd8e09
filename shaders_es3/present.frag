// From paths to a picture: each direction looks up the environment. Also the views for analysis.
uniform usampler2D u_paths;
uniform usampler2D u_light;
uniform sampler2D u_environment;
uniform usampler2DArray u_layerDepths;
uniform usampler2DArray u_layerNormals;

layout(location = 0) out vec4 o_color;

vec3 linearToSrgb(vec3 c)
{
    c = clamp(c, 0.0, 1.0);
    return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

vec3 pictureColor(uvec4 path)
{
    // A lost path shows what lies in its last direction: glass goes on being bright there.
    vec3 direction = uintBitsToFloat(path.xyz);
    if (int(path.w) == VT_PATH_BACKGROUND) {
        direction = cameraDirection(pictureTangent(gl_FragCoord.xy));
    }
    vec3 behind = environmentRadiance(u_output.z, u_environment, direction);
    uvec2 light = texelFetch(u_light, ivec2(gl_FragCoord.xy), 0).rg;
    vec2 first = unpackHalf2x16(light.x);
    return linearToSrgb(u_optics.z * (behind * first.x + vec3(first.y, unpackHalf2x16(light.y))));
}

vec3 analysisColor(uvec4 path)
{
    int state = int(path.w);
    int events = (state >> 8) & 255;
    if (state == VT_PATH_BACKGROUND) {
        return vec3(1.0);
    }
    if ((state & 255) == VT_PATH_LOST) {
        return vec3(0.35);
    }
    if (state >= VT_PATH_TIR) {
        return vec3(0.10, 0.65, 0.20);
    }
    return events <= 2 ? vec3(0.85, 0.12, 0.10) : vec3(0.10, 0.25, 0.85);
}

vec3 layerColor()
{
    ivec2 texel = ivec2(gl_FragCoord.xy / vec2(u_size.xy) * vec2(u_size.zw));
    uint depth = texelFetch(u_layerDepths, ivec3(texel, u_output.y), 0).r;
    if (depth == VT_DEPTH_NONE) {
        return vec3(0.12, 0.16, 0.30);
    }
    if (u_output.x == VT_OUTPUT_LAYER_DEPTH) {
        return vec3(1.0 - 0.9 * float(depth) / VT_DEPTH_SCALE);
    }
    return 0.5 + 0.5 * unpackNormal(texelFetch(u_layerNormals, ivec3(texel, u_output.y), 0).r);
}

void main()
{
    uvec4 path = texelFetch(u_paths, ivec2(gl_FragCoord.xy), 0);
    vec3 color = u_output.x == VT_OUTPUT_PICTURE    ? pictureColor(path)
                 : u_output.x == VT_OUTPUT_ANALYSIS ? analysisColor(path)
                                                    : layerColor();
    bool seesThrough = u_output.w != 0 && int(path.w) == VT_PATH_BACKGROUND && u_output.x <= VT_OUTPUT_ANALYSIS;
    o_color = seesThrough ? vec4(0.0) : vec4(color, 1.0);
}
