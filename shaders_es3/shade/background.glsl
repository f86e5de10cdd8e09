// What is shown where nothing of the scene is: a colour, a picture, or the blurred environment.
#define WITH_BACKGROUND
uniform sampler2D u_background; // the picture, sRGB with all its levels, or the blurred environment, equirectangular
uniform vec4 u_behind;          // the colour, linear

// The picture fills the frame and keeps its shape; what is too long is cut off evenly on both sides. Row 0 of the texture
// is the picture's top row.
vec3 pictureBehind(vec2 pixel)
{
    vec2 size = vec2(textureSize(u_background, 0)), frame = vec2(u_size.xy);
    vec2 texels = size / frame; // a pixel
    float scale = min(texels.x, texels.y);
    vec2 texel = 0.5 * size + scale * vec2(pixel.x - 0.5 * frame.x, 0.5 * frame.y - pixel.y);
    return textureLod(u_background, texel / size, log2(max(scale, 1.0))).rgb;
}

vec3 behind(vec2 pixel)
{
    if (u_output.w == VT_BACKGROUND_PICTURE) {
        return pictureBehind(pixel);
    }
    if (u_output.w == VT_BACKGROUND_BLURRED) {
        vec2 uv = environmentCoordinates(cameraDirection(pictureTangent(pixel)));
        return u_optics.z * textureLod(u_background, vec2(uv.x, 1.0 - uv.y), 0.0).rgb;
    }
    return u_behind.rgb;
}

vec3 shownLight(vec3 light); // of display.glsl

// As display.glsl has it, with what lies behind: light that is shown as the rest, or a colour that is shown as it is.
vec4 displayed(vec3 light, float share)
{
    bool isLinear = u_host.z != 0;
    vec3 back = behind(gl_FragCoord.xy - vec2(u_host.xy));
    bool isLight = u_output.w == VT_BACKGROUND_BLURRED;
    light = isLight ? mix(back, light, share) : light;
    vec3 shown = isLinear ? light : shownLight(light);
    shown = isLight ? shown : mix(back, shown, share);
    return vec4(isLinear ? shown : linearToSrgb(shown), 1.0);
}
