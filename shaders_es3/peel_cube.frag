// One layer of a cube's side. All four channels get the same; the colour mask keeps the layer's own.
uniform sampler2D u_previousDepth;

flat in uint v_triangle;
flat in uint v_leaving;

layout(location = 0) out uvec4 o_surface;
layout(location = 1) out uvec4 o_triangle;

void main()
{
    if (gl_FragCoord.z <= texelFetch(u_previousDepth, ivec2(gl_FragCoord.xy), 0).r) {
        discard;
    }
    o_surface = uvec4(2u * uint(clamp(gl_FragCoord.z, 0.0, 1.0) * VT_CUBE_DEPTH + 0.5) + v_leaving);
    o_triangle = uvec4(v_triangle);
}
