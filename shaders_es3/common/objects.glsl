// The scene's objects, a row of texels each: src/gl/scene_buffer.h. Glass by falling precedence, then what is opaque.
uniform usampler2D u_objects;

struct SurfaceHit {
    vec3 position; // world
    vec3 normal;   // outward, interpolated
    vec3 flatNormal;
    int object;
#ifdef WITH_FOOTPRINT
    mat3 turn; // what a step along the surface does to the normal
#endif
};

uvec4 objectBits(int object, int part)
{
    return readTexel(u_objects, ivec2(part, object), ivec2(VT_OBJECT_TEXELS, u_scene.y));
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

// The number plus one that an object of glass has among the media of a path.
uint mediumOf(int object)
{
#ifdef WITH_LOOKS // several may bound one body
    return uint(objectNumbers(object, VT_OBJECT_SURFACE).w) + 1u;
#else
    return uint(object + 1);
#endif
}
#ifdef WITH_FOOTPRINT
// The same of a normal's change over the object's own coordinates: that of the unit normal over the world's.
mat3 turnToWorld(Transform t, vec3 n, mat3 change)
{
    mat3 toOwn = transpose(mat3(t.x.xyz, t.y.xyz, t.z.xyz));
    vec3 N = n * toOwn;
    float scale = inversesqrt(dot(N, N));
    N *= scale;
    mat3 turn = scale * (transpose(toOwn) * change * toOwn);
    return turn - outerProduct(N, N * turn);
}
#endif

const float NOWHERE = 1e30; // farther than anything
