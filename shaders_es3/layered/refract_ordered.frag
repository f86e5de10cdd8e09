// This work is based on:
//   Shi-Hao Wang, Ming-Te Chi. Image Space Real-time Multi-refraction Technology. National Chengchi University, 2014,
//   section 3.7: objects sorted from the eye, each drawn with what has become of the paths (T2 and P2) before it.
// As in the paper, a path never comes back to an object before, objects within one another do not know of it, and the
// order holds for the whole picture. What is opaque is not between objects: only behind the last, and before the first.
// Departures: T2 and P2 come with the light on the path, and with its events, which count on; a path that the objects
// before have lost stays so; P2 and T2 are searched for in layers fitted to the object, from where they enter its box;
// objects are sorted by the distance of the middle of their boxes.
uniform usampler2D u_paths; // of the objects before, as path.glsl has them
uniform usampler2D u_ends;
uniform usampler2D u_lights;
uniform usampler2D u_asides;
uniform int u_object;

Path readPath(uvec4 path)
{
    uvec4 light = readPixel(u_lights, u_size.xy), aside = readPixel(u_asides, u_size.xy);
    vec2 middle = unpackHalf2x16(light.y);
    Path p = startPath(uintBitsToFloat(readPixel(u_ends, u_size.xy).xyz), uintBitsToFloat(path.xyz));
    p.transmittance = vec3(unpackHalf2x16(light.x), middle.x);
    p.events = int(path.w >> 8) & 127;
    p.reflected = (int(path.w) & VT_PATH_TIR) != 0;
    p.asidePosition = uintBitsToFloat(aside.xyz);
    p.asideDirection = unpackNormal(aside.w);
    p.aside = vec3(middle.y, unpackHalf2x16(light.z));
    return p;
}

void main()
{
    uvec4 before = readPixel(u_paths, u_size.xy);
    int status = int(before.w) & 255;
    Layers layers = layersOf(u_object);
    uvec4 media = uvec4(0u);
    SurfaceHit hit;
    Path p;
    bool found;
    float distance = 0.0;
    if (status == VT_PATH_BACKGROUND) {
        // Case 1: no object so far, and this one where it is seen; u_surface shows no other glass.
        if (readPixel(u_surface, u_size.xy).w == 0u) {
            discard;
        }
        vec3 view;
        hit = firstSurface(view);
        p = startPath(hit.position, view);
        media = mediaAtEye(hit, view);
        distance = length(hit.position - u_eye.xyz);
        found = true;
    } else {
        // Case 2: not found, the path stays as it is. Case 3: found, it goes on from there.
        p = readPath(before);
        found = status == VT_PATH_EXITED && searchLayers(layers, p.position, p.direction, false, false, NOWHERE, hit);
        bool last = found && p.events >= u_search.w;
        status = last ? VT_PATH_LOST : status;
        found = found && !last;
        if (found) {
            p.position = hit.position;
        }
    }
    while (found) {
        hit.object = u_object;
        crossSurface(p, media, distance, hit, -1);
        bool inside = media != uvec4(0u);
        bool last = p.events >= u_search.w;
        found = !(inside && last) && searchLayers(layers, p.position, p.direction, inside, true, NOWHERE, hit);
        status = inside || found ? VT_PATH_LOST : VT_PATH_EXITED;
        found = found && !last;
        if (found) {
            distance = length(hit.position - p.position);
            p.position = hit.position;
        }
    }
    writePath(p, status);
    // Where texture reads are counted, those of the objects before count, too.
    uint reads = min((o_path.w >> VT_PATH_READS_SHIFT) + (before.w >> VT_PATH_READS_SHIFT), uint(VT_MAX_READS));
    o_path.w = (o_path.w & ((1u << VT_PATH_READS_SHIFT) - 1u)) | (reads << VT_PATH_READS_SHIFT);
}
