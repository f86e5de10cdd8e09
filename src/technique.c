// The ladder as a table. A new technique is one shader, one row here and one golden image; the command
// line, the tests and the documentation follow the table.
#include "technique.h"

#include <assert.h>
#include <string.h>

#include "shaders.h"

static const vtTechniqueRow rows[vt_techniqueCount] = {
    [vt_techniqueLayered] =
        {
            .info = {.id = "layered",
                     .summary =
                         "N peeled layers searched in image space, refraction and total internal reflection",
                     .source = "Wang & Chi, Image Space Real-time Multi-refraction Technology, 2014",
                     .minLayers = 1,
                     .maxLayers = VT_MAX_LAYERS},
            .refract = {.name = "refract layered",
                        .vertex = {&vtChunk_screen_vert},
                        .fragment = {&vtChunk_optics, &vtChunk_octahedral, &vtChunk_layers,
                                     &vtChunk_search_layered, &vtChunk_refract_layered_frag},
                        .samplers = {"u_surfaceDepth", "u_surfaceNormals", "u_mergedDepths",
                                     "u_layerNormals"}},
        },
};

const vtTechniqueRow* vtTechnique_Row(vtTechnique technique)
{
    assert(technique >= 0 && technique < vt_techniqueCount);
    return &rows[technique];
}

const vtTechniqueInfo* vtTechnique_Info(vtTechnique technique)
{
    return &vtTechnique_Row(technique)->info;
}

vtTechnique vtFindTechnique(const char* id)
{
    int technique = 0;
    while (technique < vt_techniqueCount && strcmp(rows[technique].info.id, id) != 0) {
        ++technique;
    }
    return (vtTechnique)technique;
}
