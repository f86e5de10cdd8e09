#define TO_FLOATS
