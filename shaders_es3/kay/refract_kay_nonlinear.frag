// Kay & Greenberg 1979, equation 2: t = (max - min) (1 - (1 - |Nz|)^p) + min; highlights are added after.
// Nz is the normal's part along the view ray, which the paper's perspective space makes the z axis.
void main()
{
    vec3 view = cameraDirection(pictureTangent(gl_FragCoord.xy));
    float through = 1.0;
    vec3 added = vec3(0.0), normal;
    int events = 0;
    for (int layer = 0; layer < u_search.x; ++layer) {
        if (!layerNormal(ivec2(gl_FragCoord.xy), layer, view, normal)) {
            break;
        }
        float t = nonlinearTransmittance(abs(dot(normal, view)), u_kay.x, u_kay.y, u_kay.z);
        added += through * ((1.0 - t) * opaqueShade(normal) + specular(normal, view));
        through *= t;
        ++events;
    }
    writeBlended(view, events, through, added);
}
