// Adds a sample to the sum of those before: red, green and blue where it covers the pixel, and that it does.
// Every sample is cut to what the display can show before it is added. The mean over all light would be
// right for a film, but a lamp ten times as bright as white would then fill each pixel of which it covers a tenth:
// edges against lamps would stay stairs. Where linear light is wanted, or tone mapping
// makes room for what is brighter than white (u_host.z), it is not cut.
uniform usampler2D u_radiance;
uniform usampler2D u_sum; // bits of floats

layout(location = 0) out uvec4 o_sum;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 light = uintBitsToFloat(readTexel(u_radiance, pixel, u_size.xy));
    light = u_host.z != 0 ? light : min(light, 1.0);
    o_sum = floatBitsToUint(uintBitsToFloat(readTexel(u_sum, pixel, u_size.xy)) + light);
}
