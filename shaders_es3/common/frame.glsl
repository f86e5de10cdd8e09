// The uniform block shared by every pass; mirrors vtFrameUniforms in src/gl/uniforms.h.
layout(std140) uniform Frame
{
    mat4 u_worldToCamera; // (right, up, depth) coordinates of a world point
    vec4 u_eye; // w: path.glsl's choice
    vec4 u_pictureFrustum; // left, bottom, right, top: tangents
    vec4 u_layerFrustum;
    vec4 u_pictureDepth; // near, far, 1 / (far - near), 0
    vec4 u_layerDepth;
    vec4 u_boundsMin; // the box of all glass, world
    vec4 u_boundsMax;
    vec4 u_optics;   // index of refraction (kay-thickness), transmittance, exposure factor, samples so far
    vec4 u_kay;      // largest and smallest transmittance, power, wall thickness
    ivec4 u_search;  // layers, linear steps, binary steps, events
    ivec4 u_size;    // picture width, height, layer width, height
    ivec4 u_scene;   // objects of glass, objects, Fresnel reflection, the technique finds what is opaque itself
    ivec4 u_output;  // vtOutput, layer, vtEnvironmentKind, vtBackground
    ivec4 u_host;    // the picture's lower left corner in the framebuffer; whether linear light is wanted;
                     // 1: the host gives colours, 2: depths, 4: its colours are linear, 8: they have levels, 16: it draws what is opaque
    vec4 u_clip;     // third row of the host's projection: element of depth, constant; depth from which on there is
                     // nothing; 1: it is orthographic, and tangents are world units
    ivec4 u_sample; // its number; 1: chance chooses what its paths follow (trace.frag); what it weighs in
                    // the mean; what all weigh more than their number
};

// A texel by its column and row. Software renderers take half as long for it as for texelFetch. For textures of one
// level that are not filtered, as src/gl/target.c makes them; beyond the edge it is the texel at the edge.
#define readTexel(s, texel, size) textureLod(s, (vec2(texel) + 0.5) / vec2(size), 0.0)
#define readPixel(s, size) textureLod(s, gl_FragCoord.xy / vec2(size), 0.0) // of a texture as large as what is drawn
#define readLayer(s, texel, layer, size) textureLod(s, vec3((vec2(texel) + 0.5) / vec2(size), layer), 0.0)

// Unit world direction through a point of the plane at depth 1.
vec3 cameraDirection(vec2 tangent)
{
    // The camera frame is orthonormal, so its transpose turns camera coordinates into world ones.
    return normalize(vec3(tangent * (1.0 - u_clip.w), 1.0) * mat3(u_worldToCamera));
}

// Where the eye ray of that point begins: the eye; orthographic, the point beside it.
vec3 eyePosition(vec2 tangent)
{
    return u_eye.xyz + u_clip.w * (vec3(tangent, 0.0) * mat3(u_worldToCamera));
}

// The world point at a depth on that ray.
vec3 pointAtDepth(vec2 tangent, float depth)
{
    return u_eye.xyz + vec3(tangent * mix(depth, 1.0, u_clip.w), depth) * mat3(u_worldToCamera);
}

// Tangents at a pixel position (pixel centres at .5, origin bottom left).
vec2 pictureTangent(vec2 pixel)
{
    return mix(u_pictureFrustum.xy, u_pictureFrustum.zw, pixel / vec2(u_size.xy));
}
