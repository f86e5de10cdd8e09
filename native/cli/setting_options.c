#include "cli/setting_options.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"

vtRange vtRangeOfSetting(const vtSetting* setting)
{
    return (vtRange){setting->least, setting->most, setting->kind == vt_settingInteger};
}

/// Reads `count` numbers separated by commas (or an x between two) and nothing else.
static bool readNumbers(const char* text, double* numbers, int count)
{
    for (int i = 0; i < count; ++i) {
        char* end;
        numbers[i] = strtod(text, &end);
        bool last = i == count - 1;
        if (end == text || !isfinite(numbers[i]) || (last ? *end != '\0' : *end != ',' && *end != 'x')) {
            return false;
        }
        text = end + 1;
    }
    return true;
}

vtResult vtReadOption(const char* option, const char* text, const vtRange* range, int count, double* numbers,
                      vtError* error)
{
    if (!readNumbers(text, numbers, count)) {
        return vtFail(error, vt_errorArgument, "--%s is '%s'; it must be %s", option, text,
                      count == 3   ? "three numbers X,Y,Z"
                      : count == 2 ? "two whole numbers W,H"
                                   : "a number");
    }
    for (int i = 0; i < count && range != NULL; ++i) {
        const bool fits = !range->isWhole || numbers[i] == floor(numbers[i]);
        if (!fits || numbers[i] < range->least || numbers[i] > range->most) {
            return vtFail(error, vt_errorArgument, "--%s is %s; it must be %s from %g to %g", option, text,
                          range->isWhole ? "a whole number" : "a number", range->least, range->most);
        }
    }
    return vt_ok;
}

/// The place of one of the setting's words.
static vtResult readWord(const vtSetting* setting, const char* text, vtFrame* frame, vtError* error)
{
    const char* const* words = setting->words;
    char list[96] = "";
    for (int i = 0; words[i] != NULL; ++i) {
        if (strcmp(words[i], text) == 0) {
            vtSetting_Set(setting, frame, i);
            return vt_ok;
        }
        const char* before = i == 0 ? "" : words[i + 1] != NULL ? ", " : " or ";
        const size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "%s%s", before, words[i]);
    }
    return vtFail(error, vt_errorArgument, "--%s is '%s'; it must be %s", setting->name, text, list);
}

/// A dispersion given by the Abbe number, "abbe:59".
static vtResult readAbbe(const vtSetting* setting, const char* text, vtFrame* frame, vtError* error)
{
    const vtRange range = {1.0, 1000.0, false};
    double abbe;
    vtResult result = vtReadOption(setting->name, text, &range, 1, &abbe, error);
    if (result == vt_ok) {
        vtSetting_Set(setting, frame, 20.0 / abbe);
    }
    return result;
}

vtResult vtReadSetting(const vtSetting* setting, const char* text, vtFrame* frame, vtError* error)
{
    if (setting->words != NULL) {
        return readWord(setting, text, frame, error);
    }
    if (setting->offset == offsetof(vtFrame, dispersion) && strncmp(text, "abbe:", 5) == 0) {
        return readAbbe(setting, text + 5, frame, error);
    }
    const bool isVector = setting->kind == vt_settingVector;
    const vtRange range = vtRangeOfSetting(setting);
    double numbers[3];
    vtResult result =
        vtReadOption(setting->name, text, isVector ? NULL : &range, isVector ? 3 : 1, numbers, error);
    if (result == vt_ok && isVector) {
        *(vtVec3*)((char*)frame + setting->offset) =
            (vtVec3){(float)numbers[0], (float)numbers[1], (float)numbers[2]};
    } else if (result == vt_ok) {
        vtSetting_Set(setting, frame, numbers[0]);
    }
    return result;
}

/// What the option is followed by: words, or a unit in capitals, or a letter.
static void nameArgument(const vtSetting* setting, char* text, size_t size)
{
    text[0] = '\0';
    for (int i = 0; setting->words != NULL && setting->words[i] != NULL; ++i) {
        const size_t used = strlen(text);
        snprintf(text + used, size - used, "%s%s", i > 0 ? "|" : "", setting->words[i]);
    }
    if (setting->words == NULL) {
        const char* usual = setting->kind == vt_settingVector ? "X,Y,Z" : "N";
        snprintf(text, size, "%s", setting->unit != NULL ? setting->unit : usual);
        for (char* letter = text; *letter != '\0'; ++letter) {
            *letter = (char)toupper(*letter);
        }
    }
}

/// What holds where the option is not given.
static void nameDefault(const vtSetting* setting, char* text, size_t size)
{
    const int8_t* ofPreset = setting->ofPreset;
    if (vtSetting_IsOfPreset(setting)) {
        snprintf(text, size, "preset: %d, %d, %d", ofPreset[0], ofPreset[1], ofPreset[2]);
    } else if (setting->zero != NULL) {
        snprintf(text, size, "%s", setting->zero);
    } else if (setting->words != NULL) {
        snprintf(text, size, "%s", setting->words[(int)setting->standard]);
    } else {
        snprintf(text, size, "%g", (double)setting->standard);
    }
}

/// The ids of the techniques it says something to, each between the marks; nothing where it is all.
static void nameTechniques(const vtSetting* setting, const char* mark, char* text, size_t size)
{
    text[0] = '\0';
    for (int i = 0; i < vt_techniqueCount; ++i) {
        if ((setting->techniques & (1u << i)) != 0) {
            const size_t used = strlen(text);
            snprintf(text + used, size - used, "%s%s%s%s", used > 0 ? ", " : "", mark,
                     vtTechnique_Info((vtTechnique)i)->id, mark);
        }
    }
}

void vtPrintSetting(const vtSetting* setting)
{
    char argument[64], left[96], standard[64], techniques[160], help[320], range[48] = "";
    nameArgument(setting, argument, sizeof argument);
    nameDefault(setting, standard, sizeof standard);
    nameTechniques(setting, "", techniques, sizeof techniques);
    snprintf(left, sizeof left, "    --%s %s", setting->name, argument);
    snprintf(help, sizeof help, "%s%s%s (%s)", techniques, techniques[0] != '\0' ? ": " : "", setting->help,
             standard);
    if (setting->words == NULL && setting->kind != vt_settingVector) {
        snprintf(range, sizeof range, ", %d to %d", setting->least, setting->most);
    }
    printf(VT_OPTION_LINE, left, help, range);
}

static void printValues(const vtSetting* setting)
{
    if (setting->kind < vt_settingVector) {
        printf(",\"default\":%g", (double)setting->standard);
    }
    if (setting->kind < vt_settingFlag) {
        printf(",\"least\":%d,\"most\":%d", setting->least, setting->most);
    }
    if (vtSetting_IsOfPreset(setting)) {
        printf(",\"presets\":[%d,%d,%d]", setting->ofPreset[0], setting->ofPreset[1], setting->ofPreset[2]);
    }
    for (int i = 0; setting->words != NULL && setting->words[i] != NULL; ++i) {
        printf("%s\"%s\"%s", i == 0 ? ",\"words\":[" : ",", setting->words[i],
               setting->words[i + 1] == NULL ? "]" : "");
    }
}

void vtPrintSettings(void)
{
    static const char* const kinds[] = {"integer", "number", "flag", "vector"};
    const vtSetting* setting;
    for (int i = 0; (setting = vtSetting_At(i)) != NULL; ++i) {
        char techniques[160];
        nameTechniques(setting, "\"", techniques, sizeof techniques);
        printf("%s{\"name\":\"%s\",\"field\":\"%s\",\"kind\":\"%s\"", i == 0 ? "[" : ",\n ", setting->name,
               setting->field, kinds[setting->kind]);
        printValues(setting);
        if (setting->zero != NULL) {
            printf(",\"zero\":\"%s\"", setting->zero);
        }
        if (setting->unit != NULL) {
            printf(",\"unit\":\"%s\"", setting->unit);
        }
        printf(",\"techniques\":[%s],\"help\":\"%s\"}", techniques, setting->help);
    }
    printf("]\n");
}
