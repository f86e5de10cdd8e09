#define FARTHEST
