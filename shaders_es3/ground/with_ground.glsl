#define WITH_GROUND
