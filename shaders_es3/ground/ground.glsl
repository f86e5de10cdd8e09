// The ground that the scene stands on, as a ray sees it that meets nothing of the scene any more. The twin of
// vtGroundMap_Light in src/light/ground.c.
uniform sampler2D u_groundMap;  // its light over what it would have without the scene; 1 along the sides
uniform vec4 u_ground;          // height; the map's corner, x and z; 1 / its side
uniform vec4 u_groundRadiance;  // of a matt ground without the scene; 1: it is matt, 0: it shows what is beyond it

// 1 where the ray comes down to it from above.
float meetsGround(vec3 position, vec3 direction)
{
    return step(1e-6, -direction.y) * step(-1e-3 / u_ground.w, position.y - u_ground.x);
}

// Its light there over what it would have without the scene.
vec3 groundShare(vec3 position, vec3 direction)
{
    float distance = max(position.y - u_ground.x, 0.0) / max(-direction.y, 1e-6);
    vec2 place = (position.xz + distance * direction.xz - u_ground.yz) * u_ground.w;
    return textureLod(u_groundMap, clamp(place, 0.0, 1.0), 0.0).rgb;
}

vec3 groundLight(vec3 position, vec3 direction, vec3 beyond)
{
    vec3 light = groundShare(position, direction) * mix(beyond, u_groundRadiance.rgb, u_groundRadiance.w);
    return mix(beyond, light, meetsGround(position, direction));
}

// What the ground does to a page behind it: its shadow covers the page, caustics are added. `light`: as groundLight gives
// it. Colours times the share that they cover.
vec4 groundOverPage(vec3 position, vec3 direction, vec3 light)
{
    float seen = meetsGround(position, direction);
    vec3 share = groundShare(position, direction), more = light * max(1.0 - 1.0 / max(share, 1e-3), 0.0);
    float shadow = 1.0 - min(min(share.r, min(share.g, share.b)), 1.0), glow = max(more.r, max(more.g, more.b));
    return seen * mix(vec4(more, clamp(max(shadow, glow), 0.0, 1.0)), vec4(light, 1.0), u_groundRadiance.w);
}
