#define STRICT
