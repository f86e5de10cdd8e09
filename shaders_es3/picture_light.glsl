// From a path to light: its direction looks up the environment.
uniform usampler2D u_paths;
uniform usampler2D u_light;
uniform sampler2D u_environment;

// Linear light after exposure, as much of it as a display can show.
vec3 pictureLight(uvec4 path)
{
    // A lost path shows what lies in its last direction: glass goes on being bright there.
    vec3 direction = uintBitsToFloat(path.xyz);
    if (int(path.w) == VT_PATH_BACKGROUND) {
        direction = cameraDirection(pictureTangent(gl_FragCoord.xy));
    }
    vec3 behind = environmentRadiance(u_output.z, u_environment, direction);
    uvec2 light = texelFetch(u_light, ivec2(gl_FragCoord.xy), 0).rg;
    vec2 first = unpackHalf2x16(light.x);
    return clamp(u_optics.z * (behind * first.x + vec3(first.y, unpackHalf2x16(light.y))), 0.0, 1.0);
}

bool seesThrough(uvec4 path)
{
    return u_output.w != 0 && int(path.w) == VT_PATH_BACKGROUND;
}
