// --object: a shape, relief or model file, its place and what it is made of.
#pragma once

#include "scene/object_spec.h"

/// The keys, for --help.
void vtPrintObjectHelp(void);
