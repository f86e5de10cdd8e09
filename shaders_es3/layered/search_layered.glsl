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
const int MOST_FAULTS = 16;   // passed on the way of one segment

// The hit near parameter t on a continuous piece of a layer, from the tangent planes of 2 x 2 texels.
SurfaceHit blendTexels(Layers layers, int layer, vec3 origin, vec3 direction, vec3 point, float t, float jump, uvec2 nearest)
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
        float stored = layerDepth(layers, layer, texel);
        uvec2 bits = layerNormals(layers, layer, texel);
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
        float hit = dot(layerWorldPoint(layers, texel, stored) - (origin + t * direction), g) / slope;
        offset += weight * hit;
        normal += weight * n;
        flatNormal += weight * g;
        total += weight;
    }
    if (total == 0.0) {
        return SurfaceHit(origin + t * direction, nearestNormal, nearestFlat, 0);
    }
    // A plane met at a grazing angle may lie far off: stay within the neighbourhood of the texels.
    float texel = 2.0 * length(origin + t * direction - u_eye.xyz) * (layers.frustum.z - layers.frustum.x) / float(u_size.z);
    offset = clamp(offset / total, -texel, texel);
    return SurfaceHit(origin + (t + offset) * direction, normalize(normal), normalize(flatNormal), 0);
}

// The nearest of some layers, a bit each, which is a surface at a texel that the ray goes through the right way; -1: none.
int surfaceAmong(Layers layers, int candidates, ivec2 texel, vec3 direction, bool inside, out uvec2 normals)
{
    int found = -1;
    normals = uvec2(0u);
    do {
        int layer = lowestBit(candidates);
        uvec2 there = layerNormals(layers, layer, texel);
        bool isHit = candidates != 0 && found < 0 && facesRightWay(unpackNormal(there.y), direction, inside);
        found = isHit ? layer : found;
        normals = isHit ? there : normals;
        candidates &= candidates - 1;
    } while (found < 0 && candidates != 0);
    return found;
}

// The first surface of the layers that a ray meets before it has gone `farthest`. `start`: whether it starts on one of
// them; else it is searched from where it enters their box. False where it meets none. The linear steps are a loop of
// their own, with nothing else in it: software renderers, and GPUs whose pixels part ways, pay for every branch inside
// a loop at every step.
bool searchLayers(Layers layers, vec3 origin, vec3 direction, bool inside, bool start, float farthest, out SurfaceHit hit)
{
    vec2 span = boxSpan(layers, origin, direction);
    span.x = start ? 0.0 : span.x;
    if (span.x > min(span.y, farthest)) {
        return false;
    }
    origin += span.x * direction;
    float end = span.y - span.x;
    float stride = end / float(u_search.y);
    float jump = VT_DEPTH_SCALE / float(u_search.y);
    LayerRay ray = makeLayerRay(layers, origin, direction);
    end = min(end, farthest - span.x);

    // Step clear of the surface that the ray starts on, then note which layers lie in front.
    float a = min(start ? FIRST_STEP * stride : 0.0, end);
    int flags = layersInFront(layers, layerPoint(layers, ray, a));
    int steps = u_search.y, layer = -1;
    bool isWall = false;
    uvec2 normals = uvec2(0u);
    vec3 wall = direction;
    float b = a;
    for (int fault = 0; fault <= MOST_FAULTS; ++fault) {
        // Linear steps. Case 1 of the paper: no flag changes, go on.
        b = a;
        int next = flags;
        do {
            a = b;
            b = min(a + stride, end);
            next = layersInFront(layers, layerPoint(layers, ray, b));
            --steps;
        } while (next == flags && b < end && steps > 0);
        if (next == flags) {
            break;
        }
        // Halving, to the first change.
        for (int k = 0; k < u_search.z; ++k) {
            float middle = 0.5 * (a + b);
            int there = layersInFront(layers, layerPoint(layers, ray, middle));
            bool same = there == flags;
            a = same ? middle : a;
            b = same ? b : middle;
            next = same ? next : there;
        }
        // Case 3 of the paper, a hit: a layer whose flag changed is as deep on both sides.
        vec3 pointA = layerPoint(layers, ray, a), pointB = layerPoint(layers, ray, b);
        Column columnA, columnB;
        int continuous;
        readColumns(layers, pointA, pointB, jump, columnA, columnB, continuous);
        layer = surfaceAmong(layers, (next ^ flags) & continuous, layerTexel(pointB.xy), direction, inside, normals);
        if (!inside) {
            Column column = columnA;
            columnA = columnB;
            columnB = column;
        }
        isWall = wallBetween(layers, inside ? pointA : pointB, columnA, columnB, direction, inside, wall);
        if (layer >= 0 || isWall) {
            break;
        }
        // Case 2: remember on which side of each layer the ray now is, and go on from there.
        flags = next;
        a = b;
        ++steps; // the rest of the step is still to be gone
    }
    hit = SurfaceHit(origin + 0.5 * (a + b) * direction, wall, wall, 0);
    SurfaceHit surface = blendTexels(layers, max(layer, 0), origin, direction, layerPoint(layers, ray, b), b, jump, normals);
    if (layer >= 0) { // WebGL's ?: takes no structures
        hit = surface;
    }
    return layer >= 0 || isWall;
}
