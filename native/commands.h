#pragma once

#include "options.h"

/// `vitrine render`: one picture, and what else the options ask for.
vtResult vtRunRender(const vtOptions* options, vtError* error);

/// `vitrine view`: a window to turn the object in.
vtResult vtRunView(const vtOptions* options, vtError* error);
