// In place of libc's strtod (--wrap): the browser reads numbers as exactly, and without the 128-bit
// arithmetic that is 3 KB of the compressed wasm.
#include <emscripten.h>
#include <string.h>

EM_JS(double, vtReadNumber, (const char* text), { return Number(UTF8ToString(text)); })

double __wrap_strtod(const char* text, char** end);

/// All of `text` is one number, of JSON or an object's line; else NaN.
double __wrap_strtod(const char* text, char** end)
{
    *end = (char*)text + strspn(text, "+-.0123456789Ee");
    return vtReadNumber(text);
}
