// What an object is made of and where it lies, in one line of text: a name, then keys with values.
#pragma once

#include "vitrine.h"

enum { vt_objectNameRoom = 4096 };

/// The keys in the order of the table in object_spec.c; bits of `given`.
typedef enum vtObjectKey {
    vt_keyIor,
    vt_keyAt,
    vt_keyScale,
    vt_keyRotate,
    vt_keyPriority,
    vt_keyTint,
    vt_keyAbsorb,
    vt_keyDistance,
    vt_keyRelief, ///< these four: of reliefs only
    vt_keySlab,
    vt_keySmooth,
    vt_keySamples,
    vt_keyOpaque,
    vt_keyGlass,
    vt_keyColour,
    vt_keyMetallic,
    vt_keyRoughness,
    vt_keyChecker,
    vt_keyThin,
    vt_keyDispersion,
    vt_keyWidth, ///< these five: of a panel only
    vt_keyHeight,
    vt_keyRadius,
    vt_keyBevel,
    vt_keyThickness,
    vt_keyImage, ///< its value is text; of vt_keyGlass it can be
    vt_keyCount,
} vtObjectKey;

typedef struct vtObjectSpec {
    char name[vt_objectNameRoom];  ///< of a shape, pattern or file
    unsigned given;                ///< bit set of vtObjectKey
    double values[vt_keyCount][3]; ///< of those given
    char image[1024];              ///< path of a picture, where vt_keyImage is given
    const vtGlassInfo* kind;       ///< of glass; NULL: none is given
} vtObjectSpec;

typedef struct vtObjectKeyInfo {
    const char* name;
    int least, most; ///< numbers; none: a flag
    double low, high;
    double preset; ///< of a key given without a value
} vtObjectKeyInfo;
const vtObjectKeyInfo* vtObjectKey_Info(vtObjectKey key);

/// Parses NAME[:key=value,...]. `isName`: the whole text is the name, although it may have a colon. Fails
/// with a sentence that names the option (as "--object"), key, value and what is allowed.
vtResult vtParseObject(const char* text, const char* option, bool isName, vtObjectSpec* spec, vtError* error);

typedef enum vtObjectKind {
    vt_kindMesh, ///< shape or model
    vt_kindPanel,
    vt_kindReliefFile,
    vt_kindReliefPattern,
} vtObjectKind;

/// Fails with a sentence where a key is given that says nothing to what the name turned out to be.
vtResult vtObjectSpec_Check(const vtObjectSpec* spec, vtObjectKind kind, const char* option, vtError* error);

/// What a built-in shape of that name is.
vtObjectKind vtKindOfShape(const char* name);

/// vtCreateShape; a panel has the numbers that are given. `spec` may be NULL.
vtResult vtObjectSpec_CreateShape(const vtObjectSpec* spec, const char* name, vtMesh* mesh, vtError* error);

/// The numbers of a relief that are given.
void vtObjectSpec_ApplyToRelief(const vtObjectSpec* spec, vtReliefDef* def);

/// Gives the scene's materials and objects what the specification says; the place is vtObjectSpec_Place's.
void vtObjectSpec_Apply(const vtObjectSpec* spec, vtScene* scene);

/// Scaled, turned about x, then y, then z, and moved.
vtTransform vtObjectSpec_Place(const vtObjectSpec* spec);
