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
const int MOST_FAULTS = 16;   // passed on the way of one segment

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
        return SurfaceHit(origin + t * direction, nearestNormal, nearestFlat, 0);
    }
    // A plane met at a grazing angle may lie far off: stay within the neighbourhood of the texels.
    float texel = 2.0 * length(origin + t * direction - u_eye.xyz) * (u_layerFrustum.z - u_layerFrustum.x) / float(u_size.z);
    offset = clamp(offset / total, -texel, texel);
    return SurfaceHit(origin + (t + offset) * direction, normalize(normal), normalize(flatNormal), 0);
}

// A wall between two columns: its normal runs from that of the surface before to that of the one behind.
bool wallBetween(vec3 inner, vec3 outer, vec3 direction, bool inside, vec3 position, out SurfaceHit hit)
{
    ivec2 texel = layerTexel(inner.xy);
    Column column = readColumn(texel, inner.z);
    bool isWall = column.inside && column.after >= 0 && !readColumn(layerTexel(outer.xy), outer.z).inside;
    uvec2 before = layerNormals(max(column.before, 0), texel);
    uvec2 after = layerNormals(max(column.after, 0), texel);
    float share = (inner.z - column.beforeDepth) / max(column.afterDepth - column.beforeDepth, 1.0);
    vec3 normal = mix(unpackNormal(before.x), unpackNormal(after.x), share);
    float size = length(normal);
    hit.position = position;
    hit.normal = size > 1e-3 ? normal / size : (inside ? direction : -direction);
    hit.flatNormal = hit.normal;
    hit.object = 0;
    return isWall && facesRightWay(hit.normal, direction, inside);
}

// The nearest layer whose flag changed between two near points of the ray and which is a surface there. Case
// 3 of the paper, a hit: its depths at both points differ by less than a step. Case 2: they do not, the ray
// passed a fault. -1: none.
int surfaceBetween(ivec2 texelA, ivec2 texelB, int changed, vec3 direction, bool inside, float jump)
{
    int found = -1;
    for (int layer = 0; layer < u_search.x; ++layer) {
        float depthA = float(layerDepth(layer, texelA));
        float depthB = float(layerDepth(layer, texelB));
        bool continuous = max(depthA, depthB) <= VT_DEPTH_SCALE && abs(depthA - depthB) <= jump;
        bool faces = facesRightWay(unpackNormal(layerNormals(layer, texelB).y), direction, inside);
        bool here = (changed >> layer) % 2 != 0 && continuous && faces;
        found = here && found < 0 ? layer : found;
    }
    return found;
}

// The first surface that a ray from a surface meets. False where it meets none. The linear steps are a loop
// of their own, with nothing else in it: software renderers, and GPUs whose pixels part ways, pay for every
// branch inside a loop at every step.
bool searchLayers(vec3 origin, vec3 direction, bool inside, out SurfaceHit hit)
{
    float end = boxExit(origin, direction);
    float stride = end / float(u_search.y);
    float jump = VT_DEPTH_SCALE / float(u_search.y);
    LayerRay ray = makeLayerRay(origin, direction);

    // Step clear of the surface that the ray starts on, then note which layers lie in front.
    float a = FIRST_STEP * stride;
    int flags = layersInFront(layerPoint(ray, a));
    int steps = u_search.y;
    for (int fault = 0; fault <= MOST_FAULTS; ++fault) {
        // Linear steps. Case 1 of the paper: no flag changes, go on.
        float b = a;
        int next = flags;
        while (next == flags && b < end && steps > 0) {
            a = b;
            b = min(a + stride, end);
            next = layersInFront(layerPoint(ray, b));
            --steps;
        }
        if (next == flags) {
            break;
        }
        // Halving, to the first change.
        for (int k = 0; k < u_search.z; ++k) {
            float middle = 0.5 * (a + b);
            int there = layersInFront(layerPoint(ray, middle));
            bool same = there == flags;
            a = same ? middle : a;
            b = same ? b : middle;
            next = same ? next : there;
        }
        vec3 pointA = layerPoint(ray, a), pointB = layerPoint(ray, b);
        ivec2 texelA = layerTexel(pointA.xy), texelB = layerTexel(pointB.xy);
        int layer = surfaceBetween(texelA, texelB, next ^ flags, direction, inside, jump);
        SurfaceHit surface = blendTexels(max(layer, 0), origin, direction, pointB, b, jump,
                                         layerNormals(max(layer, 0), texelB));
        SurfaceHit wall;
        bool isWall = wallBetween(inside ? pointA : pointB, inside ? pointB : pointA, direction, inside,
                                  origin + 0.5 * (a + b) * direction, wall);
        if (layer >= 0 || isWall) {
            hit = wall;
            if (layer >= 0) { // WebGL's ?: takes no structures
                hit = surface;
            }
            return true;
        }
        // Case 2: remember on which side of each layer the ray now is, and go on from there.
        flags = next;
        a = b;
        ++steps; // the rest of the step is still to be gone
    }
    return false;
}
