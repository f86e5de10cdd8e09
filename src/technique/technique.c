// The ladder as a table. A new technique is one shader, one row here and one golden image; the command
// line, the tests and the documentation follow the table.
#include "technique/technique.h"

#include <assert.h>
#include <string.h>

#include "base/about.h"
#include "base/error.h"
#include "scene/objects.h"
#include "shaders.h"

// What `layered` has in common whatever is around, with one of its searches.
#define VT_LAYERED_CHUNKS(search)                                                                            \
    &vtChunk_octahedral, &vtChunk_media, &vtChunk_path, &vtChunk_write_path, &vtChunk_objects,               \
        &vtChunk_optics, &vtChunk_cross_surface, &vtChunk_first_surface, &vtChunk_layer_space,               \
        &vtChunk_layers_of_object, &vtChunk_layers, &vtChunk_layer_walls, &vtChunk_##search

// Its programs that follow paths: through all glass, past opaque things, through one object.
#define VT_LAYERED_ANY(title, search)                                                                        \
    {                                                                                                        \
        .name = title, .vertex = {&vtChunk_screen_vert}, .fragment = {                                       \
            VT_LAYERED_CHUNKS(search),                                                                       \
            &vtChunk_refract_layered_frag                                                                    \
        }                                                                                                    \
    }
#define VT_LAYERED_OPAQUE(title, search)                                                                     \
    {                                                                                                        \
        .name = title, .vertex = {&vtChunk_screen_vert}, .fragment = {                                       \
            VT_LAYERED_CHUNKS(search),                                                                       \
            &vtChunk_with_opaque,                                                                            \
            &vtChunk_records,                                                                                \
            &vtChunk_object_tree,                                                                            \
            &vtChunk_search_opaque,                                                                          \
            &vtChunk_refract_layered_frag                                                                    \
        }                                                                                                    \
    }
#define VT_LAYERED_ORDERED(title, search)                                                                    \
    {                                                                                                        \
        .name = title, .vertex = {&vtChunk_screen_vert},                                                     \
        .fragment = {VT_LAYERED_CHUNKS(search), &vtChunk_refract_ordered_frag}, .uniforms = {                \
            "u_object"                                                                                       \
        }                                                                                                    \
    }

static const vtTechniqueRow rows[vt_techniqueCount] = {
    [vt_techniqueKayLinear] =
        {
            .info = {.id = "kay-linear",
                     .summary = VT_ABOUT(
                         "surfaces blended back to front, the same transmittance everywhere; no refraction"),
                     .source = VT_ABOUT(
                         "Kay & Greenberg, Transparency for Computer Synthesized Images, equation 1"),
                     .year = 1979,
                     .refracts = false},
            .layers = VT_LAYERS_OF_FRAME,
            .layerSpace = vt_layersOfPicture,
            .refract[vt_variantAny] = {.name = "kay-linear",
                                       .vertex = {&vtChunk_screen_vert},
                                       .fragment = {&vtChunk_octahedral, &vtChunk_media, &vtChunk_path,
                                                    &vtChunk_write_path, &vtChunk_kay,
                                                    &vtChunk_refract_kay_linear_frag}},
        },
    [vt_techniqueKayNonlinear] =
        {
            .info = {.id = "kay-nonlinear",
                     .summary = VT_ABOUT(
                         "as before, less transparent where the surface turns away, highlights added"),
                     .source = VT_ABOUT(
                         "Kay & Greenberg, Transparency for Computer Synthesized Images, equation 2"),
                     .year = 1979,
                     .refracts = false},
            .layers = VT_LAYERS_OF_FRAME,
            .layerSpace = vt_layersOfPicture,
            .refract[vt_variantAny] = {.name = "kay-nonlinear",
                                       .vertex = {&vtChunk_screen_vert},
                                       .fragment = {&vtChunk_octahedral, &vtChunk_media, &vtChunk_path,
                                                    &vtChunk_write_path, &vtChunk_kay, &vtChunk_transparency,
                                                    &vtChunk_refract_kay_nonlinear_frag}},
        },
    [vt_techniqueKayThickness] =
        {
            .info = {.id = "kay-thickness",
                     .summary = VT_ABOUT("every surface a thin wall that shifts what lies behind it"),
                     .source =
                         VT_ABOUT("Kay & Greenberg, Transparency for Computer Synthesized Images, section 4"),
                     .year = 1979,
                     .refracts = true},
            .layers = VT_LAYERS_OF_FRAME,
            .layerSpace = vt_layersOfPicture,
            .refract[vt_variantAny] = {.name = "kay-thickness",
                                       .vertex = {&vtChunk_screen_vert},
                                       .fragment = {&vtChunk_octahedral, &vtChunk_media, &vtChunk_path,
                                                    &vtChunk_write_path, &vtChunk_kay, &vtChunk_transparency,
                                                    &vtChunk_refract_kay_thickness_frag}},
        },
    [vt_techniqueSingle] =
        {
            .info = {.id = "single",
                     .summary = VT_ABOUT("one refraction at the first surface, then the environment"),
                     .source = VT_ABOUT("common practice; the first column of Wang & Chi's comparisons"),
                     .year = 2003,
                     .refracts = true},
            .surface = true,
            .refract[vt_variantAny] = {.name = "single",
                                       .vertex = {&vtChunk_screen_vert},
                                       .fragment = {&vtChunk_octahedral, &vtChunk_media, &vtChunk_path,
                                                    &vtChunk_write_path, &vtChunk_objects, &vtChunk_optics,
                                                    &vtChunk_cross_surface, &vtChunk_first_surface,
                                                    &vtChunk_refract_single_frag}},
        },
    [vt_techniqueWyman] =
        {
            .info = {.id = "wyman",
                     .summary =
                         VT_ABOUT("two refractions, the distance between them guessed from two known ones"),
                     .source =
                         VT_ABOUT("Wyman, An Approximate Image-Space Approach for Interactive Refraction"),
                     .year = 2005,
                     .refracts = true},
            .surface = true,
            .innerDistances = true,
            .layers = 2,
            .refract[vt_variantAny] = {.name = "wyman",
                                       .vertex = {&vtChunk_screen_vert},
                                       .fragment = {&vtChunk_octahedral, &vtChunk_media, &vtChunk_path,
                                                    &vtChunk_write_path, &vtChunk_objects,
                                                    &vtChunk_optics, &vtChunk_cross_surface,
                                                    &vtChunk_first_surface, &vtChunk_layer_space,
                                                    &vtChunk_layers_of_all,
                                                    &vtChunk_second_layer, &vtChunk_refract_wyman_frag}},
        },
    [vt_techniqueOliveira] =
        {
            .info = {.id = "oliveira",
                     .summary = VT_ABOUT("two refractions, the back side found by a search in its depth"),
                     .source =
                         VT_ABOUT("Oliveira & Brauwers, Real-Time Refraction Through Deformable Objects"),
                     .year = 2007,
                     .refracts = true},
            .surface = true,
            .layers = 2,
            .refract[vt_variantAny] = {.name = "oliveira",
                                       .vertex = {&vtChunk_screen_vert},
                                       .fragment = {&vtChunk_octahedral, &vtChunk_media, &vtChunk_path,
                                                    &vtChunk_write_path, &vtChunk_objects,
                                                    &vtChunk_optics, &vtChunk_cross_surface,
                                                    &vtChunk_first_surface, &vtChunk_layer_space,
                                                    &vtChunk_layers_of_all,
                                                    &vtChunk_second_layer, &vtChunk_refract_oliveira_frag}},
        },
    [vt_techniqueLayered] =
        {
            .info = {.id = "layered",
                     .summary =
                         VT_ABOUT(
                             "N peeled layers searched for every refraction and total internal reflection"),
                     .source = VT_ABOUT("Wang & Chi, Image Space Real-time Multi-refraction Technology"),
                     .year = 2014,
                     .refracts = true},
            .surface = true,
            .layers = VT_LAYERS_OF_FRAME,
            .merge = true,
            .layerSpace = vt_layersOfEachObject,
            .findsOpaque = true,
            .refract[vt_variantAny] = VT_LAYERED_ANY("layered", search_layered),
            .refract[vt_variantOpaque] = VT_LAYERED_OPAQUE("layered opaque", search_layered),
            .refract[vt_variantOrdered] = VT_LAYERED_ORDERED("layered ordered", search_layered),
#ifdef VT_WITH_CELLS
            .refract[vt_variantCells] = VT_LAYERED_ANY("layered cells", search_cells),
            .refract[vt_variantCellsOpaque] = VT_LAYERED_OPAQUE("layered cells opaque", search_cells),
            .refract[vt_variantCellsOrdered] = VT_LAYERED_ORDERED("layered cells ordered", search_cells),
#endif
        },
    [vt_techniqueExact] =
        {
            .info = {.id = "exact",
                     .summary =
                         VT_ABOUT("a wide hierarchy of the triangles, searched for every event: exact hits"),
                     .source = VT_ABOUT("Vitrine"),
                     .year = 2026,
                     .refracts = true},
            .traces = true,
            .roughness = true,
            .dispersion = true,
        },
    [vt_techniqueHeightField] =
        {
            .info = {.id = "heightfield",
                     .summary = VT_ABOUT("as exact, but a relief by its heights alone, without triangles"),
                     .source =
                         VT_ABOUT("Tevs, Ihrke & Seidel, Maximum Mipmaps for Height Field Rendering; Weng"),
                     .year = 2008,
                     .refracts = true},
            .traces = true,
            .roughness = true,
            .dispersion = true,
            .heights = true,
        },
};

const vtTechniqueRow* vtTechnique_Row(vtTechnique technique)
{
    assert(technique >= 0 && technique < vt_techniqueCount);
    return &rows[technique];
}

const vtTechniqueInfo* vtTechnique_Info(vtTechnique technique)
{
    return technique >= 0 && technique < vt_techniqueCount ? &rows[technique].info : NULL;
}

vtTechnique vtFindTechnique(const char* id)
{
    int technique = 0;
    while (technique < vt_techniqueCount && (id == NULL || strcmp(rows[technique].info.id, id) != 0)) {
        ++technique;
    }
    return (vtTechnique)technique;
}

vtResult vtPrepareScene(vtScene* scene, vtTechnique technique, bool* changed, vtError* error)
{
    if (changed != NULL) {
        *changed = false;
    }
    if (scene == NULL) {
        return vtFailMissing(error, "vtPrepareScene", "scene");
    }
    if (technique < 0 || technique >= vt_techniqueCount) {
        return vtFail(error, vt_errorArgument, "technique %d is not in the table", (int)technique);
    }
    const vtTechniqueRow* row = vtTechnique_Row(technique);
    return vtScene_Complete(scene, row->heights, row->innerDistances, changed, error);
}
