// The surface that a pixel sees first, exact from rasterisation.
uniform usampler2D u_surface;

struct SurfaceHit {
    vec3 position; // world
    vec3 normal;   // outward, interpolated
    vec3 flatNormal;
};

// False where the pixel sees no glass. `direction` is the eye ray's.
bool firstSurface(out SurfaceHit hit, out vec3 direction)
{
    uvec4 surface = texelFetch(u_surface, ivec2(gl_FragCoord.xy), 0);
    float depth = uintBitsToFloat(surface.z);
    vec2 tangent = pictureTangent(gl_FragCoord.xy);
    hit.position = u_eye.xyz + vec3(tangent * depth, depth) * mat3(u_worldToCamera);
    hit.normal = unpackNormal(surface.x);
    hit.flatNormal = unpackNormal(surface.y);
    direction = cameraDirection(tangent);
    return depth > 0.0;
}
