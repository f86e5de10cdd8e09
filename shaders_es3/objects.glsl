// The scene's objects, a row of texels each: src/gl/scene_buffer.h. Glass by falling precedence, then what is opaque.
uniform usampler2D u_objects;

struct SurfaceHit {
    vec3 position; // world
    vec3 normal;   // outward, interpolated
    vec3 flatNormal;
    int object;
};

uvec4 objectBits(int object, int part)
{
    return texelFetch(u_objects, ivec2(part, object), 0);
}

vec4 objectNumbers(int object, int part)
{
    return uintBitsToFloat(objectBits(object, part));
}

// Rows of the matrix from the world to the object's own coordinates.
struct Transform {
    vec4 x, y, z;
};

Transform readTransform(int object)
{
    return Transform(objectNumbers(object, VT_OBJECT_TRANSFORM), objectNumbers(object, VT_OBJECT_TRANSFORM + 1),
                     objectNumbers(object, VT_OBJECT_TRANSFORM + 2));
}

// A world point or, with w = 0, a world vector in the object's own coordinates.
vec3 toObject(Transform t, vec4 p)
{
    return vec3(dot(t.x, p), dot(t.y, p), dot(t.z, p));
}

// An outward normal of the object's in the world.
vec3 normalToWorld(Transform t, vec3 n)
{
    return normalize(n.x * t.x.xyz + n.y * t.y.xyz + n.z * t.z.xyz);
}

const float NOWHERE = 1e30; // farther than anything

// Where a path meets an object.
struct Meeting {
    float distance; // in the world
    uint triangle;
};

// Does a ray come into the object's box before `farthest`?
bool entersBox(int object, vec3 origin, vec3 direction, float farthest)
{
    vec3 inverse = 1.0 / direction; // infinite where it is parallel to a side
    vec3 a = (objectNumbers(object, VT_OBJECT_LOW).xyz - origin) * inverse;
    vec3 b = (objectNumbers(object, VT_OBJECT_HIGH).xyz - origin) * inverse;
    vec3 enters = min(a, b), leaves = max(a, b);
    float enter = max(max(enters.x, enters.y), enters.z), leave = min(min(leaves.x, leaves.y), leaves.z);
    return enter <= min(leave, farthest) && leave >= 0.0;
}
