// JSON as all commands write it: commas come by themselves, texts are escaped, and a number that JSON has no
// word for (infinite, NaN) is null.
#pragma once

#include <stdbool.h>
#include <stdio.h>

/// Starts as {.out = ...}. `name` of the functions below: NULL in an array and for the outermost value.
typedef struct vtJson {
    FILE* out;
    bool follows; ///< the next value needs a comma before it
} vtJson;

void vtJson_BeginObject(vtJson* json, const char* name);
void vtJson_EndObject(vtJson* json);
void vtJson_BeginArray(vtJson* json, const char* name);
void vtJson_EndArray(vtJson* json);
void vtJson_Text(vtJson* json, const char* name, const char* text);
void vtJson_Integer(vtJson* json, const char* name, long long value);
void vtJson_Number(vtJson* json, const char* name, double value, int decimals);
/// As it is: nine digits, whatever its size.
void vtJson_Float(vtJson* json, const char* name, float value);
