// One layer of depth peeling: what lies behind the layer before, the depth test keeps the nearest of it.
// FARTHEST: no layer before, the depth test keeps the farthest.
#ifndef FARTHEST
uniform sampler2D u_previousDepth;
#endif

layout(location = 0) out uvec2 o_normals;
layout(location = 1) out uint o_depth;

void main()
{
#ifndef FARTHEST
    if (gl_FragCoord.z <= readPixel(u_previousDepth, u_size.zw).r) {
        discard;
    }
#endif
    o_normals = surfaceNormals();
    vec4 range = DEPTH_RANGE;
    float depth = (v_camera.z - range.x) * range.z;
    o_depth = uint(clamp(depth, 0.0, 1.0) * VT_DEPTH_SCALE + 0.5);
}
