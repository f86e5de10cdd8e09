// The ground that the scene stands on, as a ray sees it that meets nothing of the scene any more. The twin of
// vtGroundMap_Light in src/light/ground.c.
uniform sampler2D u_groundMap;  // its light over what it would have without the scene; 1 along the sides
uniform vec4 u_ground;          // height; the map's corner, x and z; 1 / its side
uniform vec4 u_groundMatt[2];   // its colour, 1: it is matt, 0: it shows what is beyond it; its irradiance without the
                                // scene, but for lights of files

// 1 where the ray comes down to it from above.
float meetsGround(vec3 position, vec3 direction)
{
    return step(1e-6, -direction.y) * step(-1e-3 / u_ground.w, position.y - u_ground.x);
}

// Where it does.
vec3 placeOnGround(vec3 position, vec3 direction)
{
    return position + max(position.y - u_ground.x, 0.0) / max(-direction.y, 1e-6) * direction;
}

// Its light there over what it would have without the scene.
vec3 groundShare(vec3 at)
{
    return textureLod(u_groundMap, clamp((at.xz - u_ground.yz) * u_ground.w, 0.0, 1.0), 0.0).rgb;
}

// Irradiance of a matt ground without the scene.
vec3 groundIrradiance(vec3 at)
{
    vec3 light = u_groundMatt[1].rgb;
#ifdef WITH_LOOKS
    int count = u_groundMatt[0].w > 0.0 ? int(materialTexel(0u).x) : 0;
    for (int i = 0; i < VT_MOST_LIGHTS; ++i) {
        if (i >= count) {
            break;
        }
        float distance;
        vec3 L, sent = lightSent(i, at, L, distance);
        light += sent * max(L.y, 0.0);
    }
#endif
    return light;
}

vec3 groundLight(vec3 position, vec3 direction, vec3 beyond)
{
    vec3 at = placeOnGround(position, direction);
    vec3 matt = u_groundMatt[0].rgb * groundIrradiance(at) / 3.14159265;
    return mix(beyond, groundShare(at) * mix(beyond, matt, u_groundMatt[0].w), meetsGround(position, direction));
}

// What the ground does to a page behind it: its shadow covers the page, caustics are added. `light`: as groundLight gives
// it. Colours times the share that they cover.
vec4 groundOverPage(vec3 position, vec3 direction, vec3 light)
{
    float seen = meetsGround(position, direction);
    vec3 share = groundShare(placeOnGround(position, direction)), more = light * max(1.0 - 1.0 / max(share, 1e-3), 0.0);
    float shadow = 1.0 - min(min(share.r, min(share.g, share.b)), 1.0), glow = max(more.r, max(more.g, more.b));
    return seen * mix(vec4(more, clamp(max(shadow, glow), 0.0, 1.0)), vec4(light, 1.0), u_groundMatt[0].w);
}
