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
    vec3 view;
    SurfaceHit hit = firstSurface(view);
    bool inside = false, reflected;
    vec3 T1 = meetSurface(view, hit.normal, hit.flatNormal, u_optics.x, inside, reflected);

    // d = (theta_t / theta_i) dV + (1 - theta_t / theta_i) dN
    vec2 here = layerPoint(makeLayerRay(hit.position, T1), 0.0).xy;
    float viewDistance = max(backViewDistance(here, view) - length(hit.position - u_eye.xyz), 0.0);
    float normalDistance = float(texelFetch(u_innerDistances, ivec2(gl_FragCoord.xy), 0).r) / VT_DEPTH_SCALE *
                           length(u_boundsMax.xyz - u_boundsMin.xyz);
    float incoming = acos(clamp(-dot(view, hit.normal), 0.0, 1.0));
    float refracted = acos(clamp(-dot(T1, hit.normal), 0.0, 1.0));
    float ratio = incoming > 1e-4 ? refracted / incoming : 1.0 / u_optics.x;
    vec3 P2 = hit.position + mix(normalDistance, viewDistance, ratio) * T1;

    // Where P2 misses the silhouette: the normal that faces the side, across the look-at direction L.
    vec2 there = layerPoint(makeLayerRay(P2, T1), 0.0).xy;
    vec3 N2 = backDepth(there) != VT_DEPTH_NONE ? backNormal(there) : vec3(0.0);
    if (dot(N2, N2) == 0.0) {
        vec3 L = vec3(0.0, 0.0, 1.0) * mat3(u_worldToCamera);
        N2 = T1 - dot(L, T1) * L;
        N2 = dot(N2, N2) > 0.0 ? normalize(N2) : T1;
    }
    bool clamped;
    vec3 T2 = leaveClamped(T1, dot(N2, T1) < 0.0 ? -N2 : N2, clamped);
    writePath(T2, VT_PATH_EXITED, 2, clamped);
}
