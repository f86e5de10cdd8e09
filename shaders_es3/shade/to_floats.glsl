// Whoever reads the picture back wants more than 8 bits: those of floats.
#define TO_FLOATS
layout(location = 0) out uvec4 o_color;
#define SHOWN(color) floatBitsToUint(color)
