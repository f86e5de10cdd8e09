#include "gl/image_array.h"

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "image/image.h"

static bool isDecoded(const vtScene* scene, int image)
{
    return image >= 0 && (uint32_t)image < scene->imageCount && scene->images[image].pixels != NULL;
}

uint32_t vtImageArray_Layer(const vtImageArray* array, const vtMap* map, vtMapUse use)
{
    uint32_t found = VT_NO_TRIANGLE;
    int agreement = 0; // of 2: as it is read, 1: the same image
    for (uint32_t i = 0; map->image >= 0 && i < array->count; ++i) {
        const vtImageLayer* layer = &array->layers[i];
        const bool same = layer->color == vtMapUse_IsColor(use) && layer->nearest == map->nearest;
        if (layer->image == map->image && 1 + same > agreement) {
            found = i;
            agreement = 1 + same;
        }
    }
    return found;
}

/// Adds a layer of the image unless it is there; there is room.
static void addLayer(vtImageArray* array, const vtScene* scene, int image, bool color, bool nearest)
{
    const vtImageLayer layer = {image, color, nearest, scene->images[image].width,
                                scene->images[image].height};
    for (uint32_t i = 0; i < array->count; ++i) {
        const vtImageLayer* other = &array->layers[i];
        if (other->image == layer.image && other->color == layer.color && other->nearest == layer.nearest) {
            return;
        }
    }
    array->layers[array->count++] = layer;
}

/// The layers that the scene needs; false where memory is out.
static bool listLayers(const vtScene* scene, vtImageArray* array)
{
    if (scene->imageCount == 0) {
        return true;
    }
    array->layers = vtAllocate(scene->imageCount, 4 * sizeof *array->layers); // color or not, nearest or not
    if (array->layers == NULL) {
        return false;
    }
    for (uint32_t i = 0; i < scene->imageCount && scene->materials == NULL; ++i) {
        addLayer(array, scene, (int)i, !scene->images[i].linear, false);
    }
    for (uint32_t i = 0; i < scene->materialCount; ++i) {
        for (int use = 0; use < vt_mapCount; ++use) {
            const vtMap* map = &scene->materials[i].maps[use];
            if (isDecoded(scene, map->image)) {
                addLayer(array, scene, map->image, vtMapUse_IsColor((vtMapUse)use), map->nearest);
            }
        }
    }
    return true;
}

static int sideOf(const vtScene* scene, vtImageArray* array)
{
    int largest = 1, side = 1;
    for (uint32_t i = 0; i < array->count; ++i) {
        const vtImage* image = &scene->images[array->layers[i].image];
        if (image->pixels != NULL) {
            largest = image->width > largest ? image->width : largest;
            largest = image->height > largest ? image->height : largest;
        }
    }
    while (side < largest && side < VT_MAX_ARRAY_SIDE) {
        side *= 2;
    }
    while (side > 64 && (size_t)side * (size_t)side * array->count * 4 / 3 * 4 > VT_MAX_ARRAY_BYTES) {
        side /= 2;
    }
    array->isReduced = side < largest;
    return side;
}

// ---------------------------------------------------------------------------------------------- resampling

/// The curves by table: 8 bits to linear, and back from linear in steps that hold the darkest byte apart.
typedef struct Curves {
    float toLinear[256];
    uint8_t toByte[8192];
} Curves;

static void makeCurves(Curves* curves, bool color)
{
    const int last = (int)sizeof curves->toByte - 1;
    for (int i = 0; i < 256; ++i) {
        const float value = (float)i / 255.0f;
        curves->toLinear[i] = color ? vtSrgbToLinear(value) : value;
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
        float sums[4] = {0.0f, 0.0f, 0.0f, 0.0f}, all = 0.0f;
        for (int k = first; k < last; ++k) {
            const float low = fmaxf((float)k, centre - reach), high = fminf((float)k + 1.0f, centre + reach);
            const float weight = ratio > 1.0f ? high - low : 1.0f - fabsf((float)k + 0.5f - centre);
            if (weight > 0.0f) {
                const float* texel = source + (size_t)((k % from + from) % from) * (size_t)step;
                for (int c = 0; c < 4; ++c) {
                    sums[c] += weight * texel[c];
                }
                all += weight;
            }
        }
        for (int c = 0; c < 4; ++c) {
            target[(size_t)i * (size_t)step + (size_t)c] = sums[c] / all;
        }
    }
}

/// Squares stay squares: each texel is the pixel that its centre lies in (readMap of looks.glsl).
static void repeatPixels(const vtImage* image, const Curves* curves, int side, uint8_t* layer)
{
    const float last = (float)(sizeof curves->toByte - 1);
    for (int row = 0; row < side; ++row) {
        const size_t from =
            (size_t)((2 * (int64_t)row + 1) * image->height / (2 * side)) * (size_t)image->width;
        for (int column = 0; column < side; ++column, layer += 4) {
            const uint8_t* p =
                image->pixels + 4 * (from + (size_t)((2 * (int64_t)column + 1) * image->width / (2 * side)));
            for (int c = 0; c < 4; ++c) {
                layer[c] = c == 3 ? p[3] : curves->toByte[(int)(curves->toLinear[p[c]] * last + 0.5f)];
            }
        }
    }
}

/// Blended; false where memory is out.
static bool resample(const vtImage* image, const Curves* curves, int side, uint8_t* layer)
{
    // Rows of the right length first, as many as the image has.
    const size_t most = (size_t)(image->height > side ? image->height : side);
    float* wide = vtAllocate((size_t)side * most, 4 * sizeof(float));
    float* line = vtAllocate((size_t)image->width, 4 * sizeof(float));
    float* column = vtAllocate((size_t)side * (size_t)side, 4 * sizeof(float));
    const bool ready = wide != NULL && line != NULL && column != NULL;
    if (ready) {
        for (int row = 0; row < image->height; ++row) {
            const uint8_t* pixels = image->pixels + 4 * (size_t)row * (size_t)image->width;
            for (int i = 0; i < 4 * image->width; ++i) {
                line[i] = i % 4 == 3 ? (float)pixels[i] / 255.0f : curves->toLinear[pixels[i]];
            }
            resampleLine(line, image->width, wide + 4 * (size_t)row * (size_t)side, side, 4);
        }
        for (int i = 0; i < side; ++i) {
            resampleLine(wide + 4 * i, image->height, column + 4 * i, side, 4 * side);
        }
        const float last = (float)(sizeof curves->toByte - 1);
        for (size_t i = 0; i < 4 * (size_t)side * (size_t)side; ++i) {
            layer[i] = i % 4 == 3 ? (uint8_t)(column[i] * 255.0f + 0.5f)
                                  : curves->toByte[(int)(column[i] * last + 0.5f)];
        }
    }
    vtFree(wide);
    vtFree(line);
    vtFree(column);
    return ready;
}

/// The layer's texels; false where memory is out.
static bool makeLayer(const vtScene* scene, const vtImageLayer* use, int side, uint8_t* layer)
{
    const vtImage* image = use != NULL ? &scene->images[use->image] : NULL;
    if (image == NULL || image->pixels == NULL) {
        memset(layer, 255, 4 * (size_t)side * (size_t)side);
        return true;
    }
    if (use->color && image->width == side && image->height == side) {
        memcpy(layer, image->pixels, 4 * (size_t)side * (size_t)side);
        return true;
    }
    Curves* curves = vtAllocate(1, sizeof *curves);
    bool ready = curves != NULL;
    if (ready) {
        makeCurves(curves, use->color);
    }
    if (ready && use->nearest) {
        repeatPixels(image, curves, side, layer);
    } else if (ready) {
        ready = resample(image, curves, side, layer);
    }
    vtFree(curves);
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

vtResult vtImageArray_Upload(vtImageArray* array, const vtGL* gl, const vtScene* scene, vtError* error)
{
    vtImageArray fresh = {0};
    if (!listLayers(scene, &fresh)) {
        return vtFail(error, vt_errorMemory, "scene: out of memory for %u images", scene->imageCount);
    }
    const int layers = fresh.count > 0 ? (int)fresh.count : 1, side = sideOf(scene, &fresh);
    GLint most = 0;
    gl->GetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most);
    if (layers > most) {
        vtFree(fresh.layers);
        return vtFail(error, vt_errorContext,
                      "scene: it has %d images, this GPU takes %d; leave out what is not used", layers, most);
    }
    uint8_t* layer = vtAllocate((size_t)side * (size_t)side, 4);
    fresh.texture = makeArray(gl, side, layers);
    bool ready = layer != NULL;
    for (int i = 0; i < layers && ready; ++i) {
        ready = makeLayer(scene, fresh.count > 0 ? &fresh.layers[i] : NULL, side, layer);
        if (ready) {
            gl->TexSubImage3D(fresh.texture.target, 0, 0, 0, i, side, side, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                              layer);
        }
    }
    vtFree(layer);
    gl->GenerateMipmap(fresh.texture.target);
    vtResult result = vtCheckGL(gl, "uploading the scene's images", error);
    if (!ready) {
        result = vtFail(error, vt_errorMemory, "scene: out of memory for %d images of %d x %d", layers, side,
                        side);
    }
    vtImageArray_Destroy(result == vt_ok ? array : &fresh, gl);
    if (result == vt_ok) {
        *array = fresh;
    }
    return result;
}

void vtImageArray_Destroy(vtImageArray* array, const vtGL* gl)
{
    vtTexture_Destroy(&array->texture, gl);
    vtFree(array->layers);
    *array = (vtImageArray){0};
}
