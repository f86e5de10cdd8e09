// SPDX-License-Identifier: MIT
// Limits and codes of the public interface, which the shaders read too: only lines that mean the same in C
// and GLSL.
#define VT_MAX_LAYERS 16
#define VT_MAX_STEPS 1000
#define VT_MAX_REFINE 32
#define VT_MAX_EVENTS 64
#define VT_MAX_BRANCHES 4
#define VT_MAX_WAVELENGTHS 3
#define VT_MAX_OBJECTS 4096

// What became of a path: the lowest byte of its state.
#define VT_PATH_BACKGROUND 0
#define VT_PATH_EXITED 1
#define VT_PATH_LOST 2
#define VT_PATH_OPAQUE 3 // it ends on an opaque surface
// The next seven bits count events. The first of these is set where the path passed a thin wall, the second
// where total internal reflection took part.
#define VT_PATH_WALL 32768
#define VT_PATH_TIR 65536
// From this bit on texture reads are counted where the frame asks for it, up to VT_MAX_READS.
#define VT_PATH_READS_SHIFT 17
#define VT_MAX_READS 32767

// What a frame shows; the values of vtOutput.
#define VT_OUTPUT_PICTURE 0
#define VT_OUTPUT_ANALYSIS 1
#define VT_OUTPUT_LAYER_DEPTH 2
#define VT_OUTPUT_LAYER_NORMAL 3

// What is behind the scene; the values of vtBackground.
#define VT_BACKGROUND_ENVIRONMENT 0
#define VT_BACKGROUND_TRANSPARENT 1
#define VT_BACKGROUND_COLOR 2
#define VT_BACKGROUND_BLURRED 3
#define VT_BACKGROUND_PICTURE 4
