// Layers to texels of four: where layer k has no surface it takes that of layer k - 2, which faces the
// same way, so that a search along it does not fall off the layer's edge (Wang & Chi 2014, section 3.5.2).
uniform usampler2DArray u_layerDepths;
uniform int u_group; // of a set of layers
uniform int u_firstLayer; // of that set

layout(location = 0) out uvec4 o_depths;

void main()
{
    vec2 place = gl_FragCoord.xy / vec2(u_size.zw);
    uint odd = VT_DEPTH_NONE, even = VT_DEPTH_NONE; // the last surface seen of layers 1, 3, ... and 2, 4, ...
    uvec4 depths = uvec4(VT_DEPTH_NONE); // WebGL indexes no output by a variable
    for (int layer = 0; layer < u_search.x && layer < 4 * (u_group + 1); ++layer) {
        uint depth = textureLod(u_layerDepths, vec3(place, u_firstLayer + layer), 0.0).r;
        bool isOdd = layer % 2 == 0; // layers count from one in the paper
        depth = depth != VT_DEPTH_NONE ? depth : isOdd ? odd : even;
        if (isOdd) {
            odd = depth;
        } else {
            even = depth;
        }
        if (layer >= 4 * u_group) {
            depths[layer % 4] = depth;
        }
    }
    o_depths = depths;
}
