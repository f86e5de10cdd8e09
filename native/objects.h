// --object: a shape or model file, its place and what it is made of.
#pragma once

#include "vitrine.h"

enum { vt_objectNameRoom = 4096 };

/// The keys in the order of the table in objects.c; bits of `given`.
typedef enum vtObjectKey {
    vt_keyIor,
    vt_keyAt,
    vt_keyScale,
    vt_keyRotate,
    vt_keyPriority,
    vt_keyTint,
    vt_keyAbsorb,
    vt_keyDistance,
    vt_keyOpaque,
    vt_keyGlass,
    vt_keyColour,
    vt_keyMetallic,
    vt_keyRoughness,
    vt_keyChecker,
    vt_keyCount,
} vtObjectKey;

typedef struct vtObjectSpec {
    char name[vt_objectNameRoom];  ///< of a shape or file
    unsigned given;                ///< bit set of vtObjectKey
    double values[vt_keyCount][3]; ///< of those given
} vtObjectSpec;

/// Parses NAME[:key=value,...]. Fails with a sentence that names --object, key, value and what is allowed.
vtResult vtParseObject(const char* text, vtObjectSpec* spec, vtError* error);

/// Gives the scene's materials and objects what the specification says; the place is vtObjectSpec_Place's.
void vtObjectSpec_Apply(const vtObjectSpec* spec, vtScene* scene);

/// Scaled, turned about x, then y, then z, and moved.
vtTransform vtObjectSpec_Place(const vtObjectSpec* spec);

/// The keys, for --help.
void vtPrintObjectHelp(void);
