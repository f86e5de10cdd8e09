#include "cli/part.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"

enum { mostParts = 1000000 };

/// A whole number, 0 to mostParts; -1 of anything else.
static long readNumber(const char* text)
{
    char* end = NULL;
    const long number = text != NULL && *text >= '0' && *text <= '9' ? strtol(text, &end, 10) : -1;
    return end != NULL && *end == '\0' && number <= mostParts ? number : -1;
}

/// A number of the environment that a scheduler sets; -1 where it is not there.
static long readVariable(const char* name)
{
    return readNumber(getenv(name));
}

/// The number of a task of a job array, from 1 on; -1 outside of one.
static long numberOfSlurm(void)
{
    const long task = readVariable("SLURM_ARRAY_TASK_ID"), least = readVariable("SLURM_ARRAY_TASK_MIN"),
               step = readVariable("SLURM_ARRAY_TASK_STEP");
    if (task < 0) {
        return -1;
    }
    return (task - (least > 0 ? least : 0)) / (step > 0 ? step : 1) + 1;
}

/// The number that a scheduler has given this process, from 1 on, and the variable that says so.
static long findNumber(const char** variable)
{
    const long slurm = numberOfSlurm(), kubernetes = readVariable("JOB_COMPLETION_INDEX");
    *variable = slurm > 0 ? "SLURM_ARRAY_TASK_ID" : kubernetes >= 0 ? "JOB_COMPLETION_INDEX" : "PARALLEL_SEQ";
    return slurm > 0 ? slurm : kubernetes >= 0 ? kubernetes + 1 : readVariable("PARALLEL_SEQ");
}

static vtResult failPart(const char* text, vtError* error)
{
    return vtFail(error, vt_errorArgument,
                  "--part is '%.100s'; it must be I/N, part I of N, 1/1 to %d/%d, or auto/N, with I from "
                  "Slurm's, Kubernetes' or GNU parallel's environment",
                  text, mostParts, mostParts);
}

static vtResult readPart(const char* text, vtPart* part, const char** variable, vtError* error)
{
    char number[16] = "";
    const char* slash = strchr(text, '/');
    if (slash == NULL || slash - text >= (long)sizeof number) {
        return failPart(text, error);
    }
    memcpy(number, text, (size_t)(slash - text));
    const bool isAuto = strcmp(number, "auto") == 0;
    const long count = readNumber(slash + 1), given = isAuto ? findNumber(variable) : readNumber(number);
    if (count < 1 || (!isAuto && given < 1)) {
        return failPart(text, error);
    }
    if (given < 1) {
        return vtFail(error, vt_errorArgument,
                      "--part is '%.100s', but none of SLURM_ARRAY_TASK_ID, JOB_COMPLETION_INDEX and "
                      "PARALLEL_SEQ holds a number; give it as I/%ld",
                      text, count);
    }
    if (given > count) {
        return vtFail(error, vt_errorArgument, "--part is '%.100s': there is no part %ld of %ld%s%s", text,
                      given, count, isAuto ? ", which is by " : "", isAuto ? *variable : "");
    }
    *part = (vtPart){(int)given, (int)count};
    return vt_ok;
}

vtResult vtFindPart(const vtOptions* options, vtPart* part, vtError* error)
{
    const char* variable = NULL;
    *part = (vtPart){1, 1};
    if (options->part != NULL) {
        const vtResult result = readPart(options->part, part, &variable, error);
        if (result != vt_ok) {
            return result;
        }
    } else {
        const long number = numberOfSlurm(), count = readVariable("SLURM_ARRAY_TASK_COUNT");
        if (number > 0 && count > 1 && number <= count) {
            variable = "SLURM_ARRAY_TASK_ID";
            *part = (vtPart){(int)number, (int)count};
        }
    }
    if (variable != NULL) {
        fprintf(stderr, "vitrine: note: part %d of %d, by %s\n", part->number, part->count, variable);
    }
    return vt_ok;
}
