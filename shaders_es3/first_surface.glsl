// The surface that a pixel sees first, exact from rasterisation.
uniform sampler2D u_surfaceDepth;
uniform usampler2D u_surfaceNormals;

struct SurfaceHit {
    vec3 position; // world
    vec3 normal;   // outward, interpolated
    vec3 flatNormal;
};

// False where the pixel sees no glass. `direction` is the eye ray's.
bool firstSurface(out SurfaceHit hit, out vec3 direction)
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float z = texelFetch(u_surfaceDepth, pixel, 0).r;
    vec2 tangent = pictureTangent(gl_FragCoord.xy);
    float depth = u_pictureDepth.x * u_pictureDepth.y / (u_pictureDepth.y - z / u_pictureDepth.z);
    uvec2 normals = texelFetch(u_surfaceNormals, pixel, 0).rg;
    hit.position = u_eye.xyz + vec3(tangent * depth, depth) * mat3(u_worldToCamera);
    hit.normal = unpackNormal(normals.x);
    hit.flatNormal = unpackNormal(normals.y);
    direction = cameraDirection(tangent);
    return z < 1.0;
}
