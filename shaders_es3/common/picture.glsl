#define FRUSTUM u_pictureFrustum
#define DEPTH_RANGE u_pictureDepth
