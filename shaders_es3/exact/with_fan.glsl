#define WITH_FAN
