#define FRUSTUM u_layerFrustum
#define DEPTH_RANGE u_layerDepth
