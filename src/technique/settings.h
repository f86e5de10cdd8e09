// The settings of a frame as a table, the one place that knows a setting's name, default and range. Defaults,
// checks and presets, the command line, the web page's setter and the tests follow it.
#pragma once

#include "base/about.h"
#include "vitrine.h"

typedef enum vtSettingKind {
    vt_settingInteger, ///< int, or an enum
    vt_settingNumber,  ///< float
    vt_settingFlag,    ///< bool
    vt_settingVector,  ///< vtVec3
} vtSettingKind;

typedef struct vtSetting {
    const char* name;                ///< as on the command line
    float standard;                  ///< the default; that of a vector is in vtDefaultFrame
    int least, most;                 ///< of an integer or a number
    uint8_t offset;                  ///< in vtFrame
    uint8_t kind;                    ///< vtSettingKind
    int8_t ofPreset[vt_presetCount]; ///< what 0 stands for; all 0: it is not the preset's
    bool takesZero;                  ///< 0 says something of its own, in or out of the range
    bool ofObjects;                  ///< -1 leaves it to each object
    bool continues;                  ///< a frame of another value goes on with the samples there are
#ifdef VT_WITH_ABOUT
    const char* field;        ///< as in vtFrame
    const char* const* words; ///< of an enum or a flag, from 0 on, NULL-terminated; else NULL
    const char* zero;         ///< what 0 means, or -1 of ofObjects; NULL: no more than its name says
    const char* unit;         ///< NULL: none
    const char* help;         ///< what it is, in a line
    unsigned techniques;      ///< bits, by vtTechnique: those it says something to; 0: all
#endif
} vtSetting;

/// NULL past the end.
const vtSetting* vtSetting_At(int index);
/// By the name on the command line; NULL where there is none.
const vtSetting* vtFindSetting(const char* name);

/// An integer, a number or a flag as a number.
double vtSetting_Get(const vtSetting* setting, const vtFrame* frame);
/// Puts a number in, whatever the range; one that the field cannot hold becomes one that is out of range.
void vtSetting_Set(const vtSetting* setting, vtFrame* frame, double value);
/// Does 0 leave it to the preset?
bool vtSetting_IsOfPreset(const vtSetting* setting);

/// Checks every integer and number against its range.
vtResult vtCheckSettings(const vtFrame* frame, vtError* error);

/// Of two resolved frames: could one go on with the other's samples?
bool vtFrame_Same(const vtFrame* a, const vtFrame* b);

/// No more work a pixel than a preset asks for, whatever the frame says.
void vtFrame_Lessen(vtFrame* frame, vtPreset preset);
