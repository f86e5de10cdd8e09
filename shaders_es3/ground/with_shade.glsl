#define WITH_SHADE
