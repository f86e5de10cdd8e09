// What searches through layers share: the box around them, and the walls that they do not show.

const float BOX_MARGIN = 4.0; // texels at the far end

// A texel's side at a distance from the eye.
float texelSize(Layers layers, float distance)
{
    return distance * (layers.frustum.z - layers.frustum.x) / float(u_size.z);
}

// Distances along the ray to where it enters (0 where it starts within) and leaves the layers' box, widened by a few
// texels: a face of the object that lies in a face of its box is found only once the ray is behind the depth of the
// texel there. It misses the box where it enters behind where it leaves.
vec2 boxSpan(Layers layers, vec3 origin, vec3 direction)
{
    float margin = BOX_MARGIN * layers.depths.y * (layers.frustum.z - layers.frustum.x) / float(u_size.z);
    vec3 low = (layers.low - margin - origin) / direction;
    vec3 high = (layers.high + margin - origin) / direction;
    vec3 enter = min(low, high), leave = max(low, high);
    return vec2(max(max(enter.x, max(enter.y, enter.z)), 0.0), max(min(leave.x, min(leave.y, leave.z)), 0.0));
}

bool facesRightWay(vec3 normal, vec3 direction, bool inside)
{
    return (dot(normal, direction) > 0.0) == inside;
}

// A wall between two columns: its normal runs from that of the surface before to that of the one behind.
bool wallBetween(Layers layers, vec3 inner, Column innerColumn, Column outerColumn, vec3 direction, bool inside, out vec3 normal)
{
    ivec2 texel = layerTexel(inner.xy);
    bool isWall = isInside(innerColumn) && innerColumn.after != 0 && !isInside(outerColumn);
    uvec2 before = layerNormals(layers, highestBit(innerColumn.before), texel);
    uvec2 after = layerNormals(layers, lowestBit(innerColumn.after), texel);
    float share = (inner.z - innerColumn.beforeDepth) / max(innerColumn.afterDepth - innerColumn.beforeDepth, 1.0);
    normal = mix(unpackNormal(before.x), unpackNormal(after.x), share);
    float size = length(normal);
    normal = size > 1e-3 ? normal / size : (inside ? direction : -direction);
    return isWall && facesRightWay(normal, direction, inside);
}
