#pragma once

#include "vitrine.h"

/// A picture from a file as the base colour of all of the scene's materials that are opaque.
vtResult vtAddObjectImage(const char* path, vtScene* scene, vtError* error);
