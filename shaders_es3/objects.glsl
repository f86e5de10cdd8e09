// The scene's objects, a row of texels each: src/gl/scene_buffer.h. Glass by falling precedence, then what is opaque.
uniform usampler2D u_objects;

uvec4 objectBits(int object, int part)
{
    return texelFetch(u_objects, ivec2(part, object), 0);
}

vec4 objectNumbers(int object, int part)
{
    return uintBitsToFloat(objectBits(object, part));
}

bool isOpaque(int object)
{
    return objectBits(object, VT_OBJECT_HIGH).w != 0u;
}

// A world point or, with w = 0, a world vector in the object's own coordinates.
vec3 toObject(int object, vec4 p)
{
    return vec3(dot(objectNumbers(object, VT_OBJECT_TRANSFORM), p), dot(objectNumbers(object, VT_OBJECT_TRANSFORM + 1), p),
                dot(objectNumbers(object, VT_OBJECT_TRANSFORM + 2), p));
}

// An outward normal of the object's in the world.
vec3 normalToWorld(int object, vec3 n)
{
    return normalize(n.x * objectNumbers(object, VT_OBJECT_TRANSFORM).xyz +
                     n.y * objectNumbers(object, VT_OBJECT_TRANSFORM + 1).xyz +
                     n.z * objectNumbers(object, VT_OBJECT_TRANSFORM + 2).xyz);
}
