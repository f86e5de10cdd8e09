// Numbers shared by C and GLSL, beside those of src/vitrine_limits.h. Only lines that mean the same in both may stand here.
#define VT_MAX_LAYER_GROUPS 4

// A stored depth runs from 0 (near) to VT_DEPTH_SCALE (far) in 16 bits; VT_DEPTH_NONE marks "no surface".
#define VT_DEPTH_SCALE 65534.0
#define VT_DEPTH_NONE 65535u

// Light that left a path is followed where its share is at least this; less of it comes from the environment.
#define VT_LEAST_BRANCH 0.004

// Packed normal of a texel without a surface: packSnorm2x16 never gives -32768.
#define VT_NO_NORMAL 0x80008000u

#define VT_NO_TRIANGLE 0xffffffffu

// Records of hierarchies (src/mesh/hierarchy.h) lie in a texture so many to a row; four texels each. Groups of siblings
// that may wait on a search's way down.
#define VT_RECORD_WORDS 16
#define VT_RECORDS_A_ROW 512
#define VT_HIERARCHY_STACK 10

// Nodes of the tree of objects (src/gl/object_tree.h): so many a row, two texels each.
#define VT_OBJECT_NODES_A_ROW 512

// The table of objects (src/gl/scene_buffer.h): RGBA32UI texels, a row of them each. Numbers are the bits of floats.
#define VT_OBJECT_TEXELS 16
#define VT_OBJECT_TRANSFORM 0   // three: rows of the matrix from the world to its own coordinates
#define VT_OBJECT_GRID_LOW 3    // where the grid of its hierarchy begins, own units; number of its first record
#define VT_OBJECT_GRID_SCALE 4  // grid steps a unit; 1 where both sides of its surface count
#define VT_OBJECT_LOW 5         // its box, world; its diagonal
#define VT_OBJECT_HIGH 6        // its box, world; layered: number of its layers
#define VT_OBJECT_GLASS 7       // index of refraction, absorption a unit of length (red, green, blue)
#define VT_OBJECT_COLOR 8       // tint or base colour; number of its first attribute record, or VT_NO_TRIANGLE
#define VT_OBJECT_SURFACE 9     // metallic, roughness, checker squares a unit of texture coordinates; number of the first
                                // object of its body
#define VT_OBJECT_EMISSIVE 10   // light of its own; number of its material in the table of materials
#define VT_OBJECT_IMAGES 11     // layers of its base colour and metallic-roughness image, or VT_NO_TRIANGLE; number of
                                // its first record of more attributes, or that; dispersion
#define VT_OBJECT_FRUSTUM 12    // layered: tangents of its layers' frustum, left, bottom, right, top
#define VT_OBJECT_DEPTHS 13     // layered: of that frustum: near, far, 1 / (far - near); 0
#define VT_OBJECT_OWN_LOW 14    // box of its mesh, own coordinates; 1 where it is searched by its heights
#define VT_OBJECT_OWN_HIGH 15   // the same; side of a cell of those heights

// Attribute records: a texel a corner of a record that is a leaf, as many records a row: texture coordinates (bits of
// floats), colour and alpha (four halves). Records of more attributes lie among them: the second texture coordinates,
// tangent (octahedral), 1 where pictures are mirrored on it.

// The table of materials (src/gl/material_table.h), for scenes whose materials are not plain: RGBA32UI texels, so many
// to a row. The first row: number of lights, number of rows before the first material; then the lights, three each.
// Then materials, VT_MATERIAL_TEXELS each. Numbers are the bits of floats.
#define VT_MATERIAL_COLUMNS 512
#define VT_MATERIAL_TEXELS 32
#define VT_MOST_LIGHTS 64
#define VT_MATERIAL_FLAGS 0     // bits: below; alpha, its cutoff (0 without mask), transmission
#define VT_MATERIAL_COLOR 1     // tint or base colour; metallic
#define VT_MATERIAL_EMISSIVE 2  // light of its own; roughness
#define VT_MATERIAL_SPECULAR 3  // specular colour; specular
#define VT_MATERIAL_FILM 4      // iridescence, its index, least and greatest thickness in nanometres
#define VT_MATERIAL_SCALES 5    // of the normal map, of occlusion; checker squares; 0
#define VT_MATERIAL_MAPS 8      // two each, by vtMapUse: layer and flags, or VT_NO_TRIANGLE, offset, size of the picture in
                                // pixels, 16 bits each; two rows of the matrix
#define VT_LOOK_THIN 1u
#define VT_LOOK_UNLIT 2u
#define VT_LOOK_MIRROR 4u       // index 0: reflects everything
#define VT_LOOK_BLEND 8u        // alpha is a share
// Flags of a map, above its layer's 16 bits: the second texture coordinates; squares; how x and y go on (vtWrap).
#define VT_MAP_SECOND 0x10000u
#define VT_MAP_NEAREST 0x20000u
#define VT_MAP_WRAP_X 18
#define VT_MAP_WRAP_Y 20

// The ground (src/light/ground.h): texels along a side of its map; directions that stand for a light, 64 x 64 texels a list
// of them; shade rays start so far below it, of the scene's diagonal.
#define VT_GROUND_SIDE 512
#define VT_GROUND_SAMPLES 4096
#define VT_GROUND_BELOW 0.001
// Of photons of one wavelength: more than their colours have (shaders_es3/exact/spectral.glsl).
#define VT_PHOTON_MOST 5.0

// Light that glass bends onto opaque things (src/light/caustics.h): RGBA32UI texels, so many a row. The first: slots of the
// table. Two a slot: object + 1 (0: free), triangle, sides of its lattice, number of its first sample; its window (low i
// and j, width, height) or, of one side, the samples of its corners. Then two a sample, irradiance on either side of the
// triangle (bits of floats). A triangle's slot is so many after its hash at most.
#define VT_CAUSTIC_COLUMNS 1024
#define VT_CAUSTIC_PROBES 32
