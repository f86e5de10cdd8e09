// Light that comes to a point of the world from beyond the scene: from the host's picture, where it shows it, or from the
// backdrop, where the ray meets it, else from the environment.
#if !defined(WITH_OPAQUE) && !defined(WITH_ROUGH) // lighting.glsl has it
uniform sampler2D u_environment;
#endif

// `width`: the angle that is covered; lobe: of rough glass (rough.glsl), else zeros.
#ifdef WITH_BACKDROP
vec3 surroundings(vec3 position, vec3 direction, float width, vec3 lobe, Footprint footprint)
#else
vec3 surroundings(vec3 position, vec3 direction, float width, vec3 lobe)
#endif
{
#ifdef WITH_ROUGH
    vec3 light = specularLight(direction, lobeRoughness(lobe), width);
#ifdef WITH_SHADE
    light += u_sun[3].rgb * sunGlare(u_sun[2], direction, lobeRoughness(lobe));
#endif
    if (lobe.z <= 0.0) {
        light = environmentRadiance(u_output.z, u_environment, direction, width);
    }
#else
    vec3 light = environmentRadiance(u_output.z, u_environment, direction, width);
#endif
#ifdef WITH_HOST
    vec3 seen;
    if (lightFromHost(position, direction, lobe, seen)) {
        light = seen;
    }
#endif
#ifdef WITH_BACKDROP
    light = backdropLight(position, direction, footprint, lobe, light);
#endif
#ifdef WITH_GROUND
    light = groundLight(position, direction, light);
#endif
    return light;
}
