#define WITH_HOST
