// What of glTF 2.0 and its extensions is drawn: the one list that the loader, its notes, `vitrine list
// --gltf` and docs/gltf.md come from.
#pragma once

#include <stdbool.h>

#include "base/about.h"

typedef enum vtGltfSupport {
    vt_gltfDrawn = 0,
    vt_gltfApproximated, ///< drawn, but not as its specification says; `how` tells
    vt_gltfIgnored,      ///< the file is drawn without it, and a note says so
    vt_gltfRefused,      ///< what needs it is not drawn, and a sentence says so
} vtGltfSupport;

typedef struct vtGltfFeature {
    const char* name; ///< of an extension with its prefix
    vtGltfSupport support;
    bool isExtension;
    const char* needs; ///< the library that decodes it, where this build lacks that; else NULL
#ifdef VT_WITH_ABOUT
    const char* how; ///< for people
#endif
} vtGltfFeature;

/// Features by number; NULL past the end.
const vtGltfFeature* vtGltfFeature_At(int index);

/// The extension of that name, or NULL.
const vtGltfFeature* vtFindGltfExtension(const char* name);

/// "drawn", "approximated", "ignored", "refused".
const char* vtGltfSupport_Name(vtGltfSupport support);
