#define WITH_DEPTH
