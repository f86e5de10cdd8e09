// The surface that a pixel sees first, exact from rasterisation.
uniform usampler2D u_surface;

// `direction` is the eye ray's. Only pixels that see glass or something opaque are drawn (src/passes/refract.c).
SurfaceHit firstSurface(out vec3 direction)
{
    uvec4 surface = readPixel(u_surface, u_size.xy);
    if (int(surface.w) > u_scene.x) {
        discard; // something opaque: passes/shade.c
    }
    float depth = uintBitsToFloat(surface.z);
    vec2 tangent = pictureTangent(gl_FragCoord.xy);
    direction = cameraDirection(tangent);
    return SurfaceHit(pointAtDepth(tangent, depth), unpackNormal(surface.x),
                      unpackNormal(surface.y), int(surface.w) - 1);
}

// What the eye is within, as far as the first surface tells: seen from behind, it is that surface's object.
Media mediaAtEye(SurfaceHit hit, vec3 direction)
{
    bool isWithin = dot(hit.flatNormal, direction) > 0.0;
    return isWithin ? toggle(AIR, uint(hit.object + 1)) : AIR;
}
