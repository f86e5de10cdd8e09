#define KEEPS_FIRST
