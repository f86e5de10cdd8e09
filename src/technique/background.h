// A frame's background as text, as the command line and the element take it.
#pragma once

#include "vitrine.h"

/// Puts into the frame what a text says is behind the scene: environment, transparent, blurred,
/// blurred:DEGREES (1 to 90), #rrggbb or #rgb (sRGB), or the name of a picture's file, which holds a dot or a
/// slash and is the caller's to load (vt_backgroundPicture). Fails with vt_errorArgument; then the frame
/// stays as it was.
vtResult vtFrame_SetBackground(vtFrame* frame, const char* text, vtError* error);
