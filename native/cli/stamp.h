// What a picture depends on as a number, which stands in its file: a picture that is there need not be drawn
// again.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "vitrine.h"

/// The comment of a picture with that stamp; 64 bytes will do.
void vtWriteStamp(uint64_t stamp, char* comment, size_t size);

/// Is there a whole picture of that size, with that comment?
bool vtIsDrawn(const char* path, const char* comment, int width, int height);
