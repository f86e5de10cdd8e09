// Kinds of glass by the numbers that makers and laboratories give: the index at 587.6 nm, and the Abbe
// number.
#include <string.h>

#include "base/about.h"
#include "vitrine.h"

// Where an author gives a formula of the index, both numbers follow from it. Gemmologists give the difference
// between 430.8 and 686.7 nm (Fraunhofer's G and B) in place of an Abbe number; by Cauchy's formula that of F
// and C is 0.584 of it.
static const vtGlassInfo glasses[] = {
    {"water", 1.333f, 55.76f, VT_ABOUT("at 20 degrees Celsius: Daimon & Masumura 2007")},
    {"crown", 1.5168f, 64.17f, VT_ABOUT("N-BK7: data sheet of Schott")},
    {"flint", 1.6200f, 36.37f, VT_ABOUT("F2: data sheet of Schott")},
    {"sapphire", 1.768f, 72.31f, VT_ABOUT("ordinary ray: Malitson & Dodge 1972")},
    {"zircon", 1.925f, 40.6f, VT_ABOUT("ordinary ray: 1.925, B to G 0.039, GIA")},
    {"diamond", 2.417f, 55.30f, VT_ABOUT("Peter 1923")},
    {"moissanite", 2.648f, 27.1f, VT_ABOUT("ordinary ray: 2.648, B to G 0.104, GIA")},
};
enum { glassCount = sizeof glasses / sizeof glasses[0] };

const vtGlassInfo* vtGlass_Info(int index)
{
    return index >= 0 && index < glassCount ? &glasses[index] : NULL;
}

const vtGlassInfo* vtFindGlass(const char* name)
{
    int index = 0;
    while (name != NULL && index < glassCount && strcmp(glasses[index].name, name) != 0) {
        ++index;
    }
    return name != NULL ? vtGlass_Info(index) : NULL;
}
