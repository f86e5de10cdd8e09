#pragma once

#include "vitrine.h"

/// With the default in place of each 0; NULL: all of them.
vtLimits vtResolveLimits(const vtLimits* limits);
