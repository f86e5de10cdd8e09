#include "technique/background.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "technique/settings.h"

/// 0 to 15; -1: it is no hexadecimal digit.
static int digitOf(char c)
{
    static const char digits[] = "0123456789abcdef";
    const char* place = c != '\0' ? strchr(digits, c >= 'A' && c <= 'F' ? c + ('a' - 'A') : c) : NULL;
    return place != NULL ? (int)(place - digits) : -1;
}

/// After the #: six digits, or three that each stand for two.
static bool readColor(const char* text, vtVec3* color)
{
    const size_t length = strlen(text), each = length / 3;
    float parts[3];
    bool fits = length == 3 || length == 6;
    for (size_t k = 0; k < 3 && fits; ++k) {
        const int high = digitOf(text[each * k]), low = digitOf(text[each * k + each - 1]);
        fits = high >= 0 && low >= 0;
        parts[k] = (float)(16 * high + low) / 255.0f;
    }
    *color = fits ? vtMakeVec3(parts) : *color;
    return fits;
}

static vtResult readBlur(const char* text, vtFrame* frame, vtError* error)
{
    const vtSetting* setting = vtFindSetting("background-blur");
    char* end = NULL;
    const double degrees = strtod(text, &end);
    if (end == text || *end != '\0' || !(degrees >= setting->least && degrees <= setting->most)) {
        return vtFail(error, vt_errorArgument,
                      "background is 'blurred:%.100s'; its degrees must be from %d to %d", text,
                      setting->least, setting->most);
    }
    frame->background = vt_backgroundBlurred;
    frame->backgroundBlur = (float)degrees;
    return vtSucceed(error);
}

vtResult vtFrame_SetBackground(vtFrame* frame, const char* text, vtError* error)
{
    static const char* const words[] = {"environment", "transparent"};
    static_assert(vt_backgroundEnvironment == 0 && vt_backgroundTransparent == 1, "the places of the words");
    for (int i = 0; i < 2; ++i) {
        if (strcmp(text, words[i]) == 0) {
            frame->background = (vtBackground)i;
            return vtSucceed(error);
        }
    }
    if (strcmp(text, "blurred") == 0) {
        frame->background = vt_backgroundBlurred;
        return vtSucceed(error);
    }
    if (strncmp(text, "blurred:", 8) == 0) {
        return readBlur(text + 8, frame, error);
    }
    if (text[0] == '#') {
        vtVec3 color = {0.0f, 0.0f, 0.0f};
        if (!readColor(text + 1, &color)) {
            return vtFail(error, vt_errorArgument,
                          "background is '%.100s'; a colour is # and six hexadecimal digits, as #f0e8d8",
                          text);
        }
        frame->background = vt_backgroundColor;
        frame->backgroundColor = color;
        return vtSucceed(error);
    }
    if (strpbrk(text, "./") == NULL) { // a file's name has one, or it is given as ./NAME
        return vtFail(
            error, vt_errorArgument,
            "background is '%.100s'; it must be environment, transparent, blurred, blurred:DEGREES, "
            "#rrggbb or a picture's file",
            text);
    }
    frame->background = vt_backgroundPicture;
    return vtSucceed(error);
}
