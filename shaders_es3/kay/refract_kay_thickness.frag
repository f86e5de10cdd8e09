// Kay & Greenberg 1979, section 4: every surface is a wall of constant thickness. Outside walls rays run
// parallel to z; within one they are refracted, and leave it shifted in x and y. Equation 1 stands, with old
// taken at the shifted place and t = T^d (equation 6), d the way through the wall in wall thicknesses.
// Departures: the paper maps the image made so far onto the next surface, back to front. Read front to back,
// what follows at the shifted place is the first layer that lies behind the surface just passed, which gives
// the same sum. The paper leaves the unit of thickness open; here it is the wall's, so that T is what a wall
// lets through that is seen straight on.
uniform usampler2DArray u_layerDepths;

float storedDepth(vec2 place, int layer)
{
    return float(readLayer(u_layerDepths, floor(place), layer, u_size.zw).r);
}

void main()
{
    vec2 place = gl_FragCoord.xy;
    float through = 1.0;
    vec3 added = vec3(0.0), normal;
    int layer = 0, events = 0;
    do {
        vec3 view = cameraDirection(pictureTangent(place));
        if (!layerNormal(ivec2(floor(place)), layer, view, normal)) {
            break;
        }
        // In camera coordinates (right, up, depth) the ray comes along +z.
        vec3 N = mat3(u_worldToCamera) * normal;
        vec2 shift;
        float t = pow(u_optics.y, wallPath(N.z > 0.0 ? -N : N, u_optics.x, shift));
        added += through * ((1.0 - t) * opaqueShade(normal) + specular(normal, view));
        through *= t;

        // The shift is a length at the surface's depth: as many pixels.
        float passed = storedDepth(place, layer);
        float depth = u_layerDepth.x + passed / (VT_DEPTH_SCALE * u_layerDepth.z);
        place += u_kay.w * shift / depth * vec2(u_size.xy) / (u_pictureFrustum.zw - u_pictureFrustum.xy);
        layer = 0;
        for (int i = 0; i < u_search.x; ++i) {
            layer += storedDepth(place, i) <= passed ? 1 : 0;
        }
        ++events;
    } while (events < u_search.x && layer < u_search.x);
    writeBlended(cameraDirection(pictureTangent(place)), events, through, added);
}
