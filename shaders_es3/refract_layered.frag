// Follows the path of each pixel that sees glass, event by event, until it has left the object for good.
uniform sampler2D u_surfaceDepth;
uniform usampler2D u_surfaceNormals;

layout(location = 0) out uvec4 o_path; // direction (bits of three floats), state

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float z = texelFetch(u_surfaceDepth, pixel, 0).r;
    if (z >= 1.0) {
        o_path = uvec4(0u, 0u, 0u, VT_PATH_BACKGROUND);
        return;
    }

    // The first surface, exact from rasterisation.
    vec2 tangent = pictureTangent(gl_FragCoord.xy);
    float depth = u_pictureDepth.x * u_pictureDepth.y / (u_pictureDepth.y - z / u_pictureDepth.z);
    uvec2 normals = texelFetch(u_surfaceNormals, pixel, 0).rg;
    SurfaceHit hit;
    hit.position = u_eye.xyz + vec3(tangent * depth, depth) * mat3(u_worldToCamera);
    hit.normal = unpackNormal(normals.x);
    hit.flatNormal = unpackNormal(normals.y);
    vec3 direction = cameraDirection(tangent);
    bool inside = dot(hit.flatNormal, direction) > 0.0; // an eye within the glass sees its back faces

    int events = 0;
    int state = VT_PATH_EXITED;
    while (true) {
        bool reflected;
        direction = meetSurface(direction, hit.normal, hit.flatNormal, u_optics.x, inside, reflected);
        state |= reflected ? VT_PATH_TIR : 0;
        ++events;
        bool last = events >= u_search.w;
        if (inside && last) {
            state += VT_PATH_LOST - VT_PATH_EXITED;
            break;
        }
        if (!searchLayers(hit.position, direction, inside, hit)) {
            state += inside ? VT_PATH_LOST - VT_PATH_EXITED : 0;
            break;
        }
        if (last) {
            state += VT_PATH_LOST - VT_PATH_EXITED;
            break;
        }
    }
    o_path = uvec4(floatBitsToUint(direction), uint(state + 256 * events));
}
