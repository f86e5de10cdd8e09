// What a drawing of layers lies in: the object's own. Needs objects.
uniform int u_object;
#define FRUSTUM objectNumbers(u_object, VT_OBJECT_FRUSTUM)
#define DEPTH_RANGE objectNumbers(u_object, VT_OBJECT_DEPTHS)
