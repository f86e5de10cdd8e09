// This work is based on:
//   Shi-Hao Wang, Ming-Te Chi. Image Space Real-time Multi-refraction Technology. National Chengchi
//   University, 2014, sections 3.3 to 3.6; its search is the relief mapping of Policarpo, Oliveira, Comba
//   2005, as Oliveira and Brauwers 2007 use it for refraction.
// Departures:
// - All layers are compared at every step and the first surface met is taken. The paper searches layer 2,
//   then 3, then 4, one after the other; since merged layers go on where a layer ends, the surface found
//   is the same, and a path may meet the layers in any order after a total internal reflection.
// - The linear steps divide the ray's way through the object's box rather than the way from Zmin to Zmax,
//   which has no end for a ray across the view.
// - A surface counts only if the ray leaves the glass (inside) or enters it (outside) through it.
// - After the binary search the surface is the blend of the tangent planes of the four texels around it,
//   so that neither point nor normal shows the texels.
// - Where the flag changes with no surface near and the column says that the glass ends there, the ray has
//   met a wall steeper than the layers can show, such as the silhouette's rim: a hit, not a loss.

const float FIRST_STEP = 0.1; // of a linear step: clears the surface that the ray starts on
const float BOX_MARGIN = 4.0; // texels at the far end
const int SPARE_STEPS = 16;   // faults passed on the way do not use up the linear steps

// Distance along the ray to where it leaves the object's box, widened by a few texels: a face of the object
// that lies in a face of its box is found only once the ray is behind the depth of the texel there.
float boxExit(vec3 origin, vec3 direction)
{
    float margin = BOX_MARGIN * u_layerDepth.y * (u_layerFrustum.z - u_layerFrustum.x) / float(u_size.z);
    vec3 low = (u_boundsMin.xyz - margin - origin) / direction;
    vec3 high = (u_boundsMax.xyz + margin - origin) / direction;
    vec3 leave = max(low, high);
    return max(min(leave.x, min(leave.y, leave.z)), 0.0);
}

bool facesRightWay(vec3 normal, vec3 direction, bool inside)
{
    return (dot(normal, direction) > 0.0) == inside;
}

// The hit near parameter t on a continuous piece of a layer, from the tangent planes of 2 x 2 texels.
SurfaceHit blendTexels(int layer, vec3 origin, vec3 direction, vec3 point, float t, float jump, uvec2 nearest)
{
    vec3 nearestNormal = unpackNormal(nearest.x);
    vec3 nearestFlat = unpackNormal(nearest.y);
    vec2 corner = floor(point.xy - 0.5);
    vec2 fraction = point.xy - 0.5 - corner;
    vec3 normal = vec3(0.0), flatNormal = vec3(0.0);
    float offset = 0.0, total = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        ivec2 texel = layerTexel(corner + vec2(step) + 0.5);
        float stored = float(layerDepth(layer, texel));
        uvec2 bits = layerNormals(layer, texel);
        if (stored > VT_DEPTH_SCALE || abs(stored - point.z) > jump || bits.x == VT_NO_NORMAL) {
            continue; // another surface
        }
        vec3 n = unpackNormal(bits.x);
        if (dot(n, nearestNormal) < 0.8) {
            continue; // beyond an edge
        }
        vec3 g = unpackNormal(bits.y);
        float slope = dot(g, direction);
        if (slope * dot(nearestFlat, direction) <= 0.0) {
            continue;
        }
        vec2 w = mix(1.0 - fraction, fraction, vec2(step));
        float weight = w.x * w.y + 1e-4;
        float hit = dot(layerWorldPoint(texel, stored) - (origin + t * direction), g) / slope;
        offset += weight * hit;
        normal += weight * n;
        flatNormal += weight * g;
        total += weight;
    }
    if (total == 0.0) {
        return SurfaceHit(origin + t * direction, nearestNormal, nearestFlat);
    }
    // A plane met at a grazing angle may lie far off: stay within the neighbourhood of the texels.
    float texel = 2.0 * length(origin + t * direction - u_eye.xyz) * (u_layerFrustum.z - u_layerFrustum.x) / float(u_size.z);
    offset = clamp(offset / total, -texel, texel);
    return SurfaceHit(origin + (t + offset) * direction, normalize(normal), normalize(flatNormal));
}

// A wall between two columns: its normal runs from that of the surface before to that of the one behind.
bool wallBetween(vec3 inner, vec3 outer, vec3 origin, vec3 direction, bool inside, float t, out SurfaceHit hit)
{
    ivec2 texel = layerTexel(inner.xy);
    Column column = readColumn(texel, inner.z);
    if (!column.inside || column.after < 0 || readColumn(layerTexel(outer.xy), outer.z).inside) {
        return false;
    }
    uvec2 before = layerNormals(column.before, texel);
    uvec2 after = layerNormals(column.after, texel);
    float share = (inner.z - column.beforeDepth) / max(column.afterDepth - column.beforeDepth, 1.0);
    vec3 normal = mix(unpackNormal(before.x), unpackNormal(after.x), share);
    float size = length(normal);
    hit.position = origin + t * direction;
    hit.normal = size > 1e-3 ? normal / size : (inside ? direction : -direction);
    hit.flatNormal = hit.normal;
    return facesRightWay(hit.normal, direction, inside);
}

// Looks at every layer whose flag changed between two near points of the ray. Case 3 of the paper, a hit:
// the layer's depths at both points differ by less than a step. Case 2: they do not, the ray passed a fault.
bool hitBetween(LayerRay ray, float low, float high, int changed, vec3 origin, vec3 direction, bool inside,
                float jump, out SurfaceHit hit)
{
    vec3 a = layerPoint(ray, low);
    vec3 b = layerPoint(ray, high);
    ivec2 texelA = layerTexel(a.xy);
    ivec2 texelB = layerTexel(b.xy);
    for (int layer = 0; layer < u_search.x; ++layer) {
        if ((changed >> layer) % 2 == 0) {
            continue;
        }
        float depthA = float(layerDepth(layer, texelA));
        float depthB = float(layerDepth(layer, texelB));
        if (max(depthA, depthB) > VT_DEPTH_SCALE || abs(depthA - depthB) > jump) {
            continue;
        }
        uvec2 nearest = layerNormals(layer, texelB);
        if (facesRightWay(unpackNormal(nearest.y), direction, inside)) {
            hit = blendTexels(layer, origin, direction, b, high, jump, nearest);
            return true;
        }
    }
    float middle = 0.5 * (low + high);
    if (inside) {
        return wallBetween(a, b, origin, direction, true, middle, hit);
    }
    return wallBetween(b, a, origin, direction, false, middle, hit);
}

// The first surface that a ray from a surface meets. False where it meets none.
bool searchLayers(vec3 origin, vec3 direction, bool inside, out SurfaceHit hit)
{
    float end = boxExit(origin, direction);
    float stride = end / float(u_search.y);
    float jump = VT_DEPTH_SCALE / float(u_search.y);
    LayerRay ray = makeLayerRay(origin, direction);

    // Step clear of the surface that the ray starts on, then note which layers lie in front.
    float a = FIRST_STEP * stride;
    int flags = layersInFront(layerPoint(ray, a));
    for (int i = 0; i < u_search.y + SPARE_STEPS && a < end; ++i) {
        // Linear step: case 1 of the paper, no flag changes, go on.
        float b = min(a + stride, end);
        int next = layersInFront(layerPoint(ray, b));
        if (next == flags) {
            a = b;
            continue;
        }
        // Binary search for the first change.
        float high = b;
        for (int k = 0; k < u_search.z; ++k) {
            float middle = 0.5 * (a + high);
            int there = layersInFront(layerPoint(ray, middle));
            if (there == flags) {
                a = middle;
            } else {
                high = middle;
                next = there;
            }
        }
        if (hitBetween(ray, a, high, next ^ flags, origin, direction, inside, jump, hit)) {
            return true;
        }
        // Case 2: remember on which side of each layer the ray now is, and go on from there.
        flags = next;
        a = high;
    }
    return false;
}
