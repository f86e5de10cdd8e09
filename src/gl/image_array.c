#include "gl/image_array.h"

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "image/image.h"

typedef enum Use {
    useNone = 0,
    useLinear, ///< metallic and roughness
    useSrgb,
} Use;

static Use useOf(const vtScene* scene, int image)
{
    Use use = useNone;
    if (scene->materials == NULL) {
        use = scene->images[image].linear ? useLinear : useSrgb;
    }
    for (uint32_t i = 0; i < scene->materialCount; ++i) {
        const vtMaterial* material = &scene->materials[i];
        if (material->opaque && material->baseColorImage == image) {
            return useSrgb;
        }
        if (material->opaque && material->metallicRoughnessImage == image) {
            use = useLinear;
        }
    }
    return scene->images[image].pixels != NULL ? use : useNone;
}

static int sideOf(const vtScene* scene)
{
    int largest = 1, side = 1;
    for (uint32_t i = 0; i < scene->imageCount; ++i) {
        const vtImage* image = &scene->images[i];
        if (image->pixels != NULL && useOf(scene, (int)i) != useNone) {
            largest = image->width > largest ? image->width : largest;
            largest = image->height > largest ? image->height : largest;
        }
    }
    while (side < largest && side < VT_MAX_ARRAY_SIDE) {
        side *= 2;
    }
    return side;
}

// ---------------------------------------------------------------------------------------------- resampling

/// The curves by table: 8 bits to linear, and back from linear in steps that hold the darkest byte apart.
typedef struct Curves {
    float toLinear[256];
    uint8_t toByte[8192];
} Curves;

static void makeCurves(Curves* curves, Use use)
{
    const int last = (int)sizeof curves->toByte - 1;
    for (int i = 0; i < 256; ++i) {
        const float value = (float)i / 255.0f;
        curves->toLinear[i] = use == useSrgb ? vtSrgbToLinear(value) : value;
    }
    for (int i = 0; i <= last; ++i) {
        curves->toByte[i] = (uint8_t)(vtLinearToSrgb((float)i / (float)last) * 255.0f + 0.5f);
    }
}

/// `from` numbers a channel to `to` of them, each `step` floats from the next: means where they get fewer,
/// else linear between centres, the ends joined.
static void resampleLine(const float* source, int from, float* target, int to, int step)
{
    const float ratio = (float)from / (float)to;
    for (int i = 0; i < to; ++i) {
        const float centre = ((float)i + 0.5f) * ratio;
        // A box of the target's width, or a tent of the source's.
        const float reach = ratio > 1.0f ? 0.5f * ratio : 1.0f;
        const int first = (int)floorf(centre - reach), last = (int)ceilf(centre + reach);
        float sums[3] = {0.0f, 0.0f, 0.0f}, all = 0.0f;
        for (int k = first; k < last; ++k) {
            const float low = fmaxf((float)k, centre - reach), high = fminf((float)k + 1.0f, centre + reach);
            const float weight = ratio > 1.0f ? high - low : 1.0f - fabsf((float)k + 0.5f - centre);
            if (weight > 0.0f) {
                const float* texel = source + (size_t)((k % from + from) % from) * (size_t)step;
                for (int c = 0; c < 3; ++c) {
                    sums[c] += weight * texel[c];
                }
                all += weight;
            }
        }
        for (int c = 0; c < 3; ++c) {
            target[(size_t)i * (size_t)step + (size_t)c] = sums[c] / all;
        }
    }
}

/// The layer's texels; false where memory is out.
static bool makeLayer(const vtImage* image, Use use, int side, uint8_t* layer)
{
    if (use == useNone) {
        memset(layer, 255, 4 * (size_t)side * (size_t)side);
        return true;
    }
    if (use == useSrgb && image->width == side && image->height == side) {
        memcpy(layer, image->pixels, 4 * (size_t)side * (size_t)side);
        return true;
    }
    Curves* curves = vtAllocate(1, sizeof *curves);
    // Rows of the right length first, as many as the image has.
    const size_t most = (size_t)(image->height > side ? image->height : side);
    float* wide = vtAllocate((size_t)side * most, 3 * sizeof(float));
    float* line = vtAllocate((size_t)image->width, 3 * sizeof(float));
    float* column = vtAllocate((size_t)side * (size_t)side, 3 * sizeof(float));
    const bool ready = curves != NULL && wide != NULL && line != NULL && column != NULL;
    if (ready) {
        makeCurves(curves, use);
        for (int row = 0; row < image->height; ++row) {
            const uint8_t* pixels = image->pixels + 4 * (size_t)row * (size_t)image->width;
            for (int i = 0; i < 3 * image->width; ++i) {
                line[i] = curves->toLinear[pixels[4 * (i / 3) + i % 3]];
            }
            resampleLine(line, image->width, wide + 3 * (size_t)row * (size_t)side, side, 3);
        }
        for (int i = 0; i < side; ++i) {
            resampleLine(wide + 3 * i, image->height, column + 3 * i, side, 3 * side);
        }
        const float last = (float)(sizeof curves->toByte - 1);
        for (size_t i = 0; i < 4 * (size_t)side * (size_t)side; ++i) {
            layer[i] = i % 4 == 3 ? 255 : curves->toByte[(int)(column[3 * (i / 4) + i % 4] * last + 0.5f)];
        }
    }
    vtFree(curves);
    vtFree(wide);
    vtFree(line);
    vtFree(column);
    return ready;
}

// -------------------------------------------------------------------------------------------------- upload

static vtTexture makeArray(const vtGL* gl, int side, int layers)
{
    vtTexture made = {0, GL_TEXTURE_2D_ARRAY, GL_SRGB8_ALPHA8, side, side, layers, true};
    int levels = 1;
    while (side >> levels > 0) {
        ++levels;
    }
    gl->GenTextures(1, &made.name);
    gl->ActiveTexture(GL_TEXTURE0 + vt_samplerNone);
    gl->BindTexture(made.target, made.name);
    gl->TexStorage3D(made.target, levels, made.format, side, side, layers);
    gl->TexParameteri(made.target, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl->TexParameteri(made.target, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl->TexParameteri(made.target, GL_TEXTURE_WRAP_S, GL_REPEAT);
    gl->TexParameteri(made.target, GL_TEXTURE_WRAP_T, GL_REPEAT);
    return made;
}

vtResult vtImageArray_Upload(vtTexture* texture, const vtGL* gl, const vtScene* scene, vtError* error)
{
    const int layers = scene->imageCount > 0 ? (int)scene->imageCount : 1, side = sideOf(scene);
    GLint most = 0;
    gl->GetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most);
    if (layers > most) {
        return vtFail(error, vt_errorContext,
                      "scene: it has %d images, this GPU takes %d; leave out what is not used", layers, most);
    }
    uint8_t* layer = vtAllocate((size_t)side * (size_t)side, 4);
    vtTexture fresh = makeArray(gl, side, layers);
    bool ready = layer != NULL;
    for (int i = 0; i < layers && ready; ++i) {
        const bool isThere = i < (int)scene->imageCount;
        const vtImage* image = isThere ? &scene->images[i] : NULL;
        const Use use = isThere ? useOf(scene, i) : useNone;
        ready = makeLayer(image, image != NULL && image->pixels != NULL ? use : useNone, side, layer);
        if (ready) {
            gl->TexSubImage3D(fresh.target, 0, 0, 0, i, side, side, 1, GL_RGBA, GL_UNSIGNED_BYTE, layer);
        }
    }
    vtFree(layer);
    gl->GenerateMipmap(fresh.target);
    vtResult result = vtCheckGL(gl, "uploading the scene's images", error);
    if (!ready) {
        result = vtFail(error, vt_errorMemory, "scene: out of memory for %d images of %d x %d", layers, side,
                        side);
    }
    vtTexture* old = result == vt_ok ? texture : &fresh;
    vtTexture_Destroy(old, gl);
    if (result == vt_ok) {
        *texture = fresh;
    }
    return result;
}
