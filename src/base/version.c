#include "vitrine.h"

const char* vtVersion(void)
{
    return VT_VERSION;
}
