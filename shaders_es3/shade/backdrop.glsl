// The picture that stands behind the scene, as a ray sees it that meets nothing of the scene any more. The twin of
// vtBackdrop_Light in src/light/backdrop.c. Needs footprint; rough glass: rough.glsl.
uniform sampler2D u_backdrop;       // sRGB with all its levels; beyond its sides it is mirrored
uniform vec4 u_backdropPlace[3];    // vtBackdropPlace

// The mean over so many texels. Row 0 of the texture is the picture's top row.
vec3 backdropColor(vec2 at, float texels)
{
    float level = log2(max(texels, 1.0));
    vec3 color = textureLod(u_backdrop, at, level).rgb;
#ifdef WITH_ROUGH
    vec2 apart = 0.5 * exp2(level) / vec2(textureSize(u_backdrop, 0));
    vec3 blurred = vec3(0.0);
    for (int i = 0; i < 4; ++i) { // a level's texels show where only one is read
        vec2 corner = vec2(i & 1, i >> 1) - 0.5;
        blurred += 0.25 * textureLod(u_backdrop, at + corner * apart, max(level - 0.5, 0.0)).rgb;
    }
    color = mix(color, blurred, step(0.01, level));
#endif
    return color;
}

// The picture where the ray meets its plane from the front, else `beyond`. lobe: of rough glass (rough.glsl), else zeros.
vec3 backdropLight(vec3 position, vec3 direction, Footprint steps, vec3 lobe, vec3 beyond)
{
    vec3 normal = u_backdropPlace[0].xyz;
    float towards = dot(normal, direction), gap = u_backdropPlace[0].w - dot(normal, position);
    float isMet = step(1e-3, towards) * step(0.0, gap), distance = isMet * gap / max(towards, 1e-3);
    vec4 place = vec4(position + distance * direction, 1.0);
    vec2 at = vec2(dot(u_backdropPlace[1], place), dot(u_backdropPlace[2], place));
    float width = footprintWidth(alongSurface(steps.place + distance * steps.direction, direction, mix(direction, normal, isMet)));
#ifdef WITH_ROUGH
    width = lobeWidth(width, lobeAfter(lobe, distance).x);
#endif
    float texels = width * length(u_backdropPlace[2].xyz) * float(textureSize(u_backdrop, 0).y);
    return mix(beyond, backdropColor(at, texels) / u_optics.z, isMet); // exposure is not for it
}
