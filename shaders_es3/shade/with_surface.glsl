#define WITH_SURFACE
uniform usampler2D u_surface;
