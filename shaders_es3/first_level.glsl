#define FIRST_LEVEL
