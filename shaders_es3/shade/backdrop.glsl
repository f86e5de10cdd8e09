// What lies behind the glass in the host's picture, searched along the ray in its depth. This work is based on:
//   Tiago Sousa, Nick Kasyan, Nicolas Schulz. Secrets of CryENGINE 3 Graphics Technology. SIGGRAPH 2011: a ray marched
//   through the depth buffer;
//   Morgan McGuire, Michael Mara. Efficient GPU Screen-Space Ray Tracing. JCGT 3(4), 2014: steps that are even in the
//   picture, not in space.
// Departures: steps go from the ray's beginning to infinity, in homogeneous coordinates; where it comes to pass behind
// something, the crossing is halved down to, and it counts where the depth is the same on both sides of it. A ray that
// meets nothing and ends in the picture sees what the host has drawn infinitely far away there.
uniform sampler2D u_hostColor;

// Far more steps than presets have (u_search.y).
const int MOST_HOST_STEPS = 1000;
const int HOST_HALVINGS = 8;

// A point of the ray, `s` from 0 to 1: pixel of the picture, and depth. Depth 0 or less: behind the eye.
vec3 hostPoint(vec3 from, vec3 towards, float s)
{
    bool parallel = u_clip.w != 0.0;
    vec3 h = parallel ? from + s * towards : (1.0 - s) * from + s * towards;
    vec2 tangent = parallel ? h.xy : h.xy / h.z;
    vec2 share = (tangent - u_pictureFrustum.xy) / (u_pictureFrustum.zw - u_pictureFrustum.xy);
    return vec3(share * vec2(u_size.xy), parallel || h.z <= 0.0 ? h.z : h.z / max(1.0 - s, 1e-6));
}

bool isOnHost(vec3 point)
{
    return point.z > 0.0 && all(greaterThanEqual(point.xy, vec2(0.0))) && all(lessThan(point.xy, vec2(u_size.xy)));
}

// Depth of the host's picture at a pixel of ours.
float depthAt(vec3 point)
{
    return hostDepth(ivec2(floor(point.xy)) + u_host.xy);
}

vec3 hostColor(vec3 point)
{
    ivec2 pixel = clamp(ivec2(floor(point.xy)) + u_host.xy, ivec2(0), textureSize(u_hostColor, 0) - 1);
    vec3 color = max(texelFetch(u_hostColor, pixel, 0).rgb, 0.0);
    return (u_host.w & 4) != 0 ? color : srgbToLinear(color);
}

// Light from the host's picture along a ray in the world; false where it does not show what the ray meets.
bool lightFromHost(vec3 position, vec3 direction, out vec3 light)
{
    light = vec3(0.0);
    if ((u_host.w & 1) == 0) {
        return false;
    }
    vec3 from = (u_worldToCamera * vec4(position, 1.0)).xyz;
    vec3 towards = mat3(u_worldToCamera) * direction;
    // Half of the steps lie nearer than the eye is.
    towards *= u_clip.w != 0.0 ? min(u_clip.z, 1e6) : max(from.z, 1e-6);
    float step = 1.0 / float(u_search.y), s = 0.0;
    bool isFront = true, isCrossed = false, isInside = true;
    for (int i = 0; i < MOST_HOST_STEPS; ++i) {
        vec3 next = hostPoint(from, towards, s + step);
        isInside = isOnHost(next);
        bool isBehind = isInside && next.z >= depthAt(next);
        isCrossed = isBehind && isFront;
        isFront = !isBehind;
        s = isCrossed ? s : s + step;
        if (!isInside || isCrossed || s >= 1.0 - 0.5 * step) {
            break;
        }
    }
    vec3 end = hostPoint(from, towards, s);
    float ahead = 0.0;
    for (int i = 0; i < HOST_HALVINGS; ++i) {
        step *= 0.5;
        vec3 middle = hostPoint(from, towards, s + step);
        bool isBehind = middle.z >= depthAt(middle);
        s = isCrossed && !isBehind ? s + step : s;
    }
    vec3 before = hostPoint(from, towards, s), behind = hostPoint(from, towards, s + step);
    float depth = depthAt(behind);
    // A surface that the ray comes to lie behind, not the edge of one that it passes behind.
    bool isMet = isCrossed && behind.z - depth <= 0.05 * depth + 2.0 * abs(behind.z - before.z);
    vec3 infinite = hostPoint(from, towards, 1.0);
    bool isSky = !isCrossed && isInside && isOnHost(infinite) && depthAt(infinite) == NOTHING_BEHIND && u_clip.w == 0.0;
    light = hostColor(isMet ? behind : infinite) / u_optics.z; // exposure is not for it
    return isMet || isSky;
}
