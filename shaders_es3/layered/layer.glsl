// What a drawing of layers lies in: all glass's.
#define FRUSTUM u_layerFrustum
#define DEPTH_RANGE u_layerDepth
