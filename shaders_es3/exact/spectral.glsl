// Glass that disperses: a sample is followed at three wavelengths. This work is based on:
//   The Khronos Group. KHR_materials_dispersion. 2024: the index at a wavelength, by Cauchy's formula;
//   Chris Wyman, Peter-Pike Sloan, Peter Shirley. Simple Analytic Approximations to the CIE XYZ Color Matching Functions.
//   JCGT 2013: what the wavelengths weigh.
// Departures:
// - The first sample follows red, green and blue at the mean index of what each of them sees, so that it has no noise.
//   With fewer wavelengths (u_wavelengths) green and blue go together, or all three. A path carries what a step of the
//   index does to it (Igehy 1999, as footprint.glsl) then, and where it ends the environment is read along that: at
//   eight wavelengths of the whole spectrum (WITH_FAN).
// - The others follow wavelengths a third of the spectrum apart, shifted by another number in every pixel and sample.
// Needs chance and objects.
#define WITH_SPECTRAL

// Wavelengths that weigh alike: the light of one as linear sRGB; 523655 / nanometres^2 - 1.5168. The mean is white.
const vec4 SPECTRUM[32] = vec4[32](    vec4(0.4643, -0.4851, 3.7101, 1.4955),    vec4(0.3637, -0.4771, 3.9097, 1.3141),
    vec4(0.3998, -0.4771, 3.8643, 1.2225),    vec4(0.3892, -0.4579, 3.8991, 1.1448),
    vec4(0.2830, -0.4052, 4.0955, 1.0697),    vec4(0.0951, -0.3077, 4.4399, 0.9921),
    vec4(-0.1963, -0.0929, 4.5229, 0.9071),    vec4(-0.5541, 0.3365, 3.8015, 0.8120),
    vec4(-1.0764, 1.0666, 2.3522, 0.7076),    vec4(-1.5015, 1.7813, 1.0441, 0.6082),
    vec4(-1.6331, 2.2696, 0.3578, 0.5268),    vec4(-1.6131, 2.5843, 0.0263, 0.4617),
    vec4(-1.4717, 2.6831, -0.1350, 0.4086),    vec4(-1.3271, 2.7865, -0.2216, 0.3630),
    vec4(-1.1529, 2.9445, -0.2850, 0.3201),    vec4(-0.9048, 3.2001, -0.3493, 0.2767),
    vec4(-0.4606, 3.6756, -0.4397, 0.2297),    vec4(0.4299, 3.6679, -0.4770, 0.1763),
    vec4(1.2353, 2.7445, -0.3870, 0.1289),    vec4(1.8086, 2.0852, -0.3195, 0.0892),
    vec4(2.2470, 1.5793, -0.2664, 0.0543),    vec4(2.6018, 1.1728, -0.2233, 0.0227),
    vec4(2.8957, 0.8345, -0.1871, -0.0067),    vec4(3.1471, 0.5464, -0.1562, -0.0347),
    vec4(3.3658, 0.2958, -0.1293, -0.0618),    vec4(3.5503, 0.0826, -0.1064, -0.0886),
    vec4(3.5644, -0.0870, -0.0845, -0.1155),    vec4(3.4834, -0.2082, -0.0665, -0.1424),
    vec4(3.4257, -0.2955, -0.0535, -0.1704),    vec4(3.3837, -0.3577, -0.0442, -0.2017),
    vec4(3.3535, -0.3922, -0.0388, -0.2408),    vec4(3.4041, -0.2937, -0.0531, -0.3134));

// The same of eight parts of the spectrum, of which each weighs an eighth of it.
const vec4 FAN[8] = vec4[8](
    vec4(0.0505, -0.0593, 0.4807, 1.2942), vec4(-0.0116, -0.0147, 0.5269, 0.9452),
    vec4(-0.1820, 0.2407, 0.1181, 0.5761), vec4(-0.1518, 0.3629, -0.0310, 0.3421),
    vec4(0.0942, 0.3804, -0.0507, 0.1560), vec4(0.3404, 0.1292, -0.0260, 0.0089),
    vec4(0.4364, 0.0026, -0.0121, -0.1021), vec4(0.4240, -0.0418, -0.0059, -0.2316));

uniform int u_wavelengths; // of the first sample, 1 to 3

float g_spread;             // of the wavelength that is followed
bool g_isDispersed = false; // the pixel's paths have met glass that disperses: until then all wavelengths go one way

vec4 spectrumAt(float at)
{
    float place = clamp(32.0 * at - 0.5, 0.0, 31.0);
    int low = int(place);
    return mix(SPECTRUM[low], SPECTRUM[min(low + 1, 31)], place - float(low));
}

// Paths that the sample has.
int wavelengthCount()
{
    return u_sample.y == 0 ? u_wavelengths : 3;
}

// The `part` of the sample: sets g_spread; the colour of its light.
vec3 startWavelength(int part)
{
    vec3 mask = vec3(equal(ivec3(part), min(ivec3(0, 2, 1), u_wavelengths - 1)));
    float shift = mixedNumbers(uvec3(gl_FragCoord.xy, 0x20000)).x + 0.61803399 * float(u_sample.x % 4096);
    vec4 spectrum = spectrumAt(fract(shift + float(part) / 3.0));
    bool isFirst = u_sample.y == 0;
    g_spread = isFirst ? dot(mask, vec3(-0.228, 0.237, 1.182)) / dot(mask, vec3(1.0)) : spectrum.a;
    return isFirst ? mask : spectrum.rgb / 3.0;
}

// Of an object whose index at 587.6 nm that is. isMet: the path goes through it.
float dispersedIndex(int object, float ior, bool isMet)
{
    float dispersion = uintBitsToFloat(objectBits(object, VT_OBJECT_IMAGES).w);
    g_isDispersed = g_isDispersed || (isMet && dispersion > 0.0);
    return mix(ior, max(ior + (ior - 1.0) * dispersion * 0.05 * g_spread, 1.0), step(1e-9, dispersion));
}

// What a step of the spread does to an object's index.
float indexChange(int object, float ior)
{
    return (ior - 1.0) * 0.05 * uintBitsToFloat(objectBits(object, VT_OBJECT_IMAGES).w);
}
