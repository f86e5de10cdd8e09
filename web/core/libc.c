// In place of parts of libc (--wrap) that cost a page more than they are worth to it.
#include <emscripten.h>
#include <math.h>
#include <string.h>

// The browser reads numbers as exactly, without the 128-bit arithmetic that is 3 KB of the compressed wasm.
EM_JS(double, vtReadNumber, (const char* text), { return Number(UTF8ToString(text)); })

double __wrap_strtod(const char* text, char** end);

/// All of `text` is one number, of JSON or an object's line; else NaN.
double __wrap_strtod(const char* text, char** end)
{
    *end = (char*)text + strspn(text, "+-.0123456789Ee");
    return vtReadNumber(text);
}

int __wrap___rem_pio2_large(double* parts, double* rest, int exponent, int count, int precision);

/// An angle of more than a million radians, as the sum of parts[i] * 2^(exponent - 24 i), less so many
/// quarter turns; gives their number. As exact as a double of that size tells angles apart; libc's own is 1
/// KB of the compressed wasm.
int __wrap___rem_pio2_large(double* parts, double* rest, int exponent, int count, int precision)
{
    (void)precision;
    const double quarter = 1.57079632679489661923;
    double angle = 0.0;
    for (int i = count - 1; i >= 0; --i) {
        angle += scalbn(parts[i], exponent - 24 * i);
    }
    const double turns = floor(angle / quarter + 0.5);
    rest[0] = fmax(-0.8, fmin(0.8, angle - turns * quarter));
    rest[1] = 0.0;
    return (int)(turns - 8.0 * floor(turns / 8.0));
}
