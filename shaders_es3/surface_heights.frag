// The surface of relief glass that each pixel sees first, searched from the eye within the relief's box.
uniform int u_object;
uniform int u_mirrored;

layout(location = 0) out uvec4 o_surface; // as surface.frag's

void main()
{
    if (gl_FrontFacing != (u_mirrored != 0)) {
        discard; // the box's far side shows wherever the eye is
    }
    vec2 tangent = pictureTangent(gl_FragCoord.xy);
    vec3 direction = cameraDirection(tangent);
    Meeting meeting;
    searchHeights(u_eye.xyz, direction, u_object, heightsContain(u_object, u_eye.xyz), NOWHERE, meeting);
    if (meeting.triangle == VT_NO_TRIANGLE) {
        discard;
    }
    SurfaceHit hit = heightsSurfaceAt(u_object, meeting.triangle, u_eye.xyz + meeting.distance * direction);
    float depth = meeting.distance * inversesqrt(dot(tangent, tangent) + 1.0);
    vec3 d = u_pictureDepth.xyz;
    float z = ((d.x + d.y) * depth - 2.0 * d.x * d.y) * d.z / depth;
    gl_FragDepth = clamp(0.5 + 0.5 * z, 0.0, 0.999999);
    o_surface = uvec4(packNormal(hit.normal), packNormal(hit.flatNormal), floatBitsToUint(depth), uint(u_object + 1));
}
