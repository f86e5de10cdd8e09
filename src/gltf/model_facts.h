// What a glTF file has and says, for `vitrine inspect`. Not in builds for web pages.
#pragma once

#include "vitrine.h"

/// A material of the file that its scene uses, and the features that it has (gltf/features.h), ", " between
/// them.
typedef struct vtMaterialFacts {
    char name[64];
    int index; ///< in the file; -1: glTF's default
    char drawn[512], ignored[512];
} vtMaterialFacts;

typedef struct vtAnimationFacts {
    char name[64];
    double duration; ///< seconds
} vtAnimationFacts;

typedef struct vtModelFacts {
    uint32_t nodeCount, meshCount, materialCount, textureCount, imageCount; ///< of the file
    uint32_t skinCount, animationCount, lightCount;
    char *variants, *used, *required; ///< names of variants and extensions, a line each; NULL: none
    vtMaterialFacts* materials;
    vtAnimationFacts* animations; ///< animationCount
    uint32_t usedMaterialCount;
} vtModelFacts;

/// As vtOpenModel; *facts is zeroed on failure.
vtResult vtInspectModel(const vtModelDef* def, vtScene* scene, vtModelFacts* facts, vtError* error);
void vtDestroyModelFacts(vtModelFacts* facts);
