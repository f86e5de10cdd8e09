#include "scene/object_spec.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/about.h"
#include "base/error.h"

#define ANYWHERE -1e9, 1e9

static const vtObjectKeyInfo keys[vt_keyCount] = {
    [vt_keyIor] = {"ior", 1, 1, 0.25, 4, 0},
    [vt_keyAt] = {"at", 3, 3, ANYWHERE, 0},
    [vt_keyScale] = {"scale", 1, 3, ANYWHERE, 0},
    [vt_keyRotate] = {"rotate", 3, 3, ANYWHERE, 0},
    [vt_keyPriority] = {"priority", 1, 1, -1e6, 1e6, 0},
    [vt_keyTint] = {"tint", 3, 3, 0, 1, 0},
    [vt_keyAbsorb] = {"absorb", 3, 3, 0, 1, 0},
    [vt_keyDistance] = {"distance", 1, 1, 0, 1e6, 0},
    [vt_keyRelief] = {"relief", 1, 1, 0, 10, 0},
    [vt_keySlab] = {"slab", 1, 1, 0.001, 10, 0},
    [vt_keySmooth] = {"smooth", 1, 1, 0, 64, 0},
    [vt_keySamples] = {"samples", 1, 1, 2, VT_MAX_RELIEF_SIDE, 0},
    [vt_keyOpaque] = {"opaque", 0, 0, 0, 0, 0},
    [vt_keyGlass] = {"glass", 0, 0, 0, 0, 0},
    [vt_keyColour] = {"colour", 3, 3, 0, 1, 0},
    [vt_keyMetallic] = {"metallic", 1, 1, 0, 1, 0},
    [vt_keyRoughness] = {"roughness", 1, 1, 0, 1, 0},
    [vt_keyChecker] = {"checker", 0, 1, 0, 1000, 8},
    [vt_keyThin] = {"thin", 0, 0, 0, 0, 0},
    [vt_keyDispersion] = {"dispersion", 1, 1, 0, 20, 0},
    [vt_keyWidth] = {"width", 1, 1, VT_MIN_PANEL, VT_MAX_PANEL, 0},
    [vt_keyHeight] = {"height", 1, 1, VT_MIN_PANEL, VT_MAX_PANEL, 0},
    [vt_keyRadius] = {"radius", 1, 1, 0, VT_MAX_PANEL, 0},
    [vt_keyBevel] = {"bevel", 1, 1, 0, VT_MAX_PANEL, 0},
    [vt_keyThickness] = {"thickness", 1, 1, VT_MIN_PANEL, VT_MAX_PANEL, 0},
    [vt_keyImage] = {"image", 0, 0, 0, 0, 0},
};

/// What glTF calls them.
static const struct {
    const char* name;
    vtObjectKey key;
} otherNames[] = {{"attenuation-color", vt_keyAbsorb}, {"attenuation-distance", vt_keyDistance}};

const vtObjectKeyInfo* vtObjectKey_Info(vtObjectKey key)
{
    return &keys[key];
}

/// What is parsed, for sentences.
typedef struct Text {
    const char* whole;
    const char* option;
} Text;

static bool isGiven(const vtObjectSpec* spec, vtObjectKey key)
{
    return (spec->given & 1u << key) != 0;
}

static bool isWhole(vtObjectKey key)
{
    return key == vt_keyPriority || key == vt_keySamples;
}

// ------------------------------------------------------------------------------------------------ parsing

/// "at, colour and opaque"
static void listKeys(char* text, size_t size)
{
    *text = '\0';
    for (int i = 0; i < vt_keyCount; ++i) {
        const size_t used = strlen(text);
        snprintf(text + used, size - used, "%s%s",
                 i == 0                ? ""
                 : i < vt_keyCount - 1 ? ", "
                                       : " and ",
                 keys[i].name);
    }
}

static vtResult failKey(const Text* text, const char* key, vtError* error)
{
    char names[320];
    listKeys(names, sizeof names);
    return vtFail(error, vt_errorArgument,
                  "%s '%.200s' has the key '%.60s', which is unknown; the keys are %s", text->option,
                  text->whole, key, names);
}

/// What a key's value must be: "three numbers from 0 to 1".
static void describeValue(vtObjectKey key, char* text, size_t size)
{
    const vtObjectKeyInfo* row = &keys[key];
    const char* count = row->most == 0            ? "given without a value"
                        : row->least == row->most ? row->most == 1 ? "a number" : "three numbers"
                        : row->most == 3          ? "one number or three"
                                                  : "without a value or a number";
    if (isWhole(key)) {
        count = "a whole number";
    }
    char range[64] = "";
    if (row->most > 0) {
        snprintf(range, sizeof range, " from %g to %g", row->low, row->high);
    }
    snprintf(text, size, "%s%s%s", count, range,
             key == vt_keyScale ? ", none of them within 1e-09 of 0" : "");
}

static vtResult failValue(const Text* text, vtObjectKey key, const char* value, vtError* error)
{
    char allowed[128]; // what describeValue writes at most, and its end
    describeValue(key, allowed, sizeof allowed);
    return vtFail(error, vt_errorArgument, "%s '%.200s': %s is '%.100s'; it must be %s", text->option,
                  text->whole, keys[key].name, value, allowed);
}

static bool readNumber(const char* text, double* number)
{
    char* end;
    *number = strtod(text, &end);
    return end != text && *end == '\0' && isfinite(*number);
}

/// The value of the key that has text.
static vtResult storeText(const Text* text, const char* value, vtObjectSpec* spec, vtError* error)
{
    if (value == NULL || *value == '\0' || strlen(value) >= sizeof spec->image) {
        return vtFail(error, vt_errorArgument,
                      "%s '%.200s': image is '%.100s'; it must be the path of a .png or .jpg", text->option,
                      text->whole, value != NULL ? value : "");
    }
    strcpy(spec->image, value);
    spec->given |= 1u << vt_keyImage;
    return vt_ok;
}

/// The kind of glass that the key has.
static vtResult storeKind(const Text* text, const char* value, vtObjectSpec* spec, vtError* error)
{
    spec->kind = vtFindGlass(value);
    spec->given |= 1u << vt_keyGlass;
    if (spec->kind != NULL) {
        return vt_ok;
    }
    char names[160] = "";
    for (int i = 0; vtGlass_Info(i) != NULL; ++i) {
        const size_t used = strlen(names);
        snprintf(names + used, sizeof names - used, "%s%s", i > 0 ? ", " : "", vtGlass_Info(i)->name);
    }
    return vtFail(error, vt_errorArgument,
                  "%s '%.200s': glass is '%.60s'; it must be one of %s, or stand alone", text->option,
                  text->whole, value, names);
}

/// Reads the value, numbers between commas; NULL: there was no '='.
static vtResult storeValue(const Text* text, vtObjectKey key, const char* value, vtObjectSpec* spec,
                           vtError* error)
{
    const vtObjectKeyInfo* row = &keys[key];
    double* numbers = spec->values[key];
    int count = 0;
    char copy[256] = "";
    bool good = value == NULL || strlen(value) < sizeof copy;
    if (value != NULL && good) {
        strcpy(copy, value);
    }
    for (char *part = copy, *next; good && value != NULL && part != NULL; part = next) {
        next = strchr(part, ',');
        if (next != NULL) {
            *next++ = '\0';
        }
        // As floats, which they become: a limit of 0.001f is above 0.001.
        good = count < row->most && readNumber(part, &numbers[count]) &&
               (float)numbers[count] >= (float)row->low && (float)numbers[count] <= (float)row->high &&
               (key != vt_keyScale || fabs(numbers[count]) >= 1e-9) &&
               (!isWhole(key) || numbers[count] == floor(numbers[count]));
        ++count;
    }
    good = good && count >= row->least && (count == 0 || count == 1 || count == row->most);
    if (!good) {
        return failValue(text, key, value != NULL ? value : "", error);
    }
    if (count == 0) {
        numbers[0] = row->preset;
    }
    if (count == 1) {
        numbers[1] = numbers[2] = numbers[0]; // scale
    }
    spec->given |= 1u << key;
    return vt_ok;
}

/// Where the keys begin, behind the name's colon; NULL: there are none. A path or URL may have a colon in it.
static const char* findKeys(const char* text)
{
    const char* colon = strrchr(text, ':');
    return colon == NULL || colon[strcspn(colon, "=/")] == '/' ? NULL : colon + 1;
}

static vtResult parsePart(const Text* text, char* part, vtObjectSpec* spec, vtError* error)
{
    char* value = strchr(part, '=');
    if (value != NULL) {
        *value++ = '\0';
    }
    int key = 0;
    for (size_t i = 0; i < sizeof otherNames / sizeof otherNames[0]; ++i) {
        part = strcmp(otherNames[i].name, part) == 0 ? (char*)keys[otherNames[i].key].name : part;
    }
    while (key < vt_keyCount && strcmp(keys[key].name, part) != 0) {
        ++key;
    }
    return key == vt_keyCount                    ? failKey(text, part, error)
           : key == vt_keyImage                  ? storeText(text, value, spec, error)
           : key == vt_keyGlass && value != NULL ? storeKind(text, value, spec, error)
                                                 : storeValue(text, (vtObjectKey)key, value, spec, error);
}

/// Cuts the keys into parts: at a comma, unless a number follows that goes on with a value.
static char* cutPart(char* part)
{
    bool hasValue = false;
    for (char* end = part; *end != '\0'; ++end) {
        hasValue = hasValue || *end == '=';
        if (*end != ',') {
            continue;
        }
        char next[64] = "";
        double number;
        const size_t length = strcspn(end + 1, ",");
        snprintf(next, sizeof next, "%.*s", length < sizeof next ? (int)length : 0, end + 1);
        if (!hasValue || !readNumber(next, &number)) {
            *end = '\0';
            return end + 1;
        }
    }
    return NULL;
}

vtResult vtParseObject(const char* text, const char* option, bool isName, vtObjectSpec* spec, vtError* error)
{
    const Text whole = {text, option};
    *spec = (vtObjectSpec){0};
    const char* tail = isName ? NULL : findKeys(text);
    const size_t length = tail != NULL ? (size_t)(tail - text) - 1 : strlen(text);
    char parts[1024] = "";
    if (length == 0 || length >= sizeof spec->name || (tail != NULL && strlen(tail) >= sizeof parts)) {
        return vtFail(error, vt_errorArgument,
                      "%s is '%.200s'; it must be NAME or NAME:key=value,key=value, NAME a built-in shape or "
                      "relief, a model file or a picture of heights",
                      option, text);
    }
    memcpy(spec->name, text, length);
    if (tail != NULL) {
        strcpy(parts, tail);
    }
    vtResult result = vt_ok;
    for (char *part = tail != NULL ? parts : NULL, *next; part != NULL && result == vt_ok; part = next) {
        next = cutPart(part);
        result = parsePart(&whole, part, spec, error);
    }
    if (result == vt_ok && isGiven(spec, vt_keyOpaque) && isGiven(spec, vt_keyGlass)) {
        result = vtFail(error, vt_errorArgument, "%s '%.200s' is opaque and glass; give one of them", option,
                        text);
    }
    return result;
}

// ------------------------------------------------------------------------------------------------- making

static void copyColor(const vtObjectSpec* spec, vtObjectKey key, vtVec3* color)
{
    if (isGiven(spec, key)) {
        const double* v = spec->values[key];
        *color = (vtVec3){(float)v[0], (float)v[1], (float)v[2]};
    }
}

static void copyNumber(const vtObjectSpec* spec, vtObjectKey key, float* number)
{
    if (isGiven(spec, key)) {
        *number = (float)spec->values[key][0];
    }
}

static void applyToMaterial(const vtObjectSpec* spec, vtMaterial* material)
{
    const bool opaque = isGiven(spec, vt_keyOpaque) || isGiven(spec, vt_keyColour) ||
                        isGiven(spec, vt_keyChecker) || isGiven(spec, vt_keyImage);
    if (material->opaque && isGiven(spec, vt_keyGlass)) { // clear, unless more is given
        material->roughness = -1.0f;
        material->maps[vt_mapMetallicRoughness] = vtDefaultMap();
    }
    material->opaque = (material->opaque || opaque) && !isGiven(spec, vt_keyGlass);
    if (spec->kind != NULL) {
        material->ior = spec->kind->ior;
        material->dispersion = 20.0f / spec->kind->abbe;
    }
    material->thin = !material->opaque && (material->thin || isGiven(spec, vt_keyThin));
    copyNumber(spec, vt_keyIor, &material->ior);
    copyNumber(spec, vt_keyDispersion, &material->dispersion);
    copyColor(spec, vt_keyTint, &material->tint);
    copyColor(spec, vt_keyAbsorb, &material->attenuationColor);
    if (isGiven(spec, vt_keyAbsorb) && !(material->attenuationDistance > 0.0f)) {
        material->attenuationDistance = 1.0f;
    }
    copyNumber(spec, vt_keyDistance, &material->attenuationDistance);
    copyColor(spec, vt_keyColour, &material->baseColor);
    copyNumber(spec, vt_keyMetallic, &material->metallic);
    copyNumber(spec, vt_keyRoughness, &material->roughness);
    copyNumber(spec, vt_keyChecker, &material->checker);
    // What is given takes the place of the file's pictures.
    if (isGiven(spec, vt_keyColour)) {
        material->maps[vt_mapBaseColor] = vtDefaultMap();
    }
    if (isGiven(spec, vt_keyMetallic) || isGiven(spec, vt_keyRoughness)) {
        material->maps[vt_mapMetallicRoughness] = vtDefaultMap();
    }
}

vtResult vtObjectSpec_Check(const vtObjectSpec* spec, vtObjectKind kind, const char* option, vtError* error)
{
    const bool isRelief = kind == vt_kindReliefFile || kind == vt_kindReliefPattern;
    for (int key = 0; key < vt_keyCount; ++key) {
        const bool ofRelief = key >= vt_keyRelief && key <= vt_keySamples;
        const bool ofPanel = key >= vt_keyWidth && key <= vt_keyThickness;
        if (isGiven(spec, (vtObjectKey)key) &&
            ((ofRelief && !isRelief) || (ofPanel && kind != vt_kindPanel))) {
            return vtFail(error, vt_errorArgument,
                          "%s '%.200s' is no %s, so the key '%s' says nothing to it; leave it out", option,
                          spec->name, ofPanel ? "panel" : "relief", keys[key].name);
        }
    }
    if (kind == vt_kindReliefFile && isGiven(spec, vt_keySamples)) {
        return vtFail(error, vt_errorArgument,
                      "%s '%.200s' has the samples that the file has; leave the key 'samples' out", option,
                      spec->name);
    }
    return vt_ok;
}

vtObjectKind vtKindOfShape(const char* name)
{
    return VT_IS_FULL && strcmp(name, "panel") == 0 ? vt_kindPanel : vt_kindMesh;
}

vtResult vtObjectSpec_CreateShape(const vtObjectSpec* spec, const char* name, vtMesh* mesh, vtError* error)
{
    if (spec == NULL || vtKindOfShape(name) != vt_kindPanel) {
        return vtCreateShape(name, mesh, error);
    }
    vtPanelDef def = vtDefaultPanelDef();
    copyNumber(spec, vt_keyWidth, &def.width);
    copyNumber(spec, vt_keyHeight, &def.height);
    copyNumber(spec, vt_keyRadius, &def.radius);
    copyNumber(spec, vt_keyBevel, &def.bevel);
    copyNumber(spec, vt_keyThickness, &def.thickness);
    return vtCreatePanel(&def, mesh, error);
}

void vtObjectSpec_ApplyToRelief(const vtObjectSpec* spec, vtReliefDef* def)
{
    copyNumber(spec, vt_keyRelief, &def->depth);
    copyNumber(spec, vt_keySlab, &def->thickness);
    copyNumber(spec, vt_keySmooth, &def->smoothing);
    if (isGiven(spec, vt_keySamples)) {
        def->width = def->height = (int)spec->values[vt_keySamples][0];
    }
}

void vtObjectSpec_Apply(const vtObjectSpec* spec, vtScene* scene)
{
    for (uint32_t i = 0; i < scene->materialCount; ++i) {
        applyToMaterial(spec, &scene->materials[i]);
    }
    for (uint32_t i = 0; i < scene->objectCount && isGiven(spec, vt_keyPriority); ++i) {
        scene->objects[i].priority = (int)spec->values[vt_keyPriority][0];
    }
}

vtTransform vtObjectSpec_Place(const vtObjectSpec* spec)
{
    const double radian = 3.14159265358979323846 / 180.0;
    const double* angles = spec->values[vt_keyRotate]; // 0 where not given, as the place
    double s[3], c[3];
    for (int axis = 0; axis < 3; ++axis) {
        s[axis] = sin(angles[axis] * radian);
        c[axis] = cos(angles[axis] * radian);
    }
    // The product of the turns about z, y and x, the last one next to the vector.
    const double turn[3][3] = {
        {c[2] * c[1], c[2] * s[1] * s[0] - s[2] * c[0], c[2] * s[1] * c[0] + s[2] * s[0]},
        {s[2] * c[1], s[2] * s[1] * s[0] + c[2] * c[0], s[2] * s[1] * c[0] - c[2] * s[0]},
        {-s[1], c[1] * s[0], c[1] * c[0]},
    };
    vtTransform place;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            const double scale = isGiven(spec, vt_keyScale) ? spec->values[vt_keyScale][column] : 1.0;
            place.rows[row][column] = (float)(turn[row][column] * scale);
        }
        place.rows[row][3] = (float)spec->values[vt_keyAt][row];
    }
    return place;
}
