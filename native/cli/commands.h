#pragma once

#include "cli/options.h"

/// `vitrine render`: one picture, and what else the options ask for.
vtResult vtRunRender(const vtOptions* options, vtError* error);

/// `vitrine view`: a window to turn the object in.
vtResult vtRunView(const vtOptions* options, vtError* error);

/// `vitrine ladder`: every technique from one view beside the reference, as a contact sheet and a table.
vtResult vtRunLadder(const vtOptions* options, vtError* error);

/// `vitrine bench`: time, memory and accuracy of techniques beside the reference, interleaved.
vtResult vtRunBench(const vtOptions* options, vtError* error);

/// `vitrine rays`: a relief traced by its heights, beside triangles made of them.
vtResult vtRunRays(const vtOptions* options, vtError* error);

/// `vitrine inspect`: what is in a glTF file, and what of it is drawn.
vtResult vtRunInspect(const vtOptions* options, vtError* error);

/// `vitrine compare`: how far a result is from the truth. words[0] is "compare".
vtResult vtRunCompare(int count, char** words, vtError* error);
