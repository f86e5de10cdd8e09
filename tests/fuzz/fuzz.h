// What the fuzz targets share: what holds whatever the bytes are. Where something does not, the program ends,
// and libFuzzer keeps the input.
#pragma once

#include "vitrine.h"

/// Of each target.
int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size);

/// Ends the program unless it holds.
void require(bool holds);

/// A failure has a sentence.
void requireSentence(vtResult result, const vtError* error);

void requireFinite(const float* numbers, size_t count);

/// Numbers of a scene that was loaded are finite, and what they point to is there.
void requireScene(const vtScene* scene);

/// One file of an input that holds several.
typedef struct FuzzFile {
    const uint8_t* bytes;
    size_t size;
} FuzzFile;

/// Cuts an input at each "\n==\n"; gives how many files there are, from 1 to `most`.
int cutInput(const uint8_t* bytes, size_t size, FuzzFile* files, int most);
