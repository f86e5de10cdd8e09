#include "gltf/features.h"

#include <stddef.h>
#include <string.h>

#ifdef VT_WITH_ABOUT
#define HOW(text) , text
#else
#define HOW(text)
#endif
#define CORE(name, support, text)                                                                            \
    {                                                                                                        \
        name, support, false, NULL HOW(text)                                                                 \
    }
#define EXTENSION(name, support, text)                                                                       \
    {                                                                                                        \
        name, support, true, NULL HOW(text)                                                                  \
    }
/// `lacking`: the library, where this build lacks it.
#define DECODED(name, lacking, text)                                                                         \
    {                                                                                                        \
        name, vt_gltfDrawn, true, lacking HOW(text)                                                          \
    }

#ifdef VT_WITH_DRACO
#define LACKS_DRACO NULL
#else
#define LACKS_DRACO "libdraco"
#endif
#ifdef VT_WITH_MESHOPT
#define LACKS_MESHOPT NULL
#else
#define LACKS_MESHOPT "libmeshoptimizer"
#endif

/// Pictures that a browser decodes, by itself or by element/basis.js.
#ifdef __EMSCRIPTEN__
#define BROWSERS vt_gltfDrawn
#else
#define BROWSERS vt_gltfRefused
#endif

static const vtGltfFeature features[] = {
#ifdef VT_WITH_ABOUT // what no material is asked for
    CORE("scenes, nodes, matrices", vt_gltfDrawn,
         "the default scene, else the first, else all nodes without a parent; scales may be negative"),
    CORE("triangles, strips, fans", vt_gltfDrawn,
         "parts of a mesh that have the same material are one body; closed glass that is inside out is "
         "turned"),
    CORE("points, lines", vt_gltfIgnored, "they bound no volume"),
    CORE("sparse accessors", vt_gltfDrawn, "also without a buffer view"),
    CORE("morph targets", vt_gltfDrawn,
         "positions and normals, by the weights of the file or its animations"),
    CORE("skins", vt_gltfDrawn, "any number of joints a vertex"),
    CORE("animations", vt_gltfDrawn,
         "all interpolations; of nodes, weights, cameras, lights; what is scaled to nothing becomes tiny"),
    CORE("perspective cameras", vt_gltfApproximated,
         "level, without roll; planes and aspect are not looked at"),
    CORE("orthographic cameras", vt_gltfApproximated,
         "level, without roll; only by techniques that peel no layers"),
    CORE("buffers, pictures in files", vt_gltfDrawn, "in the model's folder, or in that of --root"),
    CORE("base colour, metallic, roughness", vt_gltfApproximated,
         "with their pictures, of glass too, whose roughness `exact`, `heightfield` and `reference` draw"),
    CORE("vertex colours", vt_gltfDrawn, "COLOR_0, with its alpha"),
    CORE("normal maps", vt_gltfDrawn,
         "by the file's tangents, or computed ones; reflections follow them, too"),
    CORE("occlusion maps", vt_gltfDrawn, "of light from the environment"),
    CORE("emissive factor and pictures", vt_gltfDrawn, "of glass too; they light nothing else"),
    CORE("alpha modes", vt_gltfDrawn, "MASK and BLEND, of glass too, in any order"),
    CORE("doubleSided", vt_gltfDrawn,
         "opaque things without it are not seen from behind; glass is a body, its walls have two sides"),
    CORE("samplers", vt_gltfApproximated,
         "wrapping, and nearest magnification; minified pictures are averaged"),
    CORE("two sets of texture coordinates", vt_gltfDrawn, "any two for a material"),
#endif
    EXTENSION("EXT_mesh_gpu_instancing", vt_gltfDrawn, "translations, rotations, scales"),
    DECODED("EXT_meshopt_compression", LACKS_MESHOPT,
            "all modes and filters; by libmeshoptimizer, npm's meshoptimizer in a browser"),
    EXTENSION(
        "EXT_texture_avif", BROWSERS,
        "drawn in a browser; else the PNG or JPEG beside it is taken, and where there is none, the file "
        "is refused"),
    EXTENSION("EXT_texture_webp", vt_gltfDrawn, ""),
    EXTENSION(
        "KHR_animation_pointer", vt_gltfApproximated,
        "of nodes; of materials base colour, metallic, roughness, emissive, alpha cutoff, transmission, "
        "index, attenuation, dispersion; a note counts other channels"),
    DECODED("KHR_draco_mesh_compression", LACKS_DRACO,
            "by libdraco, npm's draco3dgltf in a browser; version 2.2 of its bitstream"),
    EXTENSION("KHR_lights_punctual", vt_gltfApproximated,
              "opaque things and the ground are lit, with shadows, and through glass; glass has highlights"),
    EXTENSION("KHR_materials_anisotropy", vt_gltfIgnored, ""),
    EXTENSION("KHR_materials_clearcoat", vt_gltfIgnored, ""),
    EXTENSION("KHR_materials_diffuse_transmission", vt_gltfIgnored, ""),
    EXTENSION("KHR_materials_dispersion", vt_gltfApproximated,
              "`exact`, `heightfield` and `reference` draw it"),
    EXTENSION("KHR_materials_emissive_strength", vt_gltfDrawn, ""),
    EXTENSION("KHR_materials_ior", vt_gltfDrawn, ""),
    EXTENSION("KHR_materials_iridescence", vt_gltfDrawn, "Belcour & Barla 2017; seen from outside"),
    EXTENSION("KHR_materials_pbrSpecularGlossiness", vt_gltfIgnored, ""),
    EXTENSION("KHR_materials_sheen", vt_gltfIgnored, ""),
    EXTENSION("KHR_materials_specular", vt_gltfDrawn, ""),
    EXTENSION("KHR_materials_transmission", vt_gltfDrawn,
              "a thin wall without KHR_materials_volume, but solid where a file is nothing but closed glass "
              "(--walls says otherwise); where no material of a file has it, all are made clear glass"),
    EXTENSION("KHR_materials_unlit", vt_gltfDrawn,
              "its base colour as it is, whatever the exposure; tones are mapped as of the rest"),
    EXTENSION("KHR_materials_variants", vt_gltfDrawn,
              "by --variant; else the materials that primitives name"),
    EXTENSION("KHR_materials_volume", vt_gltfDrawn,
              "attenuation in world units; thickness is that of the body itself"),
    EXTENSION("KHR_mesh_quantization", vt_gltfDrawn, "every type, normalized or not, morph targets too"),
    DECODED("KHR_meshopt_compression", LACKS_MESHOPT,
            "as EXT_meshopt_compression; what is newer than that is refused, but drawn in a browser"),
    EXTENSION("KHR_node_visibility", vt_gltfDrawn, ""),
    EXTENSION(
        "KHR_texture_basisu", BROWSERS,
        "drawn in a browser; else the PNG or JPEG beside it is taken, and where there is none, the file "
        "is refused"),
    EXTENSION("KHR_texture_transform", vt_gltfDrawn, ""),
    EXTENSION("KHR_xmp_json_ld", vt_gltfIgnored, "it says nothing of looks"),
};

const vtGltfFeature* vtGltfFeature_At(int index)
{
    return index >= 0 && index < (int)(sizeof features / sizeof features[0]) ? &features[index] : NULL;
}

const vtGltfFeature* vtFindGltfExtension(const char* name)
{
    const vtGltfFeature* found = NULL;
    for (size_t i = 0; i < sizeof features / sizeof features[0] && found == NULL; ++i) {
        found = features[i].isExtension && strcmp(features[i].name, name) == 0 ? &features[i] : NULL;
    }
    return found;
}

const char* vtGltfSupport_Name(vtGltfSupport support)
{
    static const char* const names[] = {"drawn", "approximated", "ignored", "refused"};
    return names[support];
}
