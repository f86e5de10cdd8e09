// Names of a series' files: those of its models and the numbers of its frames in a pattern.
#pragma once

#include "vitrine.h"

/// Fails where a pattern has braces that mean nothing: there are {name} and {frame}.
vtResult vtCheckPattern(const char* pattern, vtError* error);

/// Does the pattern have it, as "{name}"?
bool vtPatternHas(const char* pattern, const char* braces);

/// The pattern with its braces filled in. `model`: the name of its file without folder and ending stands for
/// {name}. `frame`: with at least four digits it stands for {frame}, or where the pattern has none before the
/// ending, after a hyphen; -1: there are no frames. Fails where the path is too long.
vtResult vtNameOutput(const char* pattern, const char* model, int frame, char* path, size_t size,
                      vtError* error);

/// The name of a model's file without folder and ending.
void vtNameModel(const char* model, char* name, size_t size);
