#define ONE_OBJECT
