// What every drawing of the mesh stores of a surface point.
uniform int u_mirrored; // 1: the object is, so that its front faces run clockwise

in vec3 v_camera;
in vec3 v_normal;

// Outward unit normals, packed: x interpolated, y of the triangle itself.
uvec2 surfaceNormals()
{
    // The triangle's plane from its position's screen derivatives, turned to the eye, then outward.
    vec3 flatNormal = cross(dFdx(v_camera), dFdy(v_camera));
    flatNormal = flatNormal * mat3(u_worldToCamera);
    vec3 towardsEye = -(v_camera * mat3(u_worldToCamera));
    bool isFront = gl_FrontFacing != (u_mirrored != 0);
    bool turn = (dot(flatNormal, towardsEye) < 0.0) == isFront;
    flatNormal = turn ? -flatNormal : flatNormal;

    float size = dot(flatNormal, flatNormal);
    vec3 smoothNormal = dot(v_normal, v_normal) > 0.0 ? normalize(v_normal) : vec3(0.0, 1.0, 0.0);
    flatNormal = size > 0.0 ? flatNormal * inversesqrt(size) : smoothNormal;
    return uvec2(packNormal(smoothNormal), packNormal(flatNormal));
}
