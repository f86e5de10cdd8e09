#pragma once

#include "vitrine.h"

/// A picture from a file as the base colour of all of the scene's materials that are opaque. The hash of what
/// is read is added to *contents.
vtResult vtAddObjectImage(const char* path, const vtLimits* limits, vtScene* scene, uint64_t* contents,
                          vtError* error);
