// SPDX-License-Identifier: MIT

/// Vitrine: real-time glass through OpenGL ES 3.0.
///
/// This header alone is enough to embed the renderer. The order of use:
///
///   1. make an OpenGL ES 3.0, WebGL 2 or desktop GL 3.3+ context current (the caller's work);
///   2. vtCreateRenderer;
///   3. a scene (vtLoadScene, or vtCreateMeshScene of a mesh)   -> vtRenderer_SetScene;
///   4. an environment (vtCreateEnvironment, vtLoadEnvironment) -> vtRenderer_SetEnvironment;
///   5. vtFrame frame = vtDefaultFrame(); frame.view = ...;       vtRenderer_Draw;
///   6. vtDestroyRenderer, with the same context current.
///
/// Conventions: right-handed world, +Y up, lengths in the model's own unit. Structs are plain data; a
/// struct from vtDefault... holds the documented defaults. A function that can fail returns a vtResult and
/// writes one sentence into the vtError. Misuse is such a failure, too: NULL, numbers out of range, structs
/// that are zeroed or destroyed give vt_errorArgument or what the function documents; a function without a
/// result does nothing then, or returns something neutral. Pointers to memory that is gone, and arrays
/// shorter than their counts say, are beyond what is noticed. Nothing here keeps a pointer of the caller's
/// after it returns, but for vtPreparation and vtTracer. Nothing is printed. There is no global state but
/// vtSetAllocator's: many renderers can live side by side, each used with its own context.
///
/// Threads: the library starts none and locks nothing. Any functions may run at the same time in several
/// threads as long as what one of them changes (a pointer to what is not const) is not used by another. So
/// several may read one mesh, scene or environment, or trace paths by one vtTracer, which vtTracer_Path does
/// not change; vtPreparation_Step changes the scene. A vtRenderer is used by one thread at a time, that in
/// which its context is current; renderers of different contexts do not know of each other. A vtError is for
/// one thread. Functions of the caller's (vtAllocator, vtReadFileFcn, vtStageFcn) are called in the thread
/// that called the library. vtSetAllocator is called while no other thread is in the library.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "vitrine_limits.h" // VT_MAX_LAYERS and the other limits, shared with the shaders

#ifdef __cplusplus
extern "C" {
#endif

/// Before a function that a shared library exports.
#ifdef __GNUC__
#define VT_API __attribute__((visibility("default")))
#else
#define VT_API
#endif

#define VT_VERSION_MAJOR 0
#define VT_VERSION_MINOR 1
#define VT_VERSION_PATCH 0
#define VT_VERSION "0.1.0"

/// VT_VERSION of the library that is linked; the macros are this header's.
VT_API const char* vtVersion(void);

// ---------------------------------------------------------------------------------------------- errors

typedef enum vtResult {
    vt_ok = 0,
    vt_errorArgument, ///< a value is outside its documented range
    vt_errorFile,     ///< a file cannot be read or written
    vt_errorFormat,   ///< a file is not what it should be
    vt_errorGeometry, ///< the mesh cannot be drawn (no triangles, bad indices, NaN)
    vt_errorContext,  ///< the GL context is missing, too old, or failed
    vt_errorMemory,   ///< an allocation failed, or would go beyond vtLimits
} vtResult;

/// Why a call failed: one sentence that names the thing, the value and the remedy. Every function that
/// takes a vtError* accepts NULL.
typedef struct vtError {
    vtResult result;
    char message[1024];
} vtError;

// ---------------------------------------------------------------------------------------------- memory

/// Where the library's memory comes from. All three are needed; userData is passed to each. They may be
/// called by every thread that calls the library.
typedef struct vtAllocator {
    void* (*allocate)(size_t size, void* userData);                 ///< as malloc; size is never 0
    void* (*reallocate)(void* memory, size_t size, void* userData); ///< as realloc; neither is ever 0
    void (*free)(void* memory, void* userData);                     ///< memory is never NULL
    void* userData;
} vtAllocator;

/// Takes the memory of the library, and of its files' decoders, from `allocator`, which is copied; NULL: from
/// malloc, realloc and free, as without this call. What vtLoadScene needs only while it runs comes from
/// operator new as well. This is the one setting of the whole process: call it before anything else is
/// called, and never while something lives that was allocated. Fails with vt_errorArgument where a function
/// is NULL.
VT_API vtResult vtSetAllocator(const vtAllocator* allocator, vtError* error);

/// count * size bytes for what the library shall free: contents of files (vtReadFileFcn), and arrays that a
/// caller puts into a vtMesh, vtScene, vtImage or vtEnvironment. NULL where memory is out or the product is
/// more than size_t can hold.
VT_API void* vtAllocate(size_t count, size_t size);

/// Frees what vtAllocate or the library gave. Safe on NULL.
VT_API void vtFree(void* memory);

// ---------------------------------------------------------------------------------------------- limits

/// What one file may ask for, however few bytes it has itself. Numbers that it declares are added up before
/// memory is taken for them; what would go beyond fails at once, with a sentence that names the limit. They
/// are estimates from above of what is kept, not of what the process holds. 0, as in {0}: the default.
typedef struct vtLimits {
    /// Bytes of all that is read, unpacked and decoded of a file together; a 32nd of it for the structure of
    /// its JSON. Default 4 GiB, 2 GiB where addresses have 32 bits
    uint64_t memory;
    uint64_t triangles; ///< of the meshes of a model, each counted once. Default 50,000,000
    uint64_t pixels;    ///< of one picture; more than 16384 x 8192 are never read. Default 8192 x 8192
} vtLimits;

/// The defaults.
VT_API vtLimits vtDefaultLimits(void);

// ------------------------------------------------------------------------------------------------ mesh

typedef struct vtVec3 {
    float x, y, z;
} vtVec3;

/// Triangles as the caller has them.
typedef struct vtMeshDef {
    const float* positions; ///< 3 * vertexCount, finite
    const float* normals;   ///< 3 * vertexCount, outward, need not be unit; NULL: computed (see vtCreateMesh)
    const uint32_t* indices; ///< indexCount, counter-clockwise seen from outside; NULL: 0, 1, 2, ...
    uint32_t vertexCount;
    uint32_t indexCount;       ///< a multiple of 3
    const float* texcoords;    ///< 2 * vertexCount, (0, 0) the picture's upper left corner; NULL: none
    const float* colors;       ///< 3 * vertexCount, linear, 0 to 1; NULL: white
    const uint16_t* indices16; ///< in place of `indices`; NULL: none
    /// Bytes from a vertex's numbers to the next one's, a multiple of 4 and at least those numbers' own; 0:
    /// their own, so that they lie side by side.
    uint32_t positionStride, normalStride, texcoordStride, colorStride;
    const float* texcoords1; ///< a second set, 2 * vertexCount, side by side; NULL: none
    const float* alphas;     ///< of the colours, vertexCount, 0 to 1, side by side; NULL: 1
    /// For normal maps: 4 * vertexCount, side by side: unit, along rising u, and 1 or -1, which times normal
    /// x tangent is up in the picture, where v falls. NULL: vtComputeTangents
    const float* tangents;
} vtMeshDef;

/// A validated triangle mesh. Read it freely; change it only through the functions below.
typedef struct vtMesh {
    float* positions;  ///< 3 * vertexCount
    float* normals;    ///< 3 * vertexCount, unit length
    uint32_t* indices; ///< indexCount
    uint32_t vertexCount;
    uint32_t indexCount;
    vtVec3 boundsMin, boundsMax;
    double volume; ///< that the surface encloses, negative where its triangles face inwards; of an open one,
                   ///< that its triangles would with a point
    bool normalsComputed;   ///< the input had no normals (or some of zero length)
    uint32_t openEdgeCount; ///< edges, over welded positions, without an opposite twin; 0: closed
    /// For technique `wyman`: distance from each vertex inwards along its normal to the next surface,
    /// vertexCount numbers, or NULL (vtComputeInnerDistances).
    float* innerDistances;
    uint32_t degenerateCount; ///< triangles of no area, kept in the count above but never visible
    float* texcoords;         ///< 2 * vertexCount, or NULL
    float* colors;            ///< 3 * vertexCount, linear, or NULL
    float* alphas;            ///< vertexCount, or NULL
    float* texcoords1;        ///< 2 * vertexCount, or NULL
    float* tangents;          ///< 4 * vertexCount, or NULL
    struct vtHeightField*
        heights; ///< of a relief, which has no triangles before vtTriangulateRelief; or NULL
    struct vtHierarchy* hierarchy; ///< over the triangles (vtBeginPreparation), or NULL
    uint32_t updates;              ///< how often vtMesh_Update has moved its vertices
} vtMesh;

/// Copies and checks triangles. Missing normals are computed as angle-weighted means over welded
/// positions (Thurmer & Wuthrich 1998), which is what the truth images of the tests use.
/// Fails with vt_errorGeometry for no triangles, an index out of range, or a NaN or infinite number, with
/// vt_errorArgument for a stride that is none or both kinds of indices.
/// `name` goes into the error sentence. On failure *mesh is zeroed.
VT_API vtResult vtCreateMesh(const vtMeshDef* def, const char* name, vtMesh* mesh, vtError* error);

/// Fills mesh->innerDistances (Wyman 2005's d_N) by tracing a ray from each vertex; 0 where it meets nothing.
/// Does nothing where they are there already. About a second for 100,000 triangles.
VT_API vtResult vtComputeInnerDistances(vtMesh* mesh, vtError* error);

/// Fills mesh->tangents from texture coordinates of that set, 0 or 1, as normal maps are made for (Mikkelsen
/// 2008). Does nothing where they are there already, or the mesh lacks these coordinates.
VT_API vtResult vtComputeTangents(vtMesh* mesh, int texcoords, vtError* error);

/// One of the built-in shapes: sphere torus knot goblet bottle diamond cube plane tumbler water panel; all
/// but the plane are closed and outward. Tumbler and water fit one in the other. Fails with vt_errorArgument
/// for another name.
VT_API vtResult vtCreateShape(const char* name, vtMesh* mesh, vtError* error);

#define VT_MIN_PANEL 0.001f
#define VT_MAX_PANEL 1e6f

/// A pane about the origin that faces +z, with numbers as CSS has them of a box, in any unit.
typedef struct vtPanelDef {
    float width, height; ///< VT_MIN_PANEL to VT_MAX_PANEL. Default 2, 1.25
    float radius; ///< of its corners, 0 to VT_MAX_PANEL, at most half of the shorter side. Default 0.25
    /// How far in its edges are rounded, 0 to VT_MAX_PANEL, at most half of the shorter side; and down, at
    /// most half of the thickness. Default 0.12
    float bevel;
    float thickness; ///< VT_MIN_PANEL to VT_MAX_PANEL. Default 0.25
} vtPanelDef;

VT_API vtPanelDef vtDefaultPanelDef(void);

/// The shape `panel` of those numbers: closed, normals smooth where its edges are rounded. Fails with
/// vt_errorArgument for a number out of its range, and with vt_errorMemory.
VT_API vtResult vtCreatePanel(const vtPanelDef* def, vtMesh* mesh, vtError* error);

/// Names of the built-in shapes, by index; NULL past the end. `vtShapeSummary` says what each is.
VT_API const char* vtShapeName(int index);
VT_API const char* vtShapeSummary(int index);

/// Moves a mesh's vertices: new positions and normals, 3 * vertexCount each; normals NULL: computed. Its
/// hierarchy, where it has one, is refitted, or built anew where the moves have made it half as costly again
/// as it was; bounds follow, inner distances and a relief's heights go. A mesh with triangles of no area is
/// always built anew: they may get one. vtRenderer_UpdateGeometry draws it so. Fails with vt_errorGeometry
/// for a NaN or infinite number or a mesh without triangles, the mesh as it was. After vt_errorMemory the
/// mesh is to be updated again or destroyed.
VT_API vtResult vtMesh_Update(vtMesh* mesh, const float* positions, const float* normals, vtError* error);

/// Frees what the mesh holds and zeroes it. Safe on NULL and on a zeroed mesh.
VT_API void vtDestroyMesh(vtMesh* mesh);

// ---------------------------------------------------------------------------------------------- relief

typedef struct vtHeightField vtHeightField;

#define VT_MAX_RELIEF_SIDE 4096

/// A slab of glass whose front is a height field. It faces +z, is centred on the z axis, its longer side is 2
/// and its cells are square; height 0 lies at z = 0.
typedef struct vtReliefDef {
    const float* heights; ///< width * height, top row first; vtCreateRelief only
    int width, height;    ///< samples, 2 to VT_MAX_RELIEF_SIDE; vtLoadRelief knows them itself
    float depth;          ///< what height 1 stands for, 0 (flat) to 10; default 0.1
    float thickness; ///< of the slab behind height 0, or behind the lowest if that is lower, 0.001 to 10;
                     ///< default 0.1
    /// Standard deviation of a Gaussian that the heights are smoothed with, samples, 0 (not at all) to 64.
    /// -1, the default: 0, but 2 for pictures of 8 bits, whose 256 heights are steps that glass shows;
    /// vtLoadRelief only.
    float smoothing;
} vtReliefDef;
VT_API vtReliefDef vtDefaultRelief(void);

/// A mesh of these heights. It has bounds, but no triangles: technique `heightfield` needs none, the others
/// do (vtTriangulateRelief). Fails with vt_errorGeometry or vt_errorArgument for numbers out of range; `name`
/// goes into the sentence. On failure *mesh is zeroed.
VT_API vtResult vtCreateRelief(const vtReliefDef* def, const char* name, vtMesh* mesh, vtError* error);

/// The same of a file held in memory: .png or .jpg of 8 or 16 bits, black 0 and white 1, colours by their
/// luma; .hdr or .pfm, the least number 0 and the greatest 1. A build for web pages decodes the last two
/// only.
VT_API vtResult vtLoadRelief(const void* bytes, size_t size, const char* name, const vtReliefDef* def,
                             vtMesh* mesh, vtError* error);

/// The same of a built-in pattern: ripples hammered fluted lens-array. def->width and height are its samples;
/// 0: 512.
VT_API vtResult vtCreateReliefPattern(const char* name, const vtReliefDef* def, vtMesh* mesh, vtError* error);

/// Names of the patterns, by index; NULL past the end.
VT_API const char* vtReliefPatternName(int index);
VT_API const char* vtReliefPatternSummary(int index);
/// The depth at which the pattern looks as such glass is made.
VT_API float vtReliefPatternDepth(int index);

/// Gives a relief its triangles, two a cell of the front; 4096 x 4096 samples are 33.5 million and 1.2 GB.
/// Does nothing where they are there already or the mesh is no relief.
VT_API vtResult vtTriangulateRelief(vtMesh* mesh, vtError* error);

// ----------------------------------------------------------------------------------------------- scene

/// How a picture goes on beyond its sides.
typedef enum vtWrap { vt_wrapRepeat = 0, vt_wrapClamp, vt_wrapMirror } vtWrap;

/// A picture laid over a surface by its texture coordinates.
typedef struct vtMap {
    int image;           ///< in the scene; -1: none
    int texcoords;       ///< which of the mesh's sets, 0 or 1
    vtWrap wrapX, wrapY; ///< default vt_wrapRepeat
    bool nearest;        ///< its pixels stay squares when seen large; else they are blended
    float rows[2][3];    ///< affine: the place in the picture = rows * (u, v, 1). Default: u, v
} vtMap;

/// No picture, and the other defaults.
VT_API vtMap vtDefaultMap(void);

/// What a map says. Colours are sRGB, all else are numbers as they are.
typedef enum vtMapUse {
    vt_mapBaseColor = 0,        ///< times tint or baseColor; its alpha times alpha
    vt_mapMetallicRoughness,    ///< green times roughness, blue times metallic
    vt_mapTransmission,         ///< red times transmission
    vt_mapNormal,               ///< 2 rgb - 1 along tangent, bitangent and normal
    vt_mapOcclusion,            ///< red: share of the environment that matt and glossy surfaces see
    vt_mapEmissive,             ///< colour, times emissive
    vt_mapSpecular,             ///< alpha times specular
    vt_mapSpecularColor,        ///< colour, times specularColor
    vt_mapIridescence,          ///< red times iridescence
    vt_mapIridescenceThickness, ///< green: the film's thickness
    vt_mapCount,
} vtMapUse;

/// Whether a surface is there.
typedef enum vtAlpha {
    vt_alphaOpaque = 0, ///< everywhere
    vt_alphaMask,       ///< where its alpha is alphaCutoff or more
    vt_alphaBlend,      ///< a share of alpha
} vtAlpha;

/// What an object is made of, as glTF 2.0 and its extensions KHR_materials_... mean it. Colours are linear,
/// 0 to 1 unless said otherwise. Techniques other than `exact` and `heightfield` look at opaque, ior, tint
/// and attenuation of glass, and of opaque things at baseColor, metallic, roughness, emissive, checker and
/// the first two of the maps.
typedef struct vtMaterial {
    bool opaque; ///< else glass
    /// Glass: a wall without thickness. Light goes straight on; there is nothing inside. Default false: a
    /// body
    bool thin;
    bool unlit;    ///< opaque: shows its base colour as it is
    bool oneSided; ///< opaque, and no relief: rays pass through its triangles from behind. Default false
    float ior;   ///< index of refraction, 0.25 to 4, or 0: reflects everything. Glass that has less than what
                 ///< is around it is a bubble. Default 1.5
    vtVec3 tint; ///< glass: share of the light that passes a surface (base colour of glTF). Default 1, 1, 1
    float transmission; ///< glass: 0 to 1, share that passes; the rest is matt, coloured by tint. Default 1
    /// Glass: what is left of white light after attenuationDistance in it (KHR_materials_volume; t = T^d of
    /// Kay & Greenberg 1979, equation 6). World units; 0: nothing is absorbed. Default 1, 1, 1 and 0.
    vtVec3 attenuationColor;
    float attenuationDistance;
    vtVec3 baseColor;  ///< opaque. Default 0.8, 0.8, 0.8
    float metallic;    ///< 0 to 1. Default 0
    float roughness;   ///< 0 to 1: alpha of GGX is its square; below 0, the default: 1 of opaque things, 0 of
                       ///< glass, where only some techniques draw it
    vtVec3 emissive;   ///< light of its own, 0 and above. Default 0
    vtAlpha alphaMode; ///< default vt_alphaOpaque
    float alpha, alphaCutoff;          ///< 0 to 1. Default 1 and 0.5
    float specular;                    ///< 0 to 1: share of what it reflects at its surface. Default 1
    vtVec3 specularColor;              ///< of that, seen straight on, 0 and above. Default 1, 1, 1
    float iridescence, iridescenceIor; ///< a film: its share, 0 to 1, and index, 1 and above. Default 0, 1.3
    float iridescenceMin, iridescenceMax; ///< its thickness where its map is 0 and 1, nanometres. Default
                                          ///< 100, 400; without a map it is the latter
    /// 20 over the Abbe number of the index (KHR_materials_dispersion), 0 and above: the index at a
    /// wavelength of L nanometres is ior + (ior - 1) dispersion / 20 (523655 / L^2 - 1.5168). Only some
    /// techniques draw it. Default 0
    float dispersion;
    float normalScale, occlusionStrength; ///< of their maps. Default 1
    vtMap maps[vt_mapCount];              ///< by vtMapUse; default: no picture
    float checker; ///< opaque: squares along a unit of texture coordinates, alternately dark; 0, the default:
                   ///< none
} vtMaterial;

/// A picture for materials: decoded, or still as the file has it.
typedef struct vtImage {
    uint8_t* pixels; ///< RGBA, 4 * width * height, top row first; NULL: not decoded, drawn as white
    int width, height;
    bool linear;    ///< numbers (metallic and roughness), not colours; only vtRenderer_SetImages looks at it
    uint8_t* bytes; ///< a .png or .jpg, where this build cannot decode it (web pages); else NULL
    size_t size;
} vtImage;

/// Affine: world = rows * (x, y, z, 1).
typedef struct vtTransform {
    float rows[3][4];
} vtTransform;

/// A mesh in its place. Objects that share a mesh share all memory of it.
typedef struct vtObject {
    uint32_t mesh, material; ///< in the scene
    vtTransform toWorld;     ///< invertible
    /// Where objects of glass overlap, there is the material of the one of highest priority; of equal ones,
    /// that of the object of least volume, so that what lies wholly inside another replaces it. Default 0.
    int priority;
    char name[64]; ///< for sentences
    /// Objects of glass of the same number bound one body together, whose inside is of the first one's
    /// material. 0, the default: it is a body by itself
    uint32_t body;
} vtObject;

typedef enum vtLightKind { vt_lightPoint = 0, vt_lightSpot, vt_lightDirectional } vtLightKind;

/// A light without size (KHR_lights_punctual): it lights opaque things and the ground, with shadows, and
/// is seen in glass as a highlight.
typedef struct vtLight {
    vtLightKind kind;
    vtVec3 position;
    vtVec3 direction;           ///< that its light goes, unit; of a point's none
    vtVec3 color;               ///< linear, times its intensity: candela, of a directional one lux
    float range;                ///< beyond which it gives nothing; 0: without end
    float innerCone, outerCone; ///< spot: radians from its direction where it begins to fade and has faded
} vtLight;

/// Objects, and what they are made of. Owns all its memory.
typedef struct vtScene {
    vtMesh* meshes; ///< in their own coordinates
    vtMaterial* materials;
    vtImage* images;
    vtObject* objects;
    struct vtSceneCamera* cameras; ///< of the files
    vtLight* lights;               ///< 64 of them at most are drawn
    uint32_t meshCount, materialCount, imageCount, objectCount, cameraCount, lightCount;
    bool allGlass; ///< the file said of none of its materials that it is glass, so all were made glass
    char* notes;   ///< what of the files is left out or changed, a line each; NULL: nothing
} vtScene;

VT_API vtMaterial vtDefaultMaterial(void);
VT_API vtTransform vtIdentityTransform(void);

/// A scene of one object. Takes the mesh over (and zeroes *mesh) unless it fails, with vt_errorMemory.
VT_API vtResult vtCreateMeshScene(vtMesh* mesh, const vtMaterial* material, vtScene* scene, vtError* error);

/// Adds to a scene, {0} to begin with: a mesh, which the scene takes over (and *mesh is zeroed) unless it
/// fails; a material; an object of meshes and materials that are there. *index: its number; of an object NULL
/// will do. Fails with vt_errorMemory or vt_errorArgument, the scene as it was.
VT_API vtResult vtScene_AddMesh(vtScene* scene, vtMesh* mesh, uint32_t* index, vtError* error);
VT_API vtResult vtScene_AddMaterial(vtScene* scene, const vtMaterial* material, uint32_t* index,
                                    vtError* error);
VT_API vtResult vtScene_AddObject(vtScene* scene, const vtObject* object, uint32_t* index, vtError* error);

/// Moves all that `other` has into the scene, its objects placed by `transform`, and zeroes it; cameras are
/// kept as they are. On failure (vt_errorMemory, or vt_errorArgument where both are one or have more than
/// 2^31 of something) both stay as they were.
VT_API vtResult vtScene_Append(vtScene* scene, vtScene* other, const vtTransform* transform, vtError* error);

/// Fails with vt_errorGeometry and a sentence where the scene cannot be drawn: no object, a scale of zero, a
/// mesh, material or image that is not there, a mesh without triangles or heights, numbers out of their
/// range. vtRenderer_SetScene does it, too.
VT_API vtResult vtValidateScene(const vtScene* scene, vtError* error);

typedef enum vtWalls { vt_wallsAuto = 0, vt_wallsThin, vt_wallsSolid } vtWalls;
/// "auto", "thin", "solid"; NULL past the end.
VT_API const char* vtWallsName(int index);
/// Makes all glass of a scene thin walls or solid bodies, for files that say it wrongly; auto: as it is.
VT_API void vtScene_SetWalls(vtScene* scene, vtWalls walls);

/// The scene's box in world coordinates: of its glass, or of all where it has none; zeros without an object.
VT_API void vtScene_Bounds(const vtScene* scene, vtVec3* boundsMin, vtVec3* boundsMax);

/// Frees what the scene holds and zeroes it. Safe on NULL and on a zeroed scene.
VT_API void vtDestroyScene(vtScene* scene);

/// Reads a whole file of at most `limit` bytes for the scene loader (buffers and pictures beside a .gltf). On
/// success *bytes are from vtAllocate (or NULL of 0 bytes), and the loader frees them by vtFree. On failure
/// (vt_errorMemory where the file is larger) the sentence in *error, if any, becomes a part of the loader's.
/// The path is that of a file in the model's folder or in vtModelDef.root by its name; where links lead, and
/// that it is a plain file, is for the function to look at.
typedef vtResult vtReadFileFcn(const char* path, size_t limit, uint8_t** bytes, size_t* size, void* userData,
                               vtError* error);

typedef struct vtModelDef {
    const void* bytes; ///< the contents of a .glb or .gltf file
    size_t size;
    const char* name;        ///< for error sentences, usually the path
    const char* directory;   ///< of the model; NULL or "": the current one
    const char* root;        ///< a folder around it, whose files the model may name as well, as ../a.png;
                             ///< absolute if `directory` is; NULL: none
    vtReadFileFcn* readFile; ///< NULL: files beside the model are an error
    void* userData;          ///< passed to readFile
    const char* variant;     ///< of KHR_materials_variants, by its name; NULL: the materials as they are
    vtLimits limits;         ///< of the file together with those beside it; {0}: the defaults
} vtModelDef;

/// Loads glTF 2.0 (through tinygltf); docs/gltf.md lists what is drawn. Everything that can be wrong with a
/// file gives a sentence. Materials with KHR_materials_transmission are glass; where the file has none such,
/// all of them are made glass of their index of refraction. Primitives of one glTF mesh with the same
/// material make one mesh; nodes that share it are instances. Everything stands as its nodes say:
/// vtOpenModel plays animations. On failure *scene is zeroed.
VT_API vtResult vtLoadScene(const vtModelDef* def, vtScene* scene, vtError* error);

/// A file that is kept for its animations: what they move, not its bytes. It moves one scene, that which was
/// loaded with it.
typedef struct vtModel vtModel;

/// Loads as vtLoadScene does, everything at rest, and keeps *model for vtModel_SetTime. Fails for an
/// animation that is damaged, too. On failure *scene is zeroed and *model NULL.
VT_API vtResult vtOpenModel(const vtModelDef* def, vtModel** model, vtScene* scene, vtError* error);
/// The scene stays. Safe on NULL.
VT_API void vtCloseModel(vtModel* model);

typedef struct vtAnimation {
    const char* name; ///< as the file has it, maybe ""; lives as long as the model
    double duration;  ///< seconds from 0 to its last key
} vtAnimation;
/// By number, from 0; NULL past the end.
VT_API const vtAnimation* vtModel_Animation(const vtModel* model, int index);

/// Where a model's scene lies in another one: the numbers of its first mesh, material, ... there, and the
/// transform of vtScene_Append.
typedef struct vtModelPlace {
    uint32_t mesh, material, object, camera, light;
    vtTransform toWorld;
} vtModelPlace;
/// That of what vtScene_Append adds next with this transform; NULL: as it is.
VT_API vtModelPlace vtScene_NextPlace(const vtScene* scene, const vtTransform* transform);

/// Moves the model's objects, cameras, lights, vertices (vtMesh_Update) and numbers of materials to where the
/// animation has them at a time: as at its ends before and after it. To play round and round is the caller's
/// work: fmod(seconds, duration). animation -1: at rest. place: where in the scene the model lies; NULL: the
/// scene is as it was loaded. vtRenderer_UpdateScene draws it so. Samplers are interpolated as glTF 2.0 has
/// it (appendix C); what is scaled to nothing becomes as small as can be drawn. Fails with vt_errorArgument
/// for an animation or a scene that does not fit, vt_errorGeometry where nodes make something flat or too
/// large; then a part of the scene may have moved, which another time sets right.
VT_API vtResult vtModel_SetTime(vtModel* model, int animation, double seconds, const vtModelPlace* place,
                                vtScene* scene, vtError* error);

/// A kind of glass, by its numbers at the yellow line of helium (587.6 nm).
typedef struct vtGlassInfo {
    const char* name;
    float ior;          ///< n_d
    float abbe;         ///< V_d = (n_d - 1) / (n_F - n_C); vtMaterial.dispersion is 20 over it
    const char* source; ///< of the numbers; "" in builds for web pages
} vtGlassInfo;
/// water crown flint sapphire zircon diamond moissanite, by index; NULL past the end.
VT_API const vtGlassInfo* vtGlass_Info(int index);
/// By name; NULL where there is none such.
VT_API const vtGlassInfo* vtFindGlass(const char* name);

// ----------------------------------------------------------------------------------------- environment

typedef enum vtEnvironmentKind {
    vt_environmentChecker = 0, ///< the checker of the test conventions
    vt_environmentStudio,      ///< soft boxes in a dark room
    vt_environmentSky,         ///< sky, sun and ground
    vt_environmentImage,       ///< an equirectangular picture
} vtEnvironmentKind;

/// What surrounds the glass, infinitely far away. Linear radiance, Rec. 709 primaries.
/// Equirectangular: u = 0.5 + atan2(d.z, d.x) / 2pi, v = 0.5 + asin(d.y) / pi, v = 1 the top row.
typedef struct vtEnvironment {
    vtEnvironmentKind kind;
    float* pixels; ///< 3 * width * height, top row first; NULL unless kind is vt_environmentImage
    int width, height;
} vtEnvironment;

/// A built-in environment by name: checker studio sky. Evaluated per pixel, crisp at any resolution.
VT_API vtResult vtCreateEnvironment(const char* name, vtEnvironment* environment, vtError* error);
VT_API const char* vtEnvironmentName(int index);
VT_API const char* vtEnvironmentSummary(int index);

/// Decodes a picture held in memory, told by its contents: Radiance HDR, OpenEXR or PFM (linear), PNG, JPEG
/// or WebP (sRGB, converted to linear); for the web only the first and PFM. It is equirectangular, or one of
/// a cube's six faces, of which an equirectangular one is made: a strip of 6:1 or 1:6 in OpenGL's order, or a
/// cross of 4:3 or 3:4 whose middle is seen along -Z.
VT_API vtResult vtLoadEnvironment(const void* bytes, size_t size, const char* name,
                                  vtEnvironment* environment, vtError* error);

/// The same within other limits than the defaults; NULL: those. Fails with vt_errorFormat for too many pixels
/// and vt_errorMemory for too much memory.
VT_API vtResult vtLoadEnvironmentWithin(const void* bytes, size_t size, const char* name,
                                        const vtLimits* limits, vtEnvironment* environment, vtError* error);

/// The same of pixels that are decoded already: 8-bit sRGB, RGBA, top row first; alpha is not looked at.
VT_API vtResult vtCreateImageEnvironment(const uint8_t* rgba, int width, int height, const char* name,
                                         vtEnvironment* environment, vtError* error);

/// Radiance arriving from a unit direction; the same numbers as the shaders give. Black of none.
VT_API vtVec3 vtEnvironment_Sample(const vtEnvironment* environment, vtVec3 direction);
/// Frees what it holds and zeroes it. Safe on NULL and on a zeroed one.
VT_API void vtDestroyEnvironment(vtEnvironment* environment);

// ---------------------------------------------------------------------------------------------- ground

/// A level plane, without end, that the scene stands on. It is seen from above, directly, through glass and
/// in reflections, by techniques `exact` and `heightfield`. Light comes to it from the upper half of the
/// environment, from a sun and from the scene's lights. It shows what the scene does to that light: shadows,
/// and caustics, which are light that glass bends or reflects (docs/method.md, "The ground"). Sun and lights
/// do the same to the scene's opaque things.
typedef struct vtGround {
    /// World y, at or below the lowest point of the scene. NAN, the default: that point
    float height;
    /// False, the default: what is seen at the ground is the environment there, times the light that the
    /// ground has over the light that it would have alone. True: a matt surface of `color`
    bool matt;
    vtVec3 color;          ///< linear, 0 to 1. Default 0.8, 0.8, 0.8
    float shadowIntensity; ///< 0 (as if nothing stood there) to 1, the default: all of what the scene does
    float shadowSoftness;  ///< 0, the default: as the lights are wide; to 1: blurred over a tenth of the map
    /// Towards the sun, any length above 0. Its y must be above 0. 0, 0, 0, the default: the environment's
    /// own sun, if it has one: what is bright about its brightest place and small
    vtVec3 sunDirection;
    float sunSize;   ///< of a sun that is given: its diameter, degrees, 0 to 90. Default 0.53
    vtVec3 sunColor; ///< the same: irradiance of a surface that faces it, linear, 0 and above, in the unit of
                     ///< the environment's radiance times steradians. Default 3, 3, 3
} vtGround;

VT_API vtGround vtDefaultGround(void);

/// Fails with vt_errorArgument and a sentence that names field, value and range.
VT_API vtResult vtValidateGround(const vtGround* ground, vtError* error);

// -------------------------------------------------------------------------------------------- backdrop

/// A picture that stands behind the scene, across the view, so that glass shows it bent: what a page has
/// under an element of glass. A ray that has left the glass meets it at its true place; one that turns back
/// meets the environment, which goes on being what glass reflects. It fills the frame where it is seen
/// straight, and goes with the view. Its colours are shown as they are: neither exposure nor tone mapping
/// changes them.
typedef struct vtBackdrop {
    /// Behind the view's target, in units of the scene, 0 to 1000000; with matrices, behind the middle of the
    /// glass. 0, the default: beyond all glass, by an eighth of its box's diagonal
    float distance;
    /// Left, top, right and bottom of the part of the picture that fills the frame, as shares of its sides;
    /// below 0 and above 1 it is mirrored. 0, 0, 0, 0, the default: the largest part of the frame's shape, in
    /// the middle, like object-fit: cover
    float part[4];
} vtBackdrop;

VT_API vtBackdrop vtDefaultBackdrop(void);

/// Fails with vt_errorArgument and a sentence that names field, value and range.
VT_API vtResult vtValidateBackdrop(const vtBackdrop* backdrop, vtError* error);

// ------------------------------------------------------------------------------------------------ view

/// A pinhole camera. The field of view is vertical. Pixel (i, j), j = 0 on top, looks along
/// normalize(x*right + y*up + forward), x = ((i+.5)/W*2-1)*tan(fovY/2)*W/H, y = (1-(j+.5)/H*2)*tan(fovY/2).
typedef struct vtView {
    vtVec3 eye;
    vtVec3 target;
    float fovY; ///< degrees, 1 to 170
} vtView;

/// A camera of a file.
typedef struct vtSceneCamera {
    vtView view;              ///< its target lies at the scene's centre's depth
    float orthographicHeight; ///< for vtFrame; 0: it is perspective
    char name[64];            ///< that of its node, else its own; may be empty
} vtSceneCamera;

/// A view that shows the whole mesh with some margin, from slightly above and to the right. `fovY` in
/// degrees, `aspect` is width over height.
VT_API vtView vtViewOfMesh(const vtMesh* mesh, float fovY, float aspect);

/// Turns the eye about the target: `yaw` about +Y, `pitch` upwards, radians; stops short of the poles.
VT_API vtView vtView_Orbit(vtView view, float yaw, float pitch);

/// The same for the scene: its glass and what belongs to it, or all where there is no glass. What is opaque
/// belongs to it unless it is a backdrop: flat and longer than the glass, six times as long and all around
/// it, or sixteen times as long, measured by the diagonals of the boxes. So a lamp is seen whole, and a
/// goblet on a wide floor, or in a room, alone.
VT_API vtView vtViewOfScene(const vtScene* scene, float fovY, float aspect);

/// Moves the eye towards (factor < 1) or away from (factor > 1) the target.
VT_API vtView vtView_Zoom(vtView view, float factor);

// ------------------------------------------------------------------------------------------- rendering

/// From light, after exposure, to what a display can show. The formulas' sources are in
/// src/light/tone_mapping.c.
typedef enum vtToneMapping {
    vt_toneMappingNone = 0, ///< cut at white
    vt_toneMappingNeutral,  ///< Khronos PBR Neutral: colours below 0.76 stay, but for 0.04 of reflection
    vt_toneMappingAces,     ///< a fit of ACES's filmic curve
    vt_toneMappingAgx,      ///< Sobotka's AgX, its base look: bright colours turn pale
    vt_toneMappingCount,
} vtToneMapping;
VT_API const char* vtToneMappingName(int index);    ///< none neutral aces agx; NULL past the end
VT_API const char* vtToneMappingSummary(int index); ///< one line
/// Linear light, Rec. 709 primaries, 0 or more, to linear light from 0 to 1: what the shaders show. sRGB is
/// the next step. Of another tone mapping it is cut at white.
VT_API vtVec3 vtToneMap(vtToneMapping toneMapping, vtVec3 light);

/// What is behind the scene where it is seen directly. Glass goes on showing its environment, whatever is
/// behind it; the edges of what covers a part of a pixel are blended with it.
typedef enum vtBackground {
    vt_backgroundEnvironment = VT_BACKGROUND_ENVIRONMENT,
    vt_backgroundTransparent = VT_BACKGROUND_TRANSPARENT, ///< alpha 0
    vt_backgroundColor = VT_BACKGROUND_COLOR, ///< vtFrame.backgroundColor, whatever exposure and tone mapping
    vt_backgroundBlurred = VT_BACKGROUND_BLURRED, ///< the environment, blurred by vtFrame.backgroundBlur
    vt_backgroundPicture = VT_BACKGROUND_PICTURE, ///< that of vtRenderer_SetBackground, as it is; it fills
                                                  ///< the frame, and what is too long for it is cut off
} vtBackground;

/// The ladder, oldest first.
typedef enum vtTechnique {
    vt_techniqueKayLinear = 0,
    vt_techniqueKayNonlinear,
    vt_techniqueKayThickness,
    vt_techniqueSingle,
    vt_techniqueWyman,
    vt_techniqueOliveira,
    vt_techniqueLayered,
    vt_techniqueExact,
    vt_techniqueHeightField,
    vt_techniqueCount,
} vtTechnique;

/// A row of the technique table, for menus, `vitrine list` and the documentation.
typedef struct vtTechniqueInfo {
    const char* id;      ///< the name on the command line
    const char* summary; ///< one line
    const char* source;  ///< authors and title
    int year;
    bool refracts; ///< false where it only blends
} vtTechniqueInfo;
VT_API const vtTechniqueInfo* vtTechnique_Info(vtTechnique technique); ///< NULL of another

/// The technique of that id, or vt_techniqueCount.
VT_API vtTechnique vtFindTechnique(const char* id);

/// Gives the scene's meshes what a technique needs and they lack: `wyman` inner distances, all but
/// `heightfield` (of the first relief) triangles. *changed (may be NULL): whether there was something. Fails
/// as vtComputeInnerDistances and vtTriangulateRelief do.
VT_API vtResult vtPrepareScene(vtScene* scene, vtTechnique technique, bool* changed, vtError* error);

/// Builds the hierarchies that `exact` searches, which vtRenderer_SetScene builds itself where they are not
/// there, in slices, so that a page or a window goes on meanwhile. The scene must stay as it is until the
/// end. NULL where memory is out, or of NULL.
typedef struct vtPreparation vtPreparation;
VT_API vtPreparation* vtBeginPreparation(vtScene* scene);
/// Does about `work` units, a unit about the look at one triangle (some 50 ns); true once nothing is left to
/// do.
VT_API bool vtPreparation_Step(vtPreparation* preparation, uint32_t work);
/// Ends it, done or not; what has been built stays with the meshes. Fails as building did: vt_errorMemory, or
/// vt_errorGeometry for more triangles than a hierarchy can hold (about 8 million).
VT_API vtResult vtEndPreparation(vtPreparation* preparation, vtError* error);

typedef enum vtOutput {
    vt_outputPicture = VT_OUTPUT_PICTURE,   ///< the glass before its environment, sRGB
    vt_outputAnalysis = VT_OUTPUT_ANALYSIS, ///< path colours: red two refractions, blue more, green where TIR
                                            ///< took part, grey lost
    vt_outputLayerDepth =
        VT_OUTPUT_LAYER_DEPTH, ///< depth of layer `layer`, near white, far dark, background blue
    vt_outputLayerNormal = VT_OUTPUT_LAYER_NORMAL, ///< world-space normal of layer `layer` as 0.5 + 0.5 n
} vtOutput;

/// What a frame's settings are where it says 0: less work for weak GPUs, more accuracy for strong ones.
///
/// |                       | low | medium | high |
/// |-----------------------|-----|--------|------|
/// | layers peeled         | 2   | 4      | 8    |
/// | linear steps          | 25  | 50     | 100  |
/// | events                | 4   | 8      | 8    |
/// | exact: branches       | 0   | 1      | 2    |
/// | exact: wavelengths    | 1   | 3      | 3    |
typedef enum vtPreset { vt_presetLow = 0, vt_presetMedium, vt_presetHigh, vt_presetCount } vtPreset;

/// "low", "medium", "high"; NULL past the end.
VT_API const char* vtPresetName(int index);

/// How `layered` takes several objects of glass.
typedef enum vtMulti {
    vt_multiAny = 0, ///< paths go from object to object as they meet them, and back
    vt_multiOrdered, ///< one object after the other, sorted from the eye (Wang & Chi 2014, section 3.7)
} vtMulti;

/// How `layered` searches the layers along a ray.
typedef enum vtSearch {
    vt_searchSteps = 0, ///< linear steps, then halving (Wang & Chi 2014)
    vt_searchCells,     ///< from cell to cell between texel centres, two triangles a cell and layer
} vtSearch;

/// What `wyman` takes for the back side of an object.
typedef enum vtBackSurface {
    vt_backSecond = 0, ///< the surface behind the first
    vt_backFarthest,   ///< the last one
} vtBackSurface;

#define VT_MAX_SAMPLES 4096

/// `stage`: prepare (sizes, shaders not compiled yet), surface, peel, merge, refract, shade, or in place of
/// these trace; present; those that a frame has, in this order.
typedef void vtStageFcn(const char* stage, void* userData);

/// Everything that decides one picture.
typedef struct vtFrame {
    vtView view;
    /// World units from the picture's lower to its upper edge: rays are parallel then, whatever view.fovY is.
    /// 0 to 2,000,000,000, for techniques that peel no layers. 0, the default: perspective
    float orthographicHeight;
    vtTechnique technique;
    vtOutput output;
    int layer; ///< for the layer outputs: 0 (nearest) to layers - 1
    float ior; ///< index of refraction of all glass, 1 to 4; 0, the default: each object's own
    /// Of all glass, as vtMaterial has them: roughness 0 to 1, dispersion 0 to 20; -1, the default: each
    /// object's own
    float roughness, dispersion;
    bool fresnel; ///< Fresnel reflection; without it paths only refract, or reflect where they must. Default
                  ///< true
    /// exact, Fresnel reflection: how often light that left a path is followed, 1 to VT_MAX_BRANCHES (each
    /// sample a part of it); what leaves the last of them comes from the environment. -1: never; 0, the
    /// default: the preset's
    int branches;
    /// exact, glass that disperses: paths of the first sample of a pixel, 1 to VT_MAX_WAVELENGTHS. 3: red,
    /// green and blue; 2: red, and the other two together; 1: all three together. Paths that go together
    /// see the environment in fringes, what is opaque without. The other samples have 3. 0, the default: the
    /// preset's
    int wavelengths;
    vtMulti multi;   ///< layered, several objects; default vt_multiAny
    vtSearch search; ///< layered; default vt_searchSteps
    vtPreset preset; ///< of the settings that are 0; default vt_presetMedium
    int layers;      ///< depth layers peeled, 1 to VT_MAX_LAYERS; 0, the default: the preset's
    int steps;       ///< linear search steps a segment, 1 to VT_MAX_STEPS; 0, the default: the preset's
    int refine;      ///< binary search steps after them, 0 to VT_MAX_REFINE; default 8
    int maxEvents;   ///< refractions and internal reflections of a path, 1 to VT_MAX_EVENTS; 0, the default:
                     ///< the preset's
    int layerSize;   ///< longer side of the layer textures, texels, 16 to 8192; 0: that of the picture
    vtBackSurface backSurface; ///< wyman; default vt_backSecond
    float transmittance; ///< 0 to 1: of a surface (kay-linear), of a wall straight through (kay-thickness);
                         ///< default 0.8
    float maxTransmittance; ///< kay-nonlinear, 0 to 1; default 0.95
    float minTransmittance; ///< kay-nonlinear, 0 to maxTransmittance; default 0.2
    float power;            ///< kay-nonlinear, 0 to 100; default 3
    float wallThickness;    ///< kay-thickness, the model's unit; 0: 6 % of the object's largest extent
    int width, height;      ///< picture, pixels, 1 to 16384
    float exposure; ///< EV, -20 to 20: the picture's linear light is multiplied by 2^exposure; default 0
    vtToneMapping toneMapping; ///< of the picture, unless it is `linear`; default vt_toneMappingNone
    vtBackground background;   ///< of the picture; default vt_backgroundEnvironment
    vtVec3 backgroundColor;    ///< of vt_backgroundColor: red, green, blue as sRGB, 0 to 1; default 0, 0, 0
    float backgroundBlur;      ///< of vt_backgroundBlurred: standard deviation, degrees, 1 to 90; default 6
    int samples; ///< a pixel, spread over it, 1 to VT_MAX_SAMPLES; their mean is shown. Other outputs than
                 ///< the picture take one. Default 1, the pixel's centre
    int firstSample;      ///< 0 to 1000000: number of the first of them, see vtRenderer_Draw; default 0
    uint32_t framebuffer; ///< GL name of the framebuffer drawn to by vtRenderer_Draw; 0 is the default one
    int x, y;             ///< lower left corner of the picture in it, pixels, -16384 to 16384; default 0, 0
    /// Linear light, not cut at white, in place of sRGB: for a framebuffer of floats. Default false
    bool linear;
    /// With firstSample above 0: what has changed since the frame before, the view or the scene, is motion.
    /// The samples there are stay in the mean (motion blur); the picture must be as large as before, and of
    /// the same technique. Default false
    bool moving;
    /// The view as GL's matrices, column-major, in place of `view`: from the world to the eye (a rotation and
    /// a shift), and from there to clip coordinates: perspective, off-axis too, or orthographic (techniques
    /// that peel no layers). Both or none; NULL, the default: `view`
    const float *viewMatrix, *projectionMatrix;
    /// Over what the framebuffer has: drawn only where there is something of the scene, blended at its edges,
    /// tested against the framebuffer's depth, if it has any, and written with its own. Needs the matrices,
    /// and a technique with a first surface (not kay's). The element's build looks at none of this.
    /// Default false
    bool overlay;
    /// GL names of 2-D textures with the host's picture and its depth, as large as the framebuffer, which
    /// must not be that framebuffer's own: what lies behind the glass, seen through it wherever the bent ray
    /// comes to lie behind what is drawn there, and with `overlay` what hides it; where the ray leaves the
    /// picture or ends behind something there is the environment. Depths need the matrices; without them all
    /// of the picture is infinitely far away. 0, the default: none
    uint32_t hostColor, hostDepth;
    bool hostLinear; ///< hostColor reads as linear light (floats, sRGB formats); else as sRGB. Default false
    bool hostLevels; ///< hostColor has all its mip levels: rough glass sees it blurred, else sharp. Default
                     ///< false
    /// The host draws what is opaque in the scene itself, and into hostColor: seen directly it is left to the
    /// host, and glass sees it as the host has drawn it where hostColor shows it, else as it is here. Default
    /// false
    bool hostOpaque;
    /// For measurements: called when the GL commands of a stage have been issued. Default NULL.
    vtStageFcn* stageDone;
    void* stageData; ///< passed to stageDone
    bool countReads; ///< for measurements, slower: see vtRenderer_ReadStates; default false
} vtFrame;

/// 512 x 512, technique exact, and the defaults documented at each field; the view looks at the origin.
VT_API vtFrame vtDefaultFrame(void);

/// The frame with every 0 that leaves a setting to the preset replaced by what it stands for.
VT_API vtFrame vtResolveFrame(const vtFrame* frame);

/// Checks every field against its documented range; the sentence names field, value and range.
VT_API vtResult vtValidateFrame(const vtFrame* frame, vtError* error);

/// One meeting of a path with a surface.
typedef struct vtPathEvent {
    vtVec3 position;
    float incoming; ///< degrees between the ray and the interpolated normal, before
    float outgoing; ///< and after
    bool reflected; ///< total internal reflection; else a refraction
} vtPathEvent;

typedef struct vtPath {
    int eventCount; ///< 0: the eye ray misses the glass
    vtPathEvent events[VT_MAX_EVENTS];
    vtVec3 direction; ///< unit, after the last event
    bool exited;      ///< it has left all glass for good
    bool opaque;      ///< it ends on something opaque, at `end`
    vtVec3 end;
} vtPath;

/// Traces exact paths through a scene on the CPU: what the techniques imitate. It builds the hierarchies that
/// the meshes lack once (a second for a few million triangles); then a path takes microseconds.
typedef struct vtTracer vtTracer;

/// Fails as vtValidateScene does, or as building a hierarchy does (vtEndPreparation). The tracer points into
/// the scene: destroy it before the scene is moved, changed (by vtMesh_Update, too) or destroyed. On failure
/// *tracer is NULL.
VT_API vtResult vtCreateTracer(const vtScene* scene, vtTracer** tracer, vtError* error);

/// The path of the eye ray through a point of the picture, x from the left and y from the top in pixels
/// (pixel centres at .5). frame gives view, ior, size and maxEvents. Only where indices differ there is an
/// event; where light could pass it does. Fails with vt_errorArgument.
VT_API vtResult vtTracer_Path(const vtTracer* tracer, const vtFrame* frame, float x, float y, vtPath* path,
                              vtError* error);

/// Safe on NULL.
VT_API void vtDestroyTracer(vtTracer* tracer);

typedef void (*vtProc)(void);
typedef vtProc vtGetProcAddressFcn(const char* name);

/// What is no failure and yet worth knowing: one line for each thing that is approximated or left out,
/// without a line end; it lives as long as the call. Not called in builds for web pages.
typedef void vtLogFcn(const char* line, void* userData);

typedef struct vtRenderer vtRenderer;

typedef struct vtRendererDef {
    vtGetProcAddressFcn* getProcAddress; ///< e.g. glfwGetProcAddress; NULL only on the web
    vtLogFcn* log;                       ///< called from within a renderer's calls; NULL: nothing is said
    void* logData;                       ///< passed to log
    const vtRenderer* shares; ///< one in the same context, or in one that shares objects with it: programs
                              ///< are compiled once for both, and used by one of them at a time; NULL: none
} vtRendererDef;

/// What the renderer runs on and holds; strings live as long as the renderer.
typedef struct vtRendererInfo {
    const char* vendor;
    const char* device;
    const char* version;
    size_t textureBytes;         ///< GPU memory of layers, targets and environment
    size_t meshBytes;            ///< GPU memory of the meshes: hierarchies and vertices
    size_t heightBytes;          ///< of textureBytes: a relief's heights, with or without triangles
    int layerWidth, layerHeight; ///< of the last frame, texels
} vtRendererInfo;

/// GL's state. Every call on a renderer takes over the state that it depends on, whatever the host left; it
/// must not be made while transform feedback or a conditional rendering is active. Afterwards the host finds:
/// - bound to nothing: vertex array, program, array, uniform and pixel (un)pack buffers, samplers of texture
///   units 0 to 31; and uniform buffer binding 0 changed; texture units 0 to 31 may hold textures of the
///   renderer's, unit 0 is active;
/// - switched off: blending, culling, depth, scissor and stencil test, dithering, polygon offset, rasteriser
///   discard, sample coverage and alpha to coverage, primitive restart; on desktop GL also sRGB framebuffers
///   and the logic operation;
/// - depth function less, depth and colour masks all on, front faces counter-clockwise, blend function and
///   equation and the faces to cull unspecified; pixel storage as in a fresh context;
/// - the viewport that was drawn to; bound as draw and read framebuffer after vtRenderer_Draw
///   frame->framebuffer, after all other calls unspecified, after reading back 0.
/// All else is as it was. An error that the host left unasked is dropped (not in browsers, where asking
/// waits).

/// In the current context. Fails with vt_errorContext and the reason.
VT_API vtResult vtCreateRenderer(const vtRendererDef* def, vtRenderer** renderer, vtError* error);
/// Frees all GL objects; the same context must be current. Safe on NULL.
VT_API void vtDestroyRenderer(vtRenderer* renderer);

/// Uploads a scene or an environment in place of what there is; on failure that stays. The scene may go
/// afterwards. Handles of geometry and instances that were there before are gone.
VT_API vtResult vtRenderer_SetScene(vtRenderer* renderer, const vtScene* scene, vtError* error);
/// A scene of one object of glass of index 1.5.
VT_API vtResult vtRenderer_SetMesh(vtRenderer* renderer, const vtMesh* mesh, vtError* error);
VT_API vtResult vtRenderer_SetEnvironment(vtRenderer* renderer, const vtEnvironment* environment,
                                          vtError* error);

/// The picture that vt_backgroundPicture shows, decoded (`pixels`): RGBA, sRGB, of which alpha is not looked
/// at. It may go afterwards; NULL: none. Until there is one such a frame cannot be drawn. Fails with
/// vt_errorArgument where it has no pixels, vt_errorContext where it is larger than the GPU's largest
/// texture; then the one before stays.
VT_API vtResult vtRenderer_SetBackground(vtRenderer* renderer, const vtImage* picture, vtError* error);

/// A picture behind the scene that glass shows bent, decoded (`pixels`): RGBA, sRGB, of which alpha is not
/// looked at. It may go afterwards; NULL: the one before stays. `backdrop` NULL: there is none any more.
/// Techniques that trace (exact and heightfield) show it, and frames with it have no tone mapping; the others
/// do as if there were none. With vt_backgroundEnvironment it is what is seen beside the glass. Fails as
/// vtValidateBackdrop and vtRenderer_SetBackground do, and with vt_errorArgument where there is no picture
/// yet; then all stays.
VT_API vtResult vtRenderer_SetBackdrop(vtRenderer* renderer, const vtImage* picture,
                                       const vtBackdrop* backdrop, vtError* error);
/// Puts a ground under the scene in place of the one there is; NULL: none, as at first. What falls on it is
/// computed with the next frame of a technique that shows it, and kept until scene, environment, ground or
/// the frame's ior, fresnel or maxEvents change. Fails as vtValidateGround does; a frame that would show it
/// fails with vt_errorArgument where the scene reaches below it.
VT_API vtResult vtRenderer_SetGround(vtRenderer* renderer, const vtGround* ground, vtError* error);

/// Geometry on the GPU, and an instance of it: in its place, of its material. Zero is none. A handle is good
/// until what it stands for is removed or a scene is set; then calls that take it fail with vt_errorArgument.
typedef struct vtGeometryId {
    uint32_t index1, generation;
} vtGeometryId;
typedef struct vtInstanceId {
    uint32_t index1, generation;
} vtInstanceId;

/// Those of the scene that was set last, by the number of its mesh or object, as long as none has been
/// removed; zero where there is none, or memory is out.
VT_API vtGeometryId vtRenderer_SceneGeometry(vtRenderer* renderer, uint32_t mesh);
VT_API vtInstanceId vtRenderer_SceneInstance(vtRenderer* renderer, uint32_t object);

/// Adds a mesh to draw instances of, with its hierarchy, which is built where the mesh has none; it may go
/// afterwards. On failure *id is zero. Of several reliefs the first that was added can be drawn by its
/// heights.
VT_API vtResult vtRenderer_AddGeometry(vtRenderer* renderer, const vtMesh* mesh, vtGeometryId* id,
                                       vtError* error);
/// Draws the mesh as vtMesh_Update has changed it. Where its hierarchy is as large as before, which it is
/// unless it was built anew, only what changed is uploaded. On failure the geometry stays as it was.
VT_API vtResult vtRenderer_UpdateGeometry(vtRenderer* renderer, vtGeometryId id, const vtMesh* mesh,
                                          vtError* error);
/// Removes a geometry and all its instances.
VT_API vtResult vtRenderer_RemoveGeometry(vtRenderer* renderer, vtGeometryId id, vtError* error);

/// One object to draw.
typedef struct vtInstanceDef {
    vtGeometryId geometry;
    vtMaterial material; ///< images: those of the scene, or of vtRenderer_SetImages
    vtTransform toWorld; ///< invertible
    int priority;        ///< as vtObject's
    char name[64];       ///< for sentences
} vtInstanceDef;
/// Glass of index 1.5 at the origin; the geometry is for the caller to set.
VT_API vtInstanceDef vtDefaultInstance(void);

/// Adding, moving, changing and removing instances costs no upload but that of the table of objects, with the
/// next frame. What can only be seen with all of them, as glass without a volume inside other glass, the next
/// vtRenderer_Draw says. VT_MAX_OBJECTS at most.
VT_API vtResult vtRenderer_AddInstance(vtRenderer* renderer, const vtInstanceDef* def, vtInstanceId* id,
                                       vtError* error);
VT_API vtResult vtRenderer_SetInstance(vtRenderer* renderer, vtInstanceId id, const vtInstanceDef* def,
                                       vtError* error);
VT_API vtResult vtRenderer_GetInstance(vtRenderer* renderer, vtInstanceId id, vtInstanceDef* def,
                                       vtError* error);
VT_API vtResult vtRenderer_RemoveInstance(vtRenderer* renderer, vtInstanceId id, vtError* error);

/// Draws the scene that was set last, of which none has been removed since, as it is now: vertices moved by
/// vtMesh_Update, objects and lights moved, materials changed. Only what has changed is uploaded. Fails with
/// vt_errorArgument where it is another scene, and as vtRenderer_UpdateGeometry and vtRenderer_SetInstance
/// do; then a part of it may be drawn as it was.
VT_API vtResult vtRenderer_UpdateScene(vtRenderer* renderer, const vtScene* scene, vtError* error);

/// The images that the materials of instances name, in place of those there are.
VT_API vtResult vtRenderer_SetImages(vtRenderer* renderer, const vtImage* images, uint32_t count,
                                     vtError* error);

/// Starts what a frame is drawn with, shaders above all, without waiting for it. *ready: nothing is left to
/// wait for, as far as the driver tells. A page asks again each frame and draws when it is; without this call
/// vtRenderer_Draw waits. Fails as vtRenderer_Draw does for a frame that cannot be drawn.
VT_API vtResult vtRenderer_Prepare(vtRenderer* renderer, const vtFrame* frame, bool* ready, vtError* error);

/// Draws one frame into frame->framebuffer, whose width x height pixels from frame->x, y on are overwritten,
/// or drawn over (frame->overlay). Leaves that framebuffer bound.
///
/// With firstSample above 0 it goes on from the frame before: samples firstSample to firstSample + samples -
/// 1 are added to those that are there (the ones that are there already are not drawn again), and the mean of
/// all is shown. So a page can draw one sample a frame while its picture stands still. Where anything else in
/// *frame but `framebuffer` has changed since, or what there is to draw, it starts anew with firstSample.
/// What the host draws into hostColor and hostDepth is not noticed: begin with firstSample 0 where it
/// changes.
VT_API vtResult vtRenderer_Draw(vtRenderer* renderer, const vtFrame* frame, vtError* error);

/// Draws one frame off screen and reads it back: 4 * width * height bytes, sRGB with straight alpha (255
/// unless the background is transparent), top row first. frame->framebuffer is ignored; framebuffer 0 is
/// bound afterwards. With rgba NULL nothing is read: it returns once the GPU has finished, for timing.
VT_API vtResult vtRenderer_DrawImage(vtRenderer* renderer, const vtFrame* frame, uint8_t* rgba,
                                     vtError* error);

/// The same as floats, for files of more than 8 bits: sRGB, 0 to 1, or with frame->linear linear light after
/// exposure, without tone mapping and not cut at white; straight alpha.
VT_API vtResult vtRenderer_DrawFloats(vtRenderer* renderer, const vtFrame* frame, float* rgba,
                                      vtError* error);

/// Exit directions of the last frame's last sample: 3 * width * height floats, top row first. Unit world
/// directions; (0,0,0) where no surface turned the eye ray and it passed no thin wall (background, glass of
/// index 1), (2,2,2) where the path was lost.
VT_API vtResult vtRenderer_ReadDirections(vtRenderer* renderer, float* directions, vtError* error);

/// What became of the paths of the last frame's last sample: width * height words, top row first. The lowest
/// byte is VT_PATH_BACKGROUND, VT_PATH_EXITED, VT_PATH_LOST or VT_PATH_OPAQUE; the next seven bits are the
/// number of events; VT_PATH_WALL is set where the path passed a thin wall, VT_PATH_TIR where total internal
/// reflection took part; with countReads the word above VT_PATH_READS_SHIFT is the number of texture reads,
/// the first surface's included (0 for the kay techniques).
VT_API vtResult vtRenderer_ReadStates(vtRenderer* renderer, uint32_t* states, vtError* error);

VT_API vtRendererInfo vtRenderer_Info(const vtRenderer* renderer);

#ifdef __cplusplus
}
#endif
