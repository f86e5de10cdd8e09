#pragma once

#include <stdio.h>

#include "vitrine.h"

/// Reads a whole file ("-": standard input). Fails with vt_errorFile naming path and reason. *bytes is the
/// caller's to free.
vtResult vtReadFile(const char* path, uint8_t** bytes, size_t* size, vtError* error);

/// The same of a model or a picture. Fails with vt_errorMemory where it has more bytes than the limits'
/// memory (NULL: the defaults). What begins as neither need not end: its beginning is all that is read.
vtResult vtReadInput(const char* path, const vtLimits* limits, uint8_t** bytes, size_t* size, vtError* error);

/// Reads a text of at most 16 MiB and puts a zero at its end; free takes it.
vtResult vtReadText(const char* path, char** text, vtError* error);

/// The next line of a text, without LF or CRLF, and *at behind it; NULL past the last one.
char* vtNextLine(char** at);

/// Writes a whole file ("-": standard output; a device or a pipe as it is). The file appears complete or not
/// at all, as vtBeginFile has it, so that an older one stays where something fails.
vtResult vtWriteFile(const char* path, const void* bytes, size_t size, vtError* error);

/// A file that is being written beside its place, under a name that nobody can foretell.
typedef struct vtUnfinishedFile {
    int descriptor;   ///< open for writing; -1: there is none
    char path[4096];  ///< the name that it has meanwhile: the place, digits, an ending
    char place[4096]; ///< where it goes: links are followed
} vtUnfinishedFile;

/// Begins one for `path`, with the permissions of the file that is there, if any; one that may not be written
/// stays. `ending`: of its name meanwhile, for programs that go by it.
vtResult vtBeginFile(const char* path, const char* ending, vtUnfinishedFile* file, vtError* error);

/// Makes the folders of a path that are not there. Fails with vt_errorFile and the reason.
vtResult vtMakeFolders(const char* path, vtError* error);

/// Puts what has been written on the disk and then into its place. On failure nothing of it is left.
vtResult vtFinishFile(vtUnfinishedFile* file, vtError* error);

/// Nothing of it is left. Safe after vtFinishFile.
void vtDropFile(vtUnfinishedFile* file);

/// Writes what `print` prints of `data` in the same way.
typedef void vtPrintFcn(const void* data, FILE* out);
vtResult vtWritePrinted(const char* path, vtPrintFcn* print, const void* data, vtError* error);

/// Where the files of a model may lie: resolved, so without links.
typedef struct vtModelFolders {
    char directory[4096]; ///< its own
    char root[4096];      ///< of --root; empty: none
    uint64_t* contents;   ///< the hash of what is read is added to it; NULL: it is not
} vtModelFolders;

/// Of the file `model` ("-": the current folder) and --root, NULL where that is not given.
vtResult vtFindModelFolders(const char* model, const char* root, vtModelFolders* folders, vtError* error);

/// A vtReadFileFcn for vtModelDef, whose userData is a vtModelFolders: plain files within the folders alone,
/// wherever links lead.
vtResult vtReadFileForModel(const char* path, size_t limit, uint8_t** bytes, size_t* size, void* userData,
                            vtError* error);
