// Kay & Greenberg 1979, section 4: every surface is a wall of constant thickness. Outside glass rays run
// parallel to z; within a wall they are refracted, and leave it shifted in x and y. t = T^d (equation 6).
// The paper maps the image made so far onto the next surface, back to front; read front to back, each
// surface shifts the place at which those behind it, and in the end the background, are seen.
uniform usampler2DArray u_layerDepths;

void main()
{
    vec2 place = gl_FragCoord.xy;
    float transmittance = 1.0;
    vec3 normal;
    int events = 0;
    for (int layer = 0; layer < u_search.x; ++layer) {
        vec3 view = cameraDirection(pictureTangent(place));
        if (!layerNormal(ivec2(floor(place)), layer, view, normal)) {
            break;
        }
        // In camera coordinates (right, up, depth) the ray comes along +z.
        vec3 N = mat3(u_worldToCamera) * normal;
        N = N.z > 0.0 ? -N : N;
        vec2 shift;
        float path = wallPath(N, u_optics.x, u_kay.w, shift);
        transmittance *= pow(u_optics.y, path);

        // The shift is a length at the surface's depth: as many pixels.
        float stored = float(readLayer(u_layerDepths, floor(place), layer, u_size.zw).r);
        float depth = u_layerDepth.x + stored / (VT_DEPTH_SCALE * u_layerDepth.z);
        place += shift / depth * vec2(u_size.xy) / (u_pictureFrustum.zw - u_pictureFrustum.xy);
        ++events;
    }
    writeBlended(cameraDirection(pictureTangent(place)), events, transmittance, vec3(0.0));
}
