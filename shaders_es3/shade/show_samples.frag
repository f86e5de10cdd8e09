// The mean of the samples as a picture, with straight alpha.
uniform usampler2D u_sum;

void main()
{
    vec4 sum = max(uintBitsToFloat(readTexel(u_sum, ivec2(gl_FragCoord.xy) - u_host.xy, u_size.xy)), 0.0);
    o_color = SHOWN(displayed(sum.rgb / (sum.a > 0.0 ? sum.a : 1.0), sum.a / (u_optics.w + float(u_sample.w))));
}
