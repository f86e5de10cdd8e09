// Kay & Greenberg 1979, equation 1: final = old t + new (1 - t), back to front, t the same everywhere.
// Gathered front to back, which gives the same sum: what the layers before let through weighs each layer.
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
        added += through * (1.0 - u_optics.y) * opaqueShade(normal);
        through *= u_optics.y;
        ++events;
    }
    writeBlended(view, events, through, added);
}
