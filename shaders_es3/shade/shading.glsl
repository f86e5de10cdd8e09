// The light of opaque surfaces. The twin of src/light/shading.c, which names the sources. Wants octahedral.glsl,
// environment.glsl, objects.glsl, records.glsl and lighting.glsl before it.
uniform usampler2D u_attributes;  // a texel a corner of a pair: constants.h
uniform sampler2DArray u_images;  // src/gl/image_array.h

struct Attributes {
    vec2 at;    // texture coordinates
    vec3 color;
    float area; // of the triangle in texture coordinates
};

vec3 cornerColor(uvec4 texel)
{
    return vec3(unpackHalf2x16(texel.z), unpackHalf2x16(texel.w).x);
}

// Of a triangle whose pair has that attribute record.
Attributes attributesAt(uint record, uint second, vec3 w)
{
    vec2 texel = 1.0 / vec2(textureSize(u_attributes, 0));
    vec2 place = recordPlace(record, texel);
    uvec4 a = textureLod(u_attributes, place, 0.0);
    uvec4 b = textureLod(u_attributes, place + vec2(float(1u + second) * texel.x, 0.0), 0.0);
    uvec4 c = textureLod(u_attributes, place + vec2(float(2u + second) * texel.x, 0.0), 0.0);
    vec2 A = uintBitsToFloat(a.xy), B = uintBitsToFloat(b.xy), C = uintBitsToFloat(c.xy);
    vec2 e1 = B - A, e2 = C - A;
    vec3 color = w.x * cornerColor(a) + w.y * cornerColor(b) + w.z * cornerColor(c);
    return Attributes(w.x * A + w.y * B + w.z * C, color, 0.5 * abs(e1.x * e2.y - e1.y * e2.x));
}

// The scene's image; `level` of the averaged ones.
vec3 readImage(uint image, vec2 at, float level)
{
    return image == VT_NO_TRIANGLE ? vec3(1.0) : textureLod(u_images, vec3(fract(at), float(image)), level).rgb;
}

// Twice the triangle's area in the world along its normal: a surface's areas turn with the transposed inverse
// times the determinant, and the table has the inverse.
vec3 areaInWorld(int object, vec3 area)
{
    vec3 x = objectNumbers(object, VT_OBJECT_TRANSFORM).xyz, y = objectNumbers(object, VT_OBJECT_TRANSFORM + 1).xyz;
    vec3 z = objectNumbers(object, VT_OBJECT_TRANSFORM + 2).xyz;
    return (area.x * x + area.y * y + area.z * z) / abs(dot(cross(x, y), z));
}

// Of the images' levels, the one whose texels are as large as `footprint` is where the triangle has these areas.
float imageLevel(float footprint, float areaOfTexture, float area)
{
    float side = float(textureSize(u_images, 0).x);
    float texels = footprint * side * sqrt(areaOfTexture / max(area, 1e-30));
    return log2(max(texels, 1.0));
}

// How bright the squares of a checker are there, 1 and 0.15: the mean over `width` of texture coordinates. So many squares
// a unit; 0: there is none.
float checkerShare(float squares, vec2 at, float width)
{
    at *= squares;
#ifdef WITH_ROUGH
    // The square wave of each axis, integrated.
    width = max(squares * width, 1e-3);
    vec2 low = 2.0 * fract(0.5 * (at - 0.5 * width)), high = 2.0 * fract(0.5 * (at + 0.5 * width));
    vec2 mean = (abs(low - 1.0) - abs(high - 1.0)) / width;
    return mix(1.0, 0.575 + 0.425 * mean.x * mean.y, step(1e-6, squares));
#else
    vec2 square = floor(at);
    return 2.0 * fract(0.5 * (square.x + square.y)) > 0.5 ? 0.15 : 1.0; // odd
#endif
}

// The share of light about the mirror direction that is reflected. F0, F90: of a smooth surface straight on and along it.
vec3 reflectedShare(vec3 F0, float F90, float roughness, float cosine)
{
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * cosine)) * r.x + r.y;
    return max(F0 * (r.z - 1.04 * a) + F90 * (r.w + 1.04 * a), 0.0);
}

#ifdef WITH_FOOTPRINT
// The roughness of a surface that reflects to `width` more directions, an angle: a square's variance, a twelfth of its
// side's square, is half as wide in half vectors, and alpha's square is twice their variance. Less than the least blurred
// level of the lighting holds is the environment's own, at that width.
float widened(float roughness, float width)
{
    float alpha = roughness * roughness, wide = sqrt(sqrt(alpha * alpha + width * width / 24.0));
    return wide > 0.1 ? min(wide, 1.0) : roughness;
}
#endif

// What there is of an opaque surface where a ray has met it.
struct OpaqueSurface {
    vec3 normal, flatNormal; // world, outward
    vec2 at;                 // texture coordinates
    vec3 color;
    float areaOfTexture, area; // of a part of the surface, in texture coordinates and in the world
#ifdef WITH_SHADE
    Start from;  // where rays towards lights start
    vec2 corner; // weights of the triangle's second and third corner
#endif
#ifdef WITH_FOOTPRINT
    mat3 turn; // what a step along the surface does to the normal
#endif
};

OpaqueSurface opaqueSurface(int object, RecordHit hit)
{
    Corners corners = recordCorners(hit.triangle);
    Transform transform = readTransform(object);
    vec3 area = areaInWorld(object, cornersArea(corners));
    vec3 w = vec3(1.0 - hit.at.x - hit.at.y, hit.at);
    uint first = objectBits(object, VT_OBJECT_COLOR).w;
    Attributes attributes = Attributes(vec2(0.0), vec3(1.0), 0.0);
    if (first != VT_NO_TRIANGLE) {
        uint record = (hit.triangle >> 1u) - objectBits(object, VT_OBJECT_GRID_LOW).w; // of the mesh's
        attributes = attributesAt(first + record, hit.triangle & 1u, w);
    }
    return OpaqueSurface(normalToWorld(transform, cornersNormal(corners, hit.at)), normalize(area), attributes.at,
                         attributes.color, attributes.area, 0.5 * length(area)
#ifdef WITH_SHADE
                         , NO_START, vec2(0.0)
#endif
#ifdef WITH_FOOTPRINT
                         , cornersTurn(transform, corners, hit.at)
#endif
                         );
}

#ifdef WITH_HEIGHTS
// Of a relief that is met by its heights, at that place.
OpaqueSurface opaqueHeights(int object, uint triangle, vec3 position)
{
    ReliefBox box = readRelief(object);
    Transform transform = readTransform(object);
    SurfaceHit hit = heightsSurfaceAt(object, triangle, position);
    vec2 extent = box.high.xy * box.cell;
    vec2 at = (toObject(transform, vec4(position, 1.0)).xy - box.corner) / extent;
    // The whole picture, on a plane as steep as the surface is.
    float steep = abs(dot(hit.flatNormal, cross(transform.x.xyz, transform.y.xyz)));
    return OpaqueSurface(hit.normal, hit.flatNormal, vec2(at.x, 1.0 - at.y), vec3(1.0), 1.0, extent.x * extent.y / max(steep, 1e-6)
#ifdef WITH_SHADE
                         , NO_START, vec2(0.0)
#endif
#ifdef WITH_FOOTPRINT
                         , hit.turn
#endif
                         );
}
#endif

// Radiance that leaves an opaque object against the ray's direction I. `footprint`: how much of the world a pixel covers
// there, 0: images at full size; or what neighbouring rays do.
#ifdef WITH_FOOTPRINT
vec3 shadeOpaque(int object, OpaqueSurface at, vec3 I, Footprint steps)
#else
vec3 shadeOpaque(int object, OpaqueSurface at, vec3 I, float footprint)
#endif
{
    vec4 surface = objectNumbers(object, VT_OBJECT_SURFACE);
    uvec4 images = objectBits(object, VT_OBJECT_IMAGES);
#ifdef WITH_FOOTPRINT
    STEPS place = alongSurface(steps.place, I, at.flatNormal);
    float footprint = footprintWidth(place);
#endif
    float level = imageLevel(footprint, at.areaOfTexture, at.area);
    vec3 base = objectNumbers(object, VT_OBJECT_COLOR).rgb * readImage(images.x, at.at, level) * at.color;
    base *= checkerShare(surface.z, at.at, footprint * sqrt(at.areaOfTexture / max(at.area, 1e-30)));
    vec3 share = readImage(images.y, at.at, level);
    float metallic = surface.x * share.b, roughness = surface.y * share.g;

    // On the viewer's side, or the triangle's own where the interpolated one faces away.
    vec3 G = at.flatNormal;
    float side = dot(G, I) > 0.0 ? -1.0 : 1.0;
    bool isSmooth = dot(side * at.normal, I) < 0.0;
    vec3 N = side * (isSmooth ? at.normal : G);

    float cosine = -dot(N, I), width = 0.0;
#ifdef WITH_FOOTPRINT
    STEPS turn = (isSmooth ? side : 0.0) * (at.turn * place);
    width = footprintWidth(bendFootprint(steps.direction, I, N, turn, 1.0, true));
    roughness = widened(roughness, width);
#endif
    vec3 F0 = mix(vec3(0.04), base, metallic);
    vec3 diffuse = (1.0 - metallic) * base * diffuseLight(N);
    vec3 R = normalize(I + 2.0 * cosine * N), glossy = reflectedShare(F0, 1.0, roughness, cosine);
    vec3 light = diffuse + specularLight(R, roughness, width) * glossy + objectNumbers(object, VT_OBJECT_EMISSIVE).xyz;
#ifdef WITH_SHADE
    vec3 L, matt = (1.0 - metallic) * base, sun = sunLight(N, R, matt, glossy, roughness, L);
    light += withShadows(at.from, side * G, L, NOWHERE, sun) + matt * photonLight(at.from, at.corner, side < 0.0);
#endif
    return light;
}
