// Light that comes to a point of the world from beyond the scene: from the host's picture, where it shows it, else from
// the environment.
#if !defined(WITH_OPAQUE) && !defined(WITH_ROUGH) // lighting.glsl has it
uniform sampler2D u_environment;
#endif

// `width`: the angle that is covered.
vec3 surroundings(vec3 position, vec3 direction, float width)
{
    vec3 light = environmentRadiance(u_output.z, u_environment, direction, width);
#ifdef WITH_BACKDROP
    vec3 seen;
    if (lightFromHost(position, direction, seen)) {
        light = seen;
    }
#endif
#ifdef WITH_GROUND
    light = groundLight(position, direction, light);
#endif
    return light;
}
