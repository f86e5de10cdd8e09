// Shared by the techniques of Douglas Scott Kay, Donald Greenberg. Transparency for Computer Synthesized
// Images. SIGGRAPH 1979. Layers lie pixel on pixel with the picture here.
uniform usampler2DArray u_layerNormals;

const vec3 LIGHT = vec3(-0.48, 0.72, 0.50); // unit; above, to the left and behind the viewer
const vec3 BASE_COLOR = vec3(0.55, 0.70, 0.75);

// The layer's normal at a pixel turned to the eye, in world coordinates; false where it has no surface.
bool layerNormal(ivec2 pixel, int layer, vec3 view, out vec3 normal)
{
    uint bits = VT_NO_NORMAL;
    if (all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, u_size.zw))) {
        bits = readLayer(u_layerNormals, pixel, layer, u_size.zw).r;
    }
    normal = unpackNormal(bits);
    normal = dot(normal, view) > 0.0 ? -normal : normal;
    return bits != VT_NO_NORMAL;
}

// NEW of equation 1: the surface as if it were opaque, from the angle between normal and light.
vec3 opaqueShade(vec3 normal)
{
    return BASE_COLOR * (0.2 + 0.8 * max(dot(normal, LIGHT), 0.0));
}

// Phong's highlight, which the paper adds after the transparency has been decided.
vec3 specular(vec3 normal, vec3 view)
{
    return vec3(0.8 * pow(max(dot(reflect(view, normal), LIGHT), 0.0), 60.0));
}
