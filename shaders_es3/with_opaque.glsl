#define WITH_OPAQUE
