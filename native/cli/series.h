// Many pictures in one go: frames, models, or both.
#pragma once

#include "cli/options.h"

/// Do the options ask for more than a picture?
bool vtIsSeries(const vtOptions* options);

/// Draws them. A picture that is there, whole and of the same options, files and version, is kept. A model
/// that cannot be read is named, the others are drawn, and the end is a failure. SIGINT and SIGTERM end it
/// after the picture that is being drawn.
vtResult vtRunSeries(const vtOptions* options, vtError* error);
