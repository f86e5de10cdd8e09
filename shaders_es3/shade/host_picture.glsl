// What lies behind the glass in the host's picture, searched along the ray in its depth. This work is based on:
//   Tiago Sousa, Nick Kasyan, Nicolas Schulz. Secrets of CryENGINE 3 Graphics Technology. SIGGRAPH 2011: a ray marched
//   through the depth buffer;
//   Morgan McGuire, Michael Mara. Efficient GPU Screen-Space Ray Tracing. JCGT 3(4), 2014: steps that are even in the
//   picture, not in space.
// Departures: steps go from the ray's beginning to infinity, in homogeneous coordinates; where it comes to pass behind
// something, the crossing is halved down to, and it counts where the depth is the same on both sides of it, else the ray goes
// on. One that meets nothing and ends in the picture before all else sees what the host has drawn infinitely far away there.
uniform sampler2D u_hostColor;

// Far more steps than presets have (u_search.y).
const int MOST_HOST_STEPS = 1000;
const int HOST_HALVINGS = 8;
const int MOST_HOST_CROSSINGS = 4; // of things that a ray passes behind, and of what it meets

// A point of the ray, `s` from 0 to 1: pixel of the picture, and depth. Depth 0 or less: behind the eye.
vec3 hostPoint(vec3 from, vec3 towards, float s)
{
    bool parallel = u_clip.w != 0.0;
    vec3 h = mix(1.0 - s, 1.0, parallel) * from + s * towards;
    vec2 tangent = h.xy / mix(h.z, 1.0, parallel);
    vec2 share = (tangent - u_pictureFrustum.xy) / (u_pictureFrustum.zw - u_pictureFrustum.xy);
    return vec3(share * vec2(u_size.xy), h.z / mix(max(1.0 - s, 1e-6), 1.0, any(bvec2(parallel, h.z <= 0.0))));
}

bool isOnHost(vec3 point)
{
    vec2 inside = step(vec2(0.0), point.xy) * (1.0 - step(vec2(u_size.xy), point.xy));
    return inside.x * inside.y * float(point.z > 0.0) > 0.5;
}

// Depth of the host's picture at a pixel of ours.
float depthAt(vec3 point)
{
    return hostDepth(ivec2(floor(point.xy)) + u_host.xy);
}

// `spread`: standard deviation of the places that are seen, pixels.
vec3 hostColor(vec3 point, float spread)
{
    ivec2 size = textureSize(u_hostColor, 0), pixel = clamp(ivec2(floor(point.xy)) + u_host.xy, ivec2(0), size - 1);
    vec3 color = texelFetch(u_hostColor, pixel, 0).rgb;
#ifdef WITH_ROUGH
    // A texel of level n, blended with its neighbours, has a standard deviation of half its width.
    float level = (u_host.w & 8) != 0 ? log2(max(2.0 * spread, 1.0)) : 0.0;
    vec2 place = (point.xy + vec2(u_host.xy)) / vec2(size), apart = 0.5 * exp2(level) / vec2(size);
    vec3 blurred = vec3(0.0);
    for (int i = 0; i < 4; ++i) { // a level's texels show where only one is read
        vec2 corner = vec2(i & 1, i >> 1) - 0.5;
        blurred += 0.25 * textureLod(u_hostColor, place + corner * apart, max(level - 0.5, 0.0)).rgb;
    }
    color = mix(color, blurred, step(0.01, level));
#endif
    color = max(color, 0.0);
    return mix(srgbToLinear(color), color, bvec3((u_host.w & 4) != 0));
}

// Pixels that a length in front of the eye takes, at a depth; of a direction's share at depth 1.
float hostPixels(float depth)
{
    return float(u_size.y) / ((u_pictureFrustum.w - u_pictureFrustum.y) * mix(depth, 1.0, u_clip.w != 0.0));
}

// Light that comes from a place of something opaque of ours, which the host draws as well: as it has drawn it, where that is
// seen in its picture, else as it is.
vec3 asHostShows(vec3 position, vec3 light)
{
    vec3 point = hostPoint((u_worldToCamera * vec4(position, 1.0)).xyz, vec3(0.0), 0.0);
    bool isShown = all(bvec3((u_host.w & 17) == 17, isOnHost(point), abs(depthAt(point) - point.z) < 0.005 * point.z));
    return mix(light, hostColor(point, 0.0) / u_optics.z, bvec3(isShown));
}

// Light from the host's picture along a ray in the world; false where it does not show what the ray meets. lobe: of rough
// glass, else zeros.
bool lightFromHost(vec3 position, vec3 direction, vec3 lobe, out vec3 light)
{
    light = vec3(0.0);
    if ((u_host.w & 1) == 0) {
        return false;
    }
    vec3 from = (u_worldToCamera * vec4(position, 1.0)).xyz;
    vec3 towards = mat3(u_worldToCamera) * direction;
    // Half of the steps lie nearer than the eye is.
    towards *= mix(max(from.z, 1e-6), min(u_clip.z, 1e6), u_clip.w != 0.0);
    float part = 1.0 / float(u_search.y), s = 0.0;
    bool isFront = true, isCrossed = false, isInside = true, isMet = false;
    vec3 behind = from;
    for (int crossing = 0; crossing < MOST_HOST_CROSSINGS; ++crossing) {
        for (int i = 0; i < MOST_HOST_STEPS; ++i) {
            vec3 next = hostPoint(from, towards, s + part);
            isInside = isOnHost(next);
            bool isBehind = all(bvec2(isInside, next.z >= depthAt(next)));
            isCrossed = all(bvec2(isBehind, isFront));
            isFront = !isBehind;
            s += mix(part, 0.0, isCrossed);
            if (any(bvec3(!isInside, isCrossed, s >= 1.0 - 0.5 * part))) {
                break;
            }
        }
        float low = s, rest = part;
        for (int i = 0; i < HOST_HALVINGS; ++i) {
            rest *= 0.5;
            vec3 middle = hostPoint(from, towards, low + rest);
            low += mix(rest, 0.0, middle.z >= depthAt(middle));
        }
        vec3 before = hostPoint(from, towards, low);
        behind = hostPoint(from, towards, low + rest);
        float depth = depthAt(behind);
        // A surface that the ray comes to lie behind, not the edge of one that it passes behind: it goes on beyond that.
        isMet = all(bvec2(isCrossed, behind.z - depth <= 0.05 * depth + 2.0 * abs(behind.z - before.z)));
        s += part;
        if (isCrossed == isMet) {
            break;
        }
    }
    vec3 infinite = hostPoint(from, towards, 1.0);
    bool isEnd = all(bvec4(!isCrossed, isFront, isInside, u_clip.w == 0.0));
    bool isSky = all(bvec3(isEnd, isOnHost(infinite), depthAt(infinite) == NOTHING_BEHIND));
    float spread = 0.0;
#ifdef WITH_ROUGH
    float distance = length((behind.z - from.z) / mix(1e-9, towards.z, abs(towards.z) > 1e-9) * towards);
    float seen = lobe.x + distance * (2.0 * lobe.y + distance * lobe.z); // as lobeAfter; of two axes
    spread = sqrt(0.5 * max(mix(lobe.z, seen, isMet), 0.0)) * hostPixels(mix(1.0, behind.z, isMet));
#endif
    light = hostColor(mix(infinite, behind, bvec3(isMet)), spread) / u_optics.z; // exposure is not for it
    return any(bvec2(isMet, isSky));
}
