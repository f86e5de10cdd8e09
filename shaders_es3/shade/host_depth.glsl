// The depth texture of the host's picture, and its depth buffer.
uniform highp sampler2D u_hostDepth;

const float NOTHING_BEHIND = 3e38;

// Depth in front of the eye of what the host has drawn at a pixel of its framebuffer; NOTHING_BEHIND where it has drawn
// nothing.
float hostDepth(ivec2 pixel)
{
    float z = 2.0 * texelFetch(u_hostDepth, clamp(pixel, ivec2(0), textureSize(u_hostDepth, 0) - 1), 0).r - 1.0;
    // Selected without branches, as loops call it (docs/method.md).
    float depth = mix(u_clip.y / (z + u_clip.x), (u_clip.y - z) / u_clip.x, u_clip.w != 0.0);
    return mix(NOTHING_BEHIND, depth, all(bvec3((u_host.w & 2) != 0, depth > 0.0, depth < u_clip.z)));
}

// What the host's depth buffer holds of a depth in front of the eye.
float windowDepth(float depth)
{
    float z = u_clip.w != 0.0 ? u_clip.y - u_clip.x * depth : u_clip.y / depth - u_clip.x;
    return clamp(0.5 * z + 0.5, 0.0, 1.0);
}
