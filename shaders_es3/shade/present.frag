// From light to a picture of one sample a pixel. Also the views for analysis.
uniform usampler2D u_paths;
uniform usampler2D u_radiance;
uniform usampler2DArray u_layerDepths;
uniform usampler2DArray u_layerNormals;

vec3 analysisColor(uvec4 path)
{
    int state = int(path.w);
    int events = (state >> 8) & 127;
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
    ivec2 texel = ivec2((gl_FragCoord.xy - vec2(u_host.xy)) / vec2(u_size.xy) * vec2(u_size.zw));
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
    ivec2 pixel = ivec2(gl_FragCoord.xy) - u_host.xy;
    vec4 light = uintBitsToFloat(readTexel(u_radiance, pixel, u_size.xy));
    if (u_output.x == VT_OUTPUT_PICTURE) {
        o_color = SHOWN(displayed(light.rgb / (light.a > 0.0 ? light.a : 1.0), light.a));
    } else if (u_output.x == VT_OUTPUT_ANALYSIS) {
        uvec4 path = texelFetch(u_paths, pixel, 0);
        bool isClear = u_output.w == VT_BACKGROUND_TRANSPARENT && int(path.w) == VT_PATH_BACKGROUND;
        o_color = SHOWN(isClear ? vec4(0.0) : vec4(analysisColor(path), 1.0));
    } else {
        o_color = SHOWN(vec4(layerColor(), 1.0));
    }
}
