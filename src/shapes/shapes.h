// The built-in shapes. Internal: callers use vtCreateShape.
#pragma once

#include "shapes/shape_data.h"

/// The built-in `knot` or `torus` of about so many triangles, 200 to 4000000, for measurements. Fails with
/// vt_errorArgument for another name.
vtResult vtCreateFineShape(const char* name, uint32_t triangles, vtMesh* mesh, vtError* error);
/// Whether it can be built so.
bool vtHasFineShape(const char* name);

/// Fails with a sentence that names the number and its range.
vtResult vtCheckPanel(const vtPanelDef* def, vtError* error);
/// Of a definition that was checked; false where memory is short.
bool vtBuildPanelOf(vtShapeData* shape, const vtPanelDef* def);

// Each builds one shape; false where memory is short.
bool vtBuildSphere(vtShapeData* shape);
bool vtBuildTorus(vtShapeData* shape);
bool vtBuildKnot(vtShapeData* shape);
bool vtBuildGoblet(vtShapeData* shape);
bool vtBuildBottle(vtShapeData* shape);
bool vtBuildDiamond(vtShapeData* shape);
bool vtBuildCube(vtShapeData* shape);
bool vtBuildPlane(vtShapeData* shape);
bool vtBuildTumbler(vtShapeData* shape);
bool vtBuildPanel(vtShapeData* shape);
bool vtBuildWater(vtShapeData* shape); ///< in the tumbler's coordinates
