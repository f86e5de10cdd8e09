// Stands in for the measuring of rays where Embree is not installed: says so.
#include "base/error.h"
#include "lab/rays/rays.h"

vtResult vtMeasureRays(const vtMesh* mesh, const vtView* view, int rounds, vtRayFigures* figures,
                       vtError* error)
{
    (void)mesh, (void)view, (void)rounds;
    *figures = (vtRayFigures){0};
    return vtFail(error, vt_errorArgument, "rays: this vitrine was built without Embree (libembree-dev)");
}
