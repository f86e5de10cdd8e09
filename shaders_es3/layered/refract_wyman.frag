// This work is based on:
//   Chris Wyman. An Approximate Image-Space Approach for Interactive Refraction. ACM Transactions on
//   Graphics 24(3), 2005.
// The distance to the second interface is guessed from two known ones: through the object along the view,
// and from the vertex inwards along its normal (computed once a mesh). Departures: the back side lies in a
// frustum fitted to the object; its normal is read bilinearly.
uniform usampler2D u_innerDistances;

float backViewDistance(vec2 position, vec3 viewDirection)
{
    uint stored = backDepth(position);
    float depth = u_layerDepth.x + float(stored) / (VT_DEPTH_SCALE * u_layerDepth.z);
    vec3 forward = vec3(0.0, 0.0, 1.0) * mat3(u_worldToCamera);
    return stored == VT_DEPTH_NONE ? 0.0 : depth / dot(viewDirection, forward);
}

void main()
{
    Layers layers = layersOfAll();
    vec3 view;
    SurfaceHit hit = firstSurface(view);
    Path p = startPath(hit.position, view);
    uvec4 media = uvec4(0u);
    crossSurface(p, media, 0.0, hit, -1);
    vec3 T1 = p.direction;

    // d = (theta_t / theta_i) dV + (1 - theta_t / theta_i) dN
    vec2 here = layerPoint(layers, makeLayerRay(layers, hit.position, T1), 0.0).xy;
    float viewDistance = max(backViewDistance(here, view) - length(hit.position - u_eye.xyz), 0.0);
    float normalDistance = float(readPixel(u_innerDistances, u_size.xy).r) / VT_DEPTH_SCALE *
                           length(u_boundsMax.xyz - u_boundsMin.xyz);
    float incoming = acos(clamp(-dot(view, hit.normal), 0.0, 1.0));
    float refracted = acos(clamp(-dot(T1, hit.normal), 0.0, 1.0));
    float ratio = incoming > 1e-4 ? refracted / incoming : 1.0 / glassOf(uint(hit.object + 1)).x;
    float distance = mix(normalDistance, viewDistance, ratio);
    vec3 P2 = hit.position + distance * T1;

    // Where P2 misses the silhouette: the normal that faces the side, across the look-at direction L.
    vec2 there = layerPoint(layers, makeLayerRay(layers, P2, T1), 0.0).xy;
    vec3 N2 = backDepth(there) != VT_DEPTH_NONE ? backNormal(there) : vec3(0.0);
    if (dot(N2, N2) == 0.0) {
        vec3 L = vec3(0.0, 0.0, 1.0) * mat3(u_worldToCamera);
        N2 = T1 - dot(L, T1) * L;
        N2 = dot(N2, N2) > 0.0 ? normalize(N2) : T1;
    }
    leaveClamped(p, dot(N2, T1) < 0.0 ? -N2 : N2, hit.object, distance);
    writePath(p, VT_PATH_EXITED);
}
