#define WITH_ROUGH
