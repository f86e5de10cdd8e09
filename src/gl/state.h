// What the renderer needs of GL's state. The context is the host's, too: whatever it left, a frame must not
// depend on it.
#pragma once

#include "gl/target.h"

/// Called first by every call that draws, uploads or reads: brings all that it depends on to what it takes
/// for granted. vitrine.h says what the host finds afterwards.
void vtTakeState(const vtGL* gl);

/// Called last: no vertex array, buffer or sampler of ours stays bound.
void vtLeaveState(const vtGL* gl);
