// From object to object along a ray. The layout: src/gl/object_tree.h.
uniform usampler2D u_objectTree;

// The next object whose box a ray enters before `farthest`, of those from node `at` on; -1: none is left. `at` becomes
// the node behind it. Whole subtrees are passed over by where they end.
int nextObject(inout int at, vec3 origin, vec3 inverse, float farthest)
{
    vec2 texel = 1.0 / vec2(textureSize(u_objectTree, 0));
    int object = -1, end = 2 * u_scene.y - 1;
    for (int i = 0; i < 2 * VT_MAX_OBJECTS && object < 0 && at < end; ++i) {
        vec2 place = (vec2(2 * (at % VT_OBJECT_NODES_A_ROW), at / VT_OBJECT_NODES_A_ROW) + 0.5) * texel;
        uvec4 low = textureLod(u_objectTree, place, 0.0), high = textureLod(u_objectTree, place + vec2(texel.x, 0.0), 0.0);
        vec3 a = (uintBitsToFloat(low.xyz) - origin) * inverse, b = (uintBitsToFloat(high.xyz) - origin) * inverse;
        vec3 enters = min(a, b), leaves = max(a, b);
        float enter = max(max(enters.x, enters.y), max(enters.z, 0.0));
        float leave = min(min(leaves.x, leaves.y), min(leaves.z, farthest));
        bool isEntered = enter <= leave;
        object = isEntered ? int(high.w) - 1 : object; // 0: an inner node
        at = isEntered ? at + 1 : int(low.w);
    }
    return object;
}
