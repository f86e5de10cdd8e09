#include "cli/object_help.h"

#include <stdio.h>

static const double anywhere = 1e9;

static const struct {
    const char* argument;
    const char* text;
} helps[vt_keyCount] = {
    [vt_keyIor] = {"N", "index of refraction of glass"},
    [vt_keyAt] = {"X,Y,Z", "moved there"},
    [vt_keyScale] = {"S|X,Y,Z", "scaled, not by 0"},
    [vt_keyRotate] = {"X,Y,Z", "degrees, about x, then y, then z"},
    [vt_keyPriority] = {"N", "where objects of glass overlap, the highest counts (0)"},
    [vt_keyTint] = {"R,G,B", "glass: share of light that passes a surface"},
    [vt_keyAbsorb] = {"R,G,B", "glass: what is left of light after the distance; also attenuation-color"},
    [vt_keyDistance] = {"D", "of absorb (1); 0 absorbs nothing; also attenuation-distance"},
    [vt_keyRelief] = {"D", "relief: depth from black to white (0.1; a pattern's own)"},
    [vt_keySlab] = {"D", "relief: thickness of the glass behind it (0.1)"},
    [vt_keySmooth] = {"N", "relief: smoothed over so many samples (0; 8 bits: 2)"},
    [vt_keySamples] = {"N", "built-in relief: samples along a side (512)"},
    [vt_keyOpaque] = {NULL, "not glass"},
    [vt_keyGlass] = {NULL, "glass, whatever else is given; glass=NAME: of that kind, see 'vitrine list'"},
    [vt_keyColour] = {"R,G,B", "of what is opaque; makes it so"},
    [vt_keyMetallic] = {"N", "of what is opaque"},
    [vt_keyRoughness] = {"N", "of a surface (glass 0, what is opaque 1)"},
    [vt_keyChecker] = {"N", "squares along a side; makes it opaque (8)"},
    [vt_keyDispersion] = {"N", "glass: 20 over its Abbe number (0)"},
    [vt_keyThin] = {NULL, "glass: a thin wall, through which light goes straight on"},
    [vt_keyWidth] = {"N", "panel: from left to right (2)"},
    [vt_keyHeight] = {"N", "panel: from top to bottom (1.25)"},
    [vt_keyRadius] = {"N", "panel: of its corners (0.25)"},
    [vt_keyBevel] = {"N", "panel: how far in its edges are rounded (0.12)"},
    [vt_keyThickness] = {"N", "panel: from front to back (0.25)"},
    [vt_keyImage] = {"FILE", "a .png or .jpg as its colour; makes it opaque"},
};

void vtPrintObjectHelp(void)
{
    printf("\n--object NAME[:key=value,key=value,...], NAME a built-in shape or relief, a model file or a "
           "picture of "
           "heights. Keys:\n");
    for (int i = 0; i < vt_keyCount; ++i) {
        const vtObjectKeyInfo* key = vtObjectKey_Info((vtObjectKey)i);
        const char* argument = helps[i].argument;
        char left[32], range[48] = "";
        snprintf(left, sizeof left, "%s%s%s", key->name,
                 argument == NULL  ? ""
                 : key->least == 0 ? "|"
                                   : "=",
                 argument == NULL ? "" : argument);
        if (key->least == 0 && key->most > 0) {
            snprintf(left, sizeof left, "%s, %s=%s", key->name, key->name, argument);
        }
        if (key->most > 0 && key->high < anywhere) {
            snprintf(range, sizeof range, ", %g to %g", key->low, key->high);
        }
        printf("  %-20s %s%s\n", left, helps[i].text, range);
    }
    printf("A model's keys hold for all its materials. `plane` is opaque unless it is glass.\n"
           "  a knot behind a cube:\n"
           "    --object cube --object knot:at=0,0,-2\n"
           "  water in a tumbler before a checker plane:\n"
           "    --object tumbler --object water:ior=1.33 --object plane:checker,at=0,0,-2\n"
           "  rippled glass before a checker plane:\n"
           "    --object ripples:relief=0.1 --object plane:checker=4,at=0,0,-2\n"
           "  an opaque ball in glass:\n"
           "    --object sphere --object sphere:scale=0.4,colour=0.8,0.1,0.1\n");
}
