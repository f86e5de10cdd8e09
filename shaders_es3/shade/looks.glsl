// What a point of a surface is like, where materials have more to them than plain numbers (vtMaterial_IsPlain): its
// pictures, its corners' colours, coverage, films, and lights. The twin of src/light/look.c, which names the sources.
// Wants octahedral, environment, objects, records, search_scene, lighting and shading before it.
uniform usampler2D u_materials; // constants.h

// What there is at a point.
struct Look {
    vec3 N, G;      // normals, outward, world: interpolated and bent by the normal map; the triangle's
    vec4 base;      // colour, coverage
    vec3 emissive;
    float ior;
    vec3 specularColor; // times what a dielectric reflects straight on
    float specular;     // share of what it reflects
    float passes;   // share that passes as through glass
    float metallic, roughness, occlusion;
    vec3 film;      // iridescence: share, index, thickness in nanometres
    uint flags;     // VT_LOOK_...
};

uvec4 materialTexel(uint at)
{
    vec2 size = vec2(textureSize(u_materials, 0));
    vec2 place = vec2(float(at % uint(VT_MATERIAL_COLUMNS)), float(at / uint(VT_MATERIAL_COLUMNS)));
    return textureLod(u_materials, (place + 0.5) / size, 0.0);
}

// Texture coordinates of both sets, colour and tangent where a triangle is met.
struct Corner {
    vec4 at;
    vec4 color;
    vec4 tangent;   // object's own; w: 1, or -1 where pictures are mirrored on it
    vec2 area;      // of the triangle in either set
};

vec4 cornerRgba(uvec4 texel)
{
    return vec4(unpackHalf2x16(texel.z), unpackHalf2x16(texel.w));
}

float coordinateArea(uvec4 a, uvec4 b, uvec4 c)
{
    vec2 A = uintBitsToFloat(a.xy), e = uintBitsToFloat(b.xy) - A, f = uintBitsToFloat(c.xy) - A;
    return 0.5 * abs(e.x * f.y - e.y * f.x);
}

Corner cornerAt(int object, uint triangle, vec3 w)
{
    Corner corner = Corner(vec4(0.0), vec4(1.0), vec4(1.0, 0.0, 0.0, 1.0), vec2(0.0));
    uint first = objectBits(object, VT_OBJECT_COLOR).w, more = objectBits(object, VT_OBJECT_IMAGES).z;
    uint record = (triangle >> 1u) - objectBits(object, VT_OBJECT_GRID_LOW).w, second = triangle & 1u;
    vec2 texel = 1.0 / vec2(textureSize(u_attributes, 0));
    vec2 b = vec2(float(1u + second) * texel.x, 0.0), c = vec2(float(2u + second) * texel.x, 0.0);
    if (first != VT_NO_TRIANGLE) {
        vec2 place = recordPlace(first + record, texel);
        uvec4 x = textureLod(u_attributes, place, 0.0), y = textureLod(u_attributes, place + b, 0.0);
        uvec4 z = textureLod(u_attributes, place + c, 0.0);
        corner.at.xy = w.x * uintBitsToFloat(x.xy) + w.y * uintBitsToFloat(y.xy) + w.z * uintBitsToFloat(z.xy);
        corner.color = w.x * cornerRgba(x) + w.y * cornerRgba(y) + w.z * cornerRgba(z);
        corner.area.x = coordinateArea(x, y, z);
    }
    if (more != VT_NO_TRIANGLE) {
        vec2 place = recordPlace(more + record, texel);
        uvec4 x = textureLod(u_attributes, place, 0.0), y = textureLod(u_attributes, place + b, 0.0);
        uvec4 z = textureLod(u_attributes, place + c, 0.0);
        corner.at.zw = w.x * uintBitsToFloat(x.xy) + w.y * uintBitsToFloat(y.xy) + w.z * uintBitsToFloat(z.xy);
        corner.tangent.xyz = w.x * unpackNormal(x.z) + w.y * unpackNormal(y.z) + w.z * unpackNormal(z.z);
        corner.tangent.w = x.w == 0u ? 1.0 : -1.0;
        corner.area.y = coordinateArea(x, y, z);
    }
    return corner;
}

// A place in a picture that goes on beyond its sides as vtWrap says; `margin`: half of a texel.
float wrapped(float x, uint wrap, float margin)
{
    float mirrored = 1.0 - abs(2.0 * fract(0.5 * x) - 1.0);
    return wrap == 0u ? fract(x) : clamp(wrap == 1u ? x : mirrored, margin, 1.0 - margin);
}

// The material's picture of that use (vtMapUse); white where it has none. `area`: of the triangle, world.
vec4 readMap(uint material, int use, Corner corner, float footprint, float area)
{
    uvec4 map = materialTexel(material + uint(VT_MATERIAL_MAPS + 2 * use));
    if (map.x == VT_NO_TRIANGLE) {
        return vec4(1.0);
    }
    vec4 m = uintBitsToFloat(materialTexel(material + uint(VT_MATERIAL_MAPS + 2 * use + 1)));
    bool isSecond = (map.x & VT_MAP_SECOND) != 0u;
    vec2 at = isSecond ? corner.at.zw : corner.at.xy;
    float level = imageLevel(footprint, (isSecond ? corner.area.y : corner.area.x) * abs(m.x * m.w - m.y * m.z), area);
    vec2 place = vec2(dot(m.xy, at), dot(m.zw, at)) + uintBitsToFloat(map.yz);
    float side = float(textureSize(u_images, 0).x), margin = 0.5 * exp2(ceil(level)) / side;
    place.x = wrapped(place.x, (map.x >> uint(VT_MAP_WRAP_X)) & 3u, margin);
    place.y = wrapped(place.y, (map.x >> uint(VT_MAP_WRAP_Y)) & 3u, margin);
    vec2 size = vec2(float(map.w & 0xffffu), float(map.w >> 16u));
    if ((map.x & VT_MAP_NEAREST) != 0u) {
        place = (min(floor(place * size), size - 1.0) + 0.5) / size; // the middle of a pixel
        place = (floor(place * side) + 0.5) / side;                  // and of a texel in it
    }
    return textureLod(u_images, vec3(place, float(map.x & 0xffffu)), level);
}

// A vector of the object's own in the world, but for its length: toObject's inverse times its determinant.
vec3 tangentToWorld(Transform t, vec3 v)
{
    return v.x * cross(t.y.xyz, t.z.xyz) + v.y * cross(t.z.xyz, t.x.xyz) + v.z * cross(t.x.xyz, t.y.xyz);
}

vec3 bentNormal(Transform transform, vec3 N, vec4 tangent, vec2 slope, float up)
{
    float turned = dot(transform.x.xyz, cross(transform.y.xyz, transform.z.xyz)) < 0.0 ? -1.0 : 1.0;
    vec3 T = turned * tangentToWorld(transform, tangent.xyz);
    T -= dot(T, N) * N;
    T = dot(T, T) > 0.0 ? normalize(T) : vec3(0.0);
    vec3 B = turned * tangent.w * cross(N, T);
    return normalize(slope.x * T + slope.y * B + max(up, 0.01) * N);
}

// Where a ray has met an object. `footprint`: how much of the world a pixel covers there.
Look lookAt(Meeting met, SurfaceHit surface, float footprint)
{
    int object = met.object;
    float size = 0.0;
    Corner corner = Corner(vec4(0.0), vec4(1.0), vec4(1.0, 0.0, 0.0, 1.0), vec2(0.0));
#ifdef WITH_HEIGHTS
    if (isRelief(object)) {
        OpaqueSurface at = opaqueHeights(object, met.triangle, surface.position);
        corner.at.xy = at.at;
        corner.area.x = at.areaOfTexture;
        size = at.area;
    } else
#endif
    {
        size = 0.5 * length(areaInWorld(object, cornersArea(recordCorners(met.triangle))));
        corner = cornerAt(object, met.triangle, vec3(1.0 - met.at.x - met.at.y, met.at));
    }
    uint material = objectBits(object, VT_OBJECT_EMISSIVE).w * uint(VT_MATERIAL_TEXELS);
    uvec4 flags = materialTexel(material + uint(VT_MATERIAL_FLAGS));
    vec4 color = uintBitsToFloat(materialTexel(material + uint(VT_MATERIAL_COLOR)));
    vec4 emissive = uintBitsToFloat(materialTexel(material + uint(VT_MATERIAL_EMISSIVE)));
    vec4 specular = uintBitsToFloat(materialTexel(material + uint(VT_MATERIAL_SPECULAR)));
    vec4 film = uintBitsToFloat(materialTexel(material + uint(VT_MATERIAL_FILM)));
    vec4 scales = uintBitsToFloat(materialTexel(material + uint(VT_MATERIAL_SCALES)));
    vec3 alphas = uintBitsToFloat(flags.yzw);

    Look look;
    look.flags = flags.x;
    look.G = surface.flatNormal;
    look.N = surface.normal;
    look.base = vec4(color.rgb, alphas.x) * corner.color * readMap(material, 0, corner, footprint, size);
    look.base.rgb *= checkerShare(scales.z, corner.at.xy, footprint * sqrt(corner.area.x / max(size, 1e-30)));
    look.base.a = alphas.y > 0.0 ? (look.base.a < alphas.y ? 0.0 : 1.0) : (flags.x & VT_LOOK_BLEND) != 0u ? look.base.a : 1.0;
    vec4 share = readMap(material, 1, corner, footprint, size);
    look.metallic = color.w * share.b;
    look.roughness = objectNumbers(object, VT_OBJECT_SURFACE).y * share.g; // it may be given for all glass
    look.passes = object >= u_scene.x ? 0.0
                : alphas.z * (1.0 - look.metallic) * readMap(material, 2, corner, footprint, size).r;
    uint bent = materialTexel(material + uint(VT_MATERIAL_MAPS + 2 * 3)).x;
    if (bent != VT_NO_TRIANGLE) {
        vec3 n = 2.0 * readMap(material, 3, corner, footprint, size).rgb - 1.0;
        look.N = bentNormal(readTransform(object), look.N, corner.tangent, scales.x * n.xy, n.z);
    }
    look.occlusion = 1.0 + scales.y * (readMap(material, 4, corner, footprint, size).r - 1.0);
    look.emissive = emissive.rgb * readMap(material, 5, corner, footprint, size).rgb;
    look.ior = objectNumbers(object, VT_OBJECT_GLASS).x;
    look.specularColor = specular.rgb * readMap(material, 7, corner, footprint, size).rgb;
    look.specular = specular.w * readMap(material, 6, corner, footprint, size).a;
    look.film.y = film.y;
    look.film.z = mix(film.z, film.w, readMap(material, 9, corner, footprint, size).g);
    look.film.x = look.film.z > 0.0 ? film.x * readMap(material, 8, corner, footprint, size).r : 0.0;
    return look;
}

// ------------------------------------------------------------------------------------------------ Fresnel

// What a dielectric of that index over the one around it reflects there, straight on.
vec3 reflectedAhead(Look look, float ior)
{
    float f = (look.flags & VT_LOOK_MIRROR) != 0u ? 1.0 : (ior - 1.0) / (ior + 1.0);
    return min(f * f * look.specularColor, 1.0) * look.specular;
}

// Sensitivity of red, green and blue to an optical path difference of a film, in nanometres, and a phase.
vec3 filmSensitivity(float difference, vec3 shift)
{
    const vec3 VALUE = vec3(5.4856e-13, 4.4201e-13, 5.2481e-13), PLACE = vec3(1.6810e+06, 1.7953e+06, 2.2084e+06);
    const vec3 WIDTH = vec3(4.3278e+09, 9.3046e+09, 6.6121e+09);
    float phase = 6.28318531 * difference * 1e-9;
    vec3 xyz = VALUE * sqrt(6.28318531 * WIDTH) * cos(PLACE * phase + shift) * exp(-phase * phase * WIDTH);
    xyz.x += 9.7470e-14 * sqrt(6.28318531 * 4.5282e+09) * cos(2.2399e+06 * phase + shift.x) * exp(-4.5282e+09 * phase * phase);
    xyz /= 1.0685e-7;
    return vec3(3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
                -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
                0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z);
}

// What a film on a surface that reflects F0 straight on reflects, from air at that cosine.
vec3 filmReflectance(float cosine, vec3 film, vec3 F0)
{
    float index = mix(1.0, film.y, smoothstep(0.0, 0.03, film.z));
    float s = (1.0 - cosine * cosine) / (index * index);
    float inside = sqrt(max(1.0 - s, 0.0));
    float r0 = (index - 1.0) / (index + 1.0);
    r0 *= r0;
    float R12 = r0 + (1.0 - r0) * pow(1.0 - cosine, 5.0);
    vec3 root = sqrt(clamp(F0, 0.0, 0.9999));
    vec3 base = (1.0 + root) / (1.0 - root); // index of what is below
    vec3 r1 = (base - index) / (base + index);
    r1 *= r1;
    vec3 R23 = r1 + (1.0 - r1) * pow(1.0 - inside, 5.0);
    float phase12 = index < 1.0 ? 3.14159265 : 0.0;
    vec3 phase = vec3(3.14159265 - phase12) + mix(vec3(0.0), vec3(3.14159265), lessThan(base, vec3(index)));
    float difference = 2.0 * index * film.z * inside;
    vec3 R123 = clamp(R12 * R23, 1e-5, 0.9999), r123 = sqrt(R123);
    vec3 Rs = (1.0 - R12) * (1.0 - R12) * R23 / (1.0 - R123);
    vec3 light = vec3(R12) + Rs, C = Rs - (1.0 - R12);
    for (int m = 1; m <= 2; ++m) {
        C *= r123;
        light += 2.0 * C * filmSensitivity(float(m) * difference, float(m) * phase);
    }
    return max(light, 0.0);
}

// What the surface reflects of light that meets it from outside at that cosine; `exact`: fresnel() there.
vec3 lookReflectance(Look look, float cosine, float exact, float ior, bool fromInside)
{
    float f = (ior - 1.0) / (ior + 1.0), share = clamp((exact - f * f) / max(1.0 - f * f, 1e-6), 0.0, 1.0);
    vec3 F0 = reflectedAhead(look, ior);
    vec3 F = (look.flags & VT_LOOK_MIRROR) != 0u ? F0 : F0 + (look.specular - F0) * share;
    if (look.film.x > 0.0 && !fromInside) {
        F = mix(F, filmReflectance(cosine, look.film, F0), look.film.x);
    }
    return clamp(F, 0.0, 1.0);
}

// ------------------------------------------------------------------------------------------------- light

#ifdef WITH_SHADE
vec3 passedByLook(Meeting met, SurfaceHit hit, vec3 L, inout Media media)
{
    Look look = lookAt(met, hit, 0.0);
    vec3 F = vec3(0.0);
    bool isInterface = true;
    if ((look.flags & VT_LOOK_THIN) == 0u && met.object < u_scene.x) {
        uint id = mediumOf(met.object);
        media = (dot(look.G, L) > 0.0) != holds(media, id) ? toggle(media, id) : media;
        uint from = topOf(media);
        media = toggle(media, id);
        media = met.also >= 0 ? toggle(media, mediumOf(met.also)) : media;
        isInterface = from != topOf(media);
        look.ior = glassOf(from).x / glassOf(topOf(media)).x;
    }
    float ior = max(look.ior, 1.0 / look.ior), cosine = abs(dot(look.N, L));
    if (isInterface && u_scene.z != 0) {
        F = lookReflectance(look, cosine, fresnel(cosine, 1.0 / ior), ior, false);
    }
    vec3 through = look.passes * (isInterface ? (1.0 - F) * look.base.rgb : vec3(1.0));
    return vec3(1.0 - look.base.a) + look.base.a * through;
}
#endif

// Light of one of the scene's lights at a place, on what faces it, if nothing is in the way; L: the direction towards it.
vec3 lightSent(int i, vec3 position, out vec3 L, out float distance)
{
    vec4 place = uintBitsToFloat(materialTexel(uint(1 + 3 * i))), along = uintBitsToFloat(materialTexel(uint(2 + 3 * i)));
    vec4 color = uintBitsToFloat(materialTexel(uint(3 + 3 * i)));
    // place.w: range; below 0: the light is directional. along.w, color.w: cosines of a spot's cones, inner above outer.
    bool isFar = place.w < 0.0;
    vec3 to = mix(place.xyz - position, -along.xyz, bvec3(isFar));
    float far = max(length(to), 1e-6), near = place.w > 0.0 ? far / place.w : 0.0;
    L = to / far;
    distance = isFar ? NOWHERE : far;
    float fade = isFar ? 1.0 : clamp(1.0 - near * near * near * near, 0.0, 1.0) / (far * far);
    float cone = clamp((dot(-L, along.xyz) - color.w) / max(along.w - color.w, 1e-4), 0.0, 1.0);
    return color.rgb * (fade * cone * cone);
}

// Radiance towards V of the scene's lights at a point: of a matt surface of that colour, and of a glossy one. G: of the
// triangle, on V's side. The sun comes after the others: `glossy` is the share of it that is reflected about R.
vec3 lightOfLights(Start from, vec3 N, vec3 G, vec3 V, vec3 matt, vec3 F0, vec3 F90, float roughness, vec3 R, vec3 glossy)
{
    int lamps = int(materialTexel(0u).x), count = lamps;
#ifdef WITH_SHADE
    ++count;
#endif
    float r = max(roughness, 0.0525), a = r * r, nv = max(dot(N, V), 1e-3);
    vec3 sum = vec3(0.0);
    for (int i = 0; i <= VT_MOST_LIGHTS; ++i) {
        if (i >= count) {
            break;
        }
        float distance;
        vec3 L, sent = lightSent(i, from.position, L, distance);
        float nl = max(dot(N, L), 0.0);
        vec3 H = normalize(L + V);
        float nh = max(dot(N, H), 0.0), vh = max(dot(V, H), 0.0);
        float d = nh * nh * (a * a - 1.0) + 1.0;
        float D = a * a / (3.14159265 * d * d);
        float shadowing = 0.5 / (nl * sqrt(nv * nv * (1.0 - a * a) + a * a) + nv * sqrt(nl * nl * (1.0 - a * a) + a * a) + 1e-6);
        vec3 F = F0 + (F90 - F0) * pow(1.0 - vh, 5.0);
        vec3 light = sent * nl * (matt / 3.14159265 + F * (D * shadowing));
#ifdef WITH_SHADE // one call for all: software renderers take long to compile another
        vec3 towards, sun = sunLight(N, R, matt, glossy, roughness, towards);
        bvec3 isSun = bvec3(i == lamps);
        light = withShadows(from, G, mix(L, towards, isSun), mix(distance, NOWHERE, isSun.x), mix(light, sun, isSun));
#endif
        sum += light;
    }
    return sum;
}

// Radiance that the surface sends against the direction I, but for what it reflects and lets pass as glass does: what is
// matt, metal and light of its own, and lights seen in it. N: against I. `from`: where it is; `at`: weights of
// its triangle's second and third corner.
vec3 sentLight(Look look, vec3 N, vec3 I, Start from, vec2 at)
{
    float cosine = -dot(N, I);
    float matt = (1.0 - look.metallic) * (1.0 - look.passes / max(1.0 - look.metallic, 1e-6));
    float glossy = look.metallic + matt;
    vec3 metal = look.metallic * look.base.rgb, dielectric = reflectedAhead(look, look.ior);
    vec3 F0 = (metal + matt * dielectric) / max(glossy, 1e-6), G = dot(look.G, I) > 0.0 ? -look.G : look.G;
    float F90 = (look.metallic + matt * look.specular) / max(glossy, 1e-6);
    vec3 light = look.emissive;
    vec3 R = normalize(I + 2.0 * cosine * N), sunShare = vec3(0.0);
    if (glossy > 0.0) {
        vec3 share = reflectedShare(F0, F90, look.roughness, cosine);
        if (look.film.x > 0.0) {
            share = mix(share, filmReflectance(cosine, look.film, F0), look.film.x);
        }
        light += look.occlusion * (matt * look.base.rgb * diffuseLight(N) + glossy * specularLight(R, look.roughness, 0.0) * share);
        sunShare = glossy * share;
#ifdef WITH_SHADE
        light += matt * look.base.rgb * photonLight(from, at, dot(look.G, I) > 0.0);
#endif
    }
    light += lightOfLights(from, N, G, -I, matt * look.base.rgb, metal + (matt + look.passes) * dielectric,
                           vec3(look.metallic + (matt + look.passes) * look.specular), look.roughness, R, sunShare);
    // As it is, whatever the exposure.
    return (look.flags & VT_LOOK_UNLIT) != 0u ? look.base.rgb / u_optics.z : light;
}
