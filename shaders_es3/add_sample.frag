// Adds a sample to the sum of those before: red, green and blue where it covers the pixel, and that it does.
// Every sample is cut to what the display can show before it is added. The mean over all light would be
// right for a film, but a lamp ten times as bright as white would then fill each pixel of which it covers a tenth:
// edges against lamps would stay stairs.
uniform usampler2D u_radiance;
uniform usampler2D u_sum; // bits of floats

layout(location = 0) out uvec4 o_sum;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    uvec2 bits = texelFetch(u_radiance, pixel, 0).rg;
    vec4 light = min(vec4(unpackHalf2x16(bits.x), unpackHalf2x16(bits.y)), 1.0);
    o_sum = floatBitsToUint(uintBitsToFloat(texelFetch(u_sum, pixel, 0)) + light);
}
