// Adds a sample to the sum of those before: red, green and blue where it covers the pixel, and that it does.
// No sample is cut to what the display can show: what chance finds seldom is bright, and the mean would lack it.
uniform usampler2D u_radiance;
uniform usampler2D u_sum; // bits of floats

layout(location = 0) out uvec4 o_sum;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 light = uintBitsToFloat(readTexel(u_radiance, pixel, u_size.xy));
    o_sum = floatBitsToUint(uintBitsToFloat(readTexel(u_sum, pixel, u_size.xy)) + float(u_sample.z) * light);
}
