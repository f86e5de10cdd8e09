// Glass in a context of three.js's: a renderer and what web/three/*.js have given to it.
#pragma once

#include "vitrine.h"

/// Meshes of geometry that the page has given, with their hierarchies, for vtMesh_Update.
typedef struct vtThreeGeometry {
    vtScene scene;              ///< of the one mesh; without: the place is free
    vtPreparation* preparation; ///< under way; NULL: none
    vtGeometryId id;            ///< on the GPU; zero: not yet
} vtThreeGeometry;

/// A picture laid over a surface, as three/materials.js writes it: vtMap.
typedef struct vtThreeMap {
    int32_t image, texcoords, wrapX, wrapY, nearest;
    float rows[2][3];
} vtThreeMap;

/// A material, as three/materials.js writes it: the fields of vtMaterial.
typedef struct vtThreeMaterial {
    uint32_t opaque, thin, unlit, alphaMode;
    float ior, transmission, attenuationDistance, metallic, roughness, alpha, alphaCutoff, specular,
        iridescence, iridescenceIor, iridescenceMin, iridescenceMax, dispersion, normalScale,
        occlusionStrength;
    vtVec3 color, attenuationColor, emissive, specularColor;
    vtThreeMap maps[vt_mapCount];
} vtThreeMaterial;

/// An object, as three/objects.js writes it.
typedef struct vtThreeObject {
    uint32_t geometry; ///< number of vtThree_AddGeometry
    uint32_t material; ///< of the table
    vtTransform toWorld;
} vtThreeObject;

/// What a frame is drawn with, as three/core.js writes it.
typedef struct vtThreeFrame {
    float view[16], projection[16]; ///< as vtFrame's matrices
    int32_t width, height;
    uint32_t framebuffer, color, depth; ///< GL names; 0: none
    float exposure;
    int32_t samples, preset, maxEvents, branches, fresnel; ///< as vtFrame's
    int32_t levels;                                        ///< of the colours are there
} vtThreeFrame;

typedef struct vtThree {
    vtRenderer* renderer;
    vtThreeGeometry* geometries;
    uint32_t geometryCount;
    // What was placed by the frame before.
    vtThreeObject* objects;
    vtThreeMaterial* materials;
    vtInstanceId* instances;
    uint32_t objectCount, materialCount;
    vtError error;
} vtThree;
