#define WITH_LOOKS
