// This work is based on:
//   Manuel M. Oliveira, Maicon Brauwers. Real-Time Refraction Through Deformable Objects. I3D 2007, as
//   Wang & Chi 2014 (section 3.3) restate it.
// The refracted ray is searched in the back side's depth, linearly and then by halving, to E where it meets
// Zmax or, turned towards the eye, Zmin. Nothing is done about jumps of depth: that is what `layered` adds.
// Departures: the search starts at P1, not at S where the ray's line meets Zmin, which lies before the object; beyond
// the critical angle the exit is clamped to it, as in `wyman` (the sources at hand do not say what the paper does); a
// ray that leaves the silhouette without a hit takes the last point within.
void main()
{
    Layers layers = layersOfAll();
    vec3 view;
    SurfaceHit hit = firstSurface(view);
    Path p = startPath(hit.position, view);
    uvec4 media = uvec4(0u);
    crossSurface(p, media, 0.0, hit, -1);
    vec3 T1 = p.direction;
    LayerRay ray = makeLayerRay(layers, hit.position, T1);

    // E, where the ray reaches the far end (or, turned towards the eye, the near one) of the depth range.
    float goal = ray.direction.z >= 0.0 ? u_layerDepth.y : u_layerDepth.x;
    float diagonal = length(u_boundsMax.xyz - u_boundsMin.xyz);
    float end = abs(ray.direction.z) > 1e-6 ? (goal - ray.origin.z) / ray.direction.z : diagonal;
    float stride = min(end, diagonal) / float(u_search.y);

    // Linear, to the first point behind the back side or off it.
    float before = 0.0, behind = stride;
    for (int i = 1; i < u_search.y; ++i) {
        vec3 point = layerPoint(layers, ray, behind);
        uint stored = backDepth(point.xy);
        if (stored == VT_DEPTH_NONE || point.z > float(stored)) {
            break;
        }
        before = behind;
        behind += stride;
    }
    for (int i = 0; i < u_search.z; ++i) {
        float middle = 0.5 * (before + behind);
        vec3 point = layerPoint(layers, ray, middle);
        uint stored = backDepth(point.xy);
        if (stored == VT_DEPTH_NONE || point.z > float(stored)) {
            behind = middle;
        } else {
            before = middle;
        }
    }

    vec3 N2 = backNormal(layerPoint(layers, ray, before).xy);
    if (dot(N2, N2) == 0.0) {
        writePath(p, VT_PATH_LOST);
        return;
    }
    leaveClamped(p, dot(N2, T1) < 0.0 ? -N2 : N2, hit.object, before);
    writePath(p, VT_PATH_EXITED);
}
