#pragma once

#include <stdio.h>

#include "vitrine.h"

/// Reads a whole file ("-": standard input). Fails with vt_errorFile naming path and reason. *bytes is the
/// caller's to free.
vtResult vtReadFile(const char* path, uint8_t** bytes, size_t* size, vtError* error);

/// Writes a whole file ("-": standard output). The file appears complete or not at all: it is written
/// beside its place and renamed, so that an older one stays where something fails.
vtResult vtWriteFile(const char* path, const void* bytes, size_t size, vtError* error);

/// Writes what `print` prints of `data` in the same way.
typedef void vtPrintFcn(const void* data, FILE* out);
vtResult vtWritePrinted(const char* path, vtPrintFcn* print, const void* data, vtError* error);

/// Where the files of a model may lie: resolved, so without links.
typedef struct vtModelFolders {
    char directory[4096]; ///< its own
    char root[4096];      ///< of --root; empty: none
} vtModelFolders;

/// Of the file `model` ("-": the current folder) and --root, NULL where that is not given.
vtResult vtFindModelFolders(const char* model, const char* root, vtModelFolders* folders, vtError* error);

/// A vtReadFileFcn for vtModelDef, whose userData is a vtModelFolders: plain files within the folders alone,
/// wherever links lead.
vtResult vtReadFileForModel(const char* path, size_t limit, uint8_t** bytes, size_t* size, void* userData,
                            vtError* error);
