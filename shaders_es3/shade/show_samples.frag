// The mean of the samples as a picture, with straight alpha.
uniform usampler2D u_sum;

layout(location = 0) out vec4 o_color;

void main()
{
    vec4 sum = uintBitsToFloat(readTexel(u_sum, ivec2(gl_FragCoord.xy) - u_host.xy, u_size.xy));
    o_color = sum.a > 0.0 ? vec4(u_host.z != 0 ? sum.rgb / sum.a : linearToSrgb(sum.rgb / sum.a), sum.a / u_optics.w) : vec4(0.0);
}
