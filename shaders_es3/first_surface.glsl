// The surface that a pixel sees first, exact from rasterisation.
uniform usampler2D u_surface;

struct SurfaceHit {
    vec3 position; // world
    vec3 normal;   // outward, interpolated
    vec3 flatNormal;
};

// `direction` is the eye ray's. Only pixels that see glass are drawn (src/passes/refract.c).
SurfaceHit firstSurface(out vec3 direction)
{
    uvec4 surface = texelFetch(u_surface, ivec2(gl_FragCoord.xy), 0);
    float depth = uintBitsToFloat(surface.z);
    vec2 tangent = pictureTangent(gl_FragCoord.xy);
    direction = cameraDirection(tangent);
    return SurfaceHit(u_eye.xyz + vec3(tangent * depth, depth) * mat3(u_worldToCamera), unpackNormal(surface.x),
                      unpackNormal(surface.y));
}
