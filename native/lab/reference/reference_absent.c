// Stands in for the reference tracer where Embree is not installed: says so.
#include "base/error.h"
#include "lab/reference/reference.h"

vtResult vtCreateReference(const vtScene* scene, vtReference** reference, vtError* error)
{
    (void)scene;
    *reference = NULL;
    return vtFail(error, vt_errorArgument,
                  "reference: this vitrine was built without Embree (libembree-dev)");
}

void vtDestroyReference(vtReference* reference)
{
    (void)reference;
}

vtResult vtReference_Trace(const vtReference* reference, const vtReferenceDef* def, vtReferenceImage* image,
                           vtError* error)
{
    (void)def;
    *image = (vtReferenceImage){0};
    return vtCreateReference(NULL, &(vtReference*){(vtReference*)reference}, error);
}

void vtDestroyReferenceImage(vtReferenceImage* image)
{
    (void)image;
}

void vtReference_ToSrgb(const vtReferenceImage* image, uint8_t* rgba)
{
    (void)image, (void)rgba;
}
