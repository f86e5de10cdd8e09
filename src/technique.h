#pragma once

#include "gl/program.h"
#include "vitrine.h"

/// A rung of the ladder: what users read of it, and what its refract pass is made of.
typedef struct vtTechniqueRow {
    vtTechniqueInfo info;
    vtProgramDef refract;
} vtTechniqueRow;

const vtTechniqueRow* vtTechnique_Row(vtTechnique technique);
