// This work is based on:
//
//   Pontus Andersson, Jim Nilsson, Tomas Akenine-Moller, Magnus Oskarsson, Kalle Astrom and Mark D.
//   Fairchild. FLIP: A Difference Evaluator for Alternating Images. Proc. ACM Comput. Graph. Interact. Tech.
//   3(2), 2020. Constants that the paper leaves open (the matrix, the filters' radii) are those of the
//   authors' own program, github.com/NVlabs/flip, read in its NumPy and C++ forms.
//
// Departures, none of which changes the numbers beyond rounding:
//
//   - every filter is applied as rows, then columns; the blue-yellow one, a sum of two Gaussians, as two;
//   - features are found in Y of YCxCz as it is, with filters scaled by 1/116: their weights sum to zero, so
//     the offset of 16 falls out;
//   - input outside 0 to 1 is clamped, NaN is black: FLIP speaks of what a display can show;
//   - pictures are seen in bands of rows, each with as many beside it as filters reach, so that a large one
//     takes little memory.
#include "lab/metrics/metrics_image.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "image/image.h"

enum {
    maxRadius = 64,       // reached at about 470 pixels a degree
    leastRows = 64,       // of a band
    mostPixels = 1 << 18, // of a band of more rows than that
};

/// Weights for offsets -radius to radius.
typedef struct Filter {
    int radius;
    float weights[2 * maxRadius + 1];
} Filter;

typedef struct Filters {
    Filter achromatic, redGreen, blueYellow[2]; // contrast sensitivity; the two are summed
    Filter smooth, edge, point;                 // features: across the derivative, first and second
} Filters;

/// What the eye is taken to see of one picture, in planes: Hunt-adjusted L*a*b* after the spatial filters,
/// and how strong an edge or a point is at each pixel.
enum { planeL, planeA, planeB, planeEdge, planePoint, seenPlanes };
enum { planeY, planeCx, planeCz, planeTemporary, planeResult, scratchPlanes };

/// Linear RGB, 3 floats a pixel; or 8-bit sRGB, which `decoded` has as floats.
typedef struct Picture {
    const float* linear; // or NULL
    const uint8_t* bytes;
    size_t channels;
    const float* decoded; // 256
} Picture;

/// A band of rows.
typedef struct Raster {
    int width, height;
    size_t area;
    float* scratch; // scratchPlanes * area
    float* line;    // width + 2 * maxRadius
} Raster;

// The sRGB primaries and their white, linear RGB to XYZ.
static const double xyzOfRgb[3][3] = {
    {10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
    {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
    {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0},
};
static const float rgbOfXyz[3][3] = {
    {3.241003275f, -1.537398934f, -0.498615861f},
    {-0.969224334f, 1.875930071f, 0.041554224f},
    {0.055639423f, -0.204011202f, 1.057148933f},
};
static const float white[3] = {0.950428545f, 1.0f, 1.088900371f};

/// XYZ over white.
static void relativeXyz(const float* rgb, float xyz[3])
{
    for (int i = 0; i < 3; ++i) {
        float sum = 0.0f;
        for (int j = 0; j < 3; ++j) {
            sum += (float)xyzOfRgb[i][j] * rgb[j];
        }
        xyz[i] = sum / white[i];
    }
}

/// The form that YCxCz and, after the cube root, L*a*b* share.
static vtVec3 opponent(const float v[3])
{
    return (vtVec3){116.0f * v[1] - 16.0f, 500.0f * (v[0] - v[1]), 200.0f * (v[1] - v[2])};
}

/// CIELAB with its chroma scaled by the lightness: colours differ less where it is dark (Hunt 1952).
static vtVec3 huntLab(const float* rgb)
{
    const float delta = 6.0f / 29.0f;
    float v[3];
    relativeXyz(rgb, v);
    for (int i = 0; i < 3; ++i) {
        v[i] = v[i] > delta * delta * delta ? cbrtf(v[i]) : v[i] / (3.0f * delta * delta) + 4.0f / 29.0f;
    }
    vtVec3 lab = opponent(v);
    return (vtVec3){lab.x, 0.01f * lab.x * lab.y, 0.01f * lab.x * lab.z};
}

/// City block in lightness, Euclidean in chroma (Abasi, Amani Tehran and Fairchild 2020).
static float hyab(vtVec3 p, vtVec3 q)
{
    return fabsf(p.x - q.x) + sqrtf((p.y - q.y) * (p.y - q.y) + (p.z - q.z) * (p.z - q.z));
}

/// Samples exp(-factor * x^2) at whole offsets. `share` is what the 2-D filter rows * columns sums to.
static Filter makeGaussian(int radius, double factor, double share)
{
    Filter filter = {.radius = radius};
    double sum = 0.0;
    for (int x = -radius; x <= radius; ++x) {
        sum += exp(-factor * x * x);
    }
    for (int x = -radius; x <= radius; ++x) {
        filter.weights[x + radius] = (float)(sqrt(share) * exp(-factor * x * x) / sum);
    }
    return filter;
}

/// First (order 1) or second (order 2) derivative of a Gaussian; the positive weights sum to `scale`, the
/// negative ones to -scale.
static Filter makeDerivative(int radius, double deviation, int order, double scale)
{
    Filter filter = {.radius = radius};
    double weights[2 * maxRadius + 1], positive = 0.0, negative = 0.0;
    for (int x = -radius; x <= radius; ++x) {
        double slope = order == 1 ? -x : x * x / (deviation * deviation) - 1.0;
        double weight = slope * exp(-x * x / (2.0 * deviation * deviation));
        positive += weight > 0.0 ? weight : 0.0;
        negative -= weight < 0.0 ? weight : 0.0;
        weights[x + radius] = weight;
    }
    for (int i = 0; i <= 2 * radius; ++i) {
        filter.weights[i] = (float)(scale * weights[i] / (weights[i] > 0.0 ? positive : negative));
    }
    return filter;
}

/// Contrast sensitivity (the paper's a1 b1 a2 b2 of the three channels) and features (width 0.082
/// degrees), at so many pixels a degree.
static Filters makeFilters(double pixelsPerDegree)
{
    const double pi = 3.14159265358979323846;
    const double perPixel = pi * pi / (pixelsPerDegree * pixelsPerDegree);
    const int radius = (int)ceil(3.0 * sqrt(0.04 / (2.0 * pi * pi)) * pixelsPerDegree);
    const double a[2] = {34.1, 13.5}, b[2] = {0.04, 0.025};

    // Each Gaussian's part of the sum over the sampled square, so that the two together sum to one.
    double part[2];
    for (int i = 0; i < 2; ++i) {
        double line = 0.0;
        for (int x = -radius; x <= radius; ++x) {
            line += exp(-perPixel / b[i] * x * x);
        }
        part[i] = a[i] * sqrt(pi / b[i]) * line * line;
    }
    const double total = part[0] + part[1];
    const double deviation = 0.5 * 0.082 * pixelsPerDegree;
    const int reach = (int)ceil(3.0 * deviation);
    return (Filters){
        .achromatic = makeGaussian(radius, perPixel / 0.0047, 1.0),
        .redGreen = makeGaussian(radius, perPixel / 0.0053, 1.0),
        .blueYellow = {makeGaussian(radius, perPixel / b[0], part[0] / total),
                       makeGaussian(radius, perPixel / b[1], part[1] / total)},
        .smooth = makeGaussian(reach, 1.0 / (2.0 * deviation * deviation), 1.0),
        .edge = makeDerivative(reach, deviation, 1, 1.0 / 116.0),
        .point = makeDerivative(reach, deviation, 2, 1.0 / 116.0),
    };
}

static float* scratchPlane(const Raster* raster, int index)
{
    return raster->scratch + (size_t)index * raster->area;
}

/// Rows then columns, the border pixel repeated outside. Uses planeTemporary; `to` may be `from`.
static void filterPlane(const Raster* raster, const Filter* rows, const Filter* columns, const float* from,
                        float* to)
{
    const int width = raster->width, height = raster->height;
    float* temporary = scratchPlane(raster, planeTemporary);
    for (int y = 0; y < height; ++y) {
        const float* in = from + (size_t)y * (size_t)width;
        float* out = temporary + (size_t)y * (size_t)width;
        for (int x = 0; x < width + 2 * rows->radius; ++x) {
            int column = x - rows->radius;
            raster->line[x] = in[column < 0 ? 0 : column < width ? column : width - 1];
        }
        memset(out, 0, sizeof(float) * (size_t)width);
        for (int i = 0; i <= 2 * rows->radius; ++i) {
            const float weight = rows->weights[i];
            for (int x = 0; x < width; ++x) {
                out[x] += weight * raster->line[x + i];
            }
        }
    }
    for (int y = 0; y < height; ++y) {
        float* out = to + (size_t)y * (size_t)width;
        memset(out, 0, sizeof(float) * (size_t)width);
        for (int i = 0; i <= 2 * columns->radius; ++i) {
            const float weight = columns->weights[i];
            int row = y + i - columns->radius;
            row = row < 0 ? 0 : row < height ? row : height - 1;
            const float* in = temporary + (size_t)row * (size_t)width;
            for (int x = 0; x < width; ++x) {
                out[x] += weight * in[x];
            }
        }
    }
}

/// Strength of the feature that `derivative` answers to, whatever its direction.
static void findFeature(const Raster* raster, const Filter* derivative, const Filter* smooth, float* strength)
{
    float* across = scratchPlane(raster, planeResult);
    filterPlane(raster, derivative, smooth, scratchPlane(raster, planeY), strength);
    filterPlane(raster, smooth, derivative, scratchPlane(raster, planeY), across);
    for (size_t i = 0; i < raster->area; ++i) {
        strength[i] = sqrtf(strength[i] * strength[i] + across[i] * across[i]);
    }
}

/// `first`: the band's first pixel in the picture.
static void splitChannels(const Raster* raster, const Picture* picture, size_t first)
{
    for (size_t i = 0; i < raster->area; ++i) {
        float shown[3], v[3];
        for (size_t c = 0; c < 3; ++c) {
            const float value = picture->linear != NULL
                                    ? picture->linear[3 * (first + i) + c]
                                    : picture->decoded[picture->bytes[picture->channels * (first + i) + c]];
            shown[c] = value > 0.0f ? fminf(value, 1.0f) : 0.0f;
        }
        relativeXyz(shown, v);
        vtVec3 channels = opponent(v);
        scratchPlane(raster, planeY)[i] = channels.x;
        scratchPlane(raster, planeCx)[i] = channels.y;
        scratchPlane(raster, planeCz)[i] = channels.z;
    }
}

/// Back from the filtered YCxCz to a colour that a display has, then to Hunt-adjusted L*a*b*.
static void fillLab(const Raster* raster, float* seen)
{
    for (size_t i = 0; i < raster->area; ++i) {
        float y = (scratchPlane(raster, planeY)[i] + 16.0f) / 116.0f;
        float xyz[3] = {white[0] * (y + scratchPlane(raster, planeCx)[i] / 500.0f), y,
                        white[2] * (y - scratchPlane(raster, planeCz)[i] / 200.0f)};
        float rgb[3];
        for (int c = 0; c < 3; ++c) {
            const float* row = rgbOfXyz[c];
            rgb[c] = vtClamp(row[0] * xyz[0] + row[1] * xyz[1] + row[2] * xyz[2], 0.0f, 1.0f);
        }
        vtVec3 lab = huntLab(rgb);
        seen[planeL * raster->area + i] = lab.x;
        seen[planeA * raster->area + i] = lab.y;
        seen[planeB * raster->area + i] = lab.z;
    }
}

static void see(const Raster* raster, const Filters* filters, const Picture* picture, size_t first,
                float* seen)
{
    splitChannels(raster, picture, first);

    // Find edges and points before the spatial filters blur them.
    findFeature(raster, &filters->edge, &filters->smooth, seen + planeEdge * raster->area);
    findFeature(raster, &filters->point, &filters->smooth, seen + planePoint * raster->area);

    // Remove what cannot be seen at this distance.
    float *y = scratchPlane(raster, planeY), *cx = scratchPlane(raster, planeCx);
    float *cz = scratchPlane(raster, planeCz), *second = scratchPlane(raster, planeResult);
    filterPlane(raster, &filters->achromatic, &filters->achromatic, y, y);
    filterPlane(raster, &filters->redGreen, &filters->redGreen, cx, cx);
    filterPlane(raster, &filters->blueYellow[1], &filters->blueYellow[1], cz, second);
    filterPlane(raster, &filters->blueYellow[0], &filters->blueYellow[0], cz, cz);
    for (size_t i = 0; i < raster->area; ++i) {
        cz[i] += second[i];
    }
    fillLab(raster, seen);
}

/// Differences up to 0.4 of the largest one take 0 to 0.95 of the scale, the rest what is left.
static float redistribute(float difference, float largest)
{
    const float knee = 0.4f * largest;
    return difference < knee ? 0.95f / knee * difference
                             : 0.95f + 0.05f * (difference - knee) / (largest - knee);
}

/// The sum over a part of the band.
static double combine(const Raster* raster, size_t first, size_t end, const float* p, const float* q,
                      float* map)
{
    const size_t area = raster->area;
    const float largest =
        powf(hyab(huntLab((float[]){0.0f, 1.0f, 0.0f}), huntLab((float[]){0.0f, 0.0f, 1.0f})), 0.7f);
    double sum = 0.0;
    for (size_t i = first; i < end; ++i) {
        vtVec3 labP = {p[planeL * area + i], p[planeA * area + i], p[planeB * area + i]};
        vtVec3 labQ = {q[planeL * area + i], q[planeA * area + i], q[planeB * area + i]};
        float colour = redistribute(powf(hyab(labP, labQ), 0.7f), largest);
        float edge = fabsf(p[planeEdge * area + i] - q[planeEdge * area + i]);
        float point = fabsf(p[planePoint * area + i] - q[planePoint * area + i]);
        float feature = sqrtf(fmaxf(edge, point) * sqrtf(0.5f));
        float difference = powf(colour, 1.0f - feature);
        sum += (double)difference;
        if (map != NULL) {
            map[i - first] = difference;
        }
    }
    return sum;
}

static vtResult measure(const Picture pictures[2], int width, int height, double pixelsPerDegree,
                        double* mean, float* map, vtError* error)
{
    assert(width > 0 && height > 0 && pixelsPerDegree >= 1.0 && pixelsPerDegree <= 400.0);
    const Filters filters = makeFilters(pixelsPerDegree);
    const int reach =
        filters.achromatic.radius > filters.edge.radius ? filters.achromatic.radius : filters.edge.radius;
    const int rows = mostPixels / width > leastRows ? mostPixels / width : leastRows;
    const size_t across = (size_t)width;
    const size_t mostArea = across * (size_t)(height < rows + 2 * reach ? height : rows + 2 * reach);
    Raster raster = {.width = width};
    raster.scratch = malloc(sizeof(float) * scratchPlanes * mostArea);
    raster.line = malloc(sizeof(float) * (across + 2 * maxRadius));
    float* seen = malloc(sizeof(float) * 2 * seenPlanes * mostArea);
    vtResult result = vt_ok;
    if (raster.scratch == NULL || raster.line == NULL || seen == NULL) {
        result = vtFail(error, vt_errorMemory, "FLIP: out of memory for %d x %d", width, height);
    } else {
        double sum = 0.0;
        for (int first = 0; first < height; first += rows) {
            const int end = height - first < rows ? height : first + rows;
            const int top = first < reach ? 0 : first - reach;
            raster.height = (height - end < reach ? height : end + reach) - top;
            raster.area = across * (size_t)raster.height;
            float* other = seen + seenPlanes * raster.area;
            see(&raster, &filters, &pictures[0], across * (size_t)top, seen);
            see(&raster, &filters, &pictures[1], across * (size_t)top, other);
            sum += combine(&raster, across * (size_t)(first - top), across * (size_t)(end - top), seen, other,
                           map != NULL ? map + across * (size_t)first : NULL);
        }
        *mean = sum / ((double)width * (double)height);
        vtSucceed(error);
    }
    free(raster.scratch);
    free(raster.line);
    free(seen);
    return result;
}

vtResult vtMeasureFlip(const float* reference, const float* test, int width, int height,
                       double pixelsPerDegree, double* mean, float* map, vtError* error)
{
    const Picture pictures[2] = {{.linear = reference}, {.linear = test}};
    return measure(pictures, width, height, pixelsPerDegree, mean, map, error);
}

vtResult vtMeasureFlipBytes(const uint8_t* reference, const uint8_t* test, int channels, int width,
                            int height, double pixelsPerDegree, double* mean, float* map, vtError* error)
{
    float decoded[256];
    for (int i = 0; i < 256; ++i) {
        decoded[i] = vtSrgbToLinear((float)i / 255.0f);
    }
    const Picture picture = {.channels = (size_t)channels, .decoded = decoded};
    Picture pictures[2] = {picture, picture};
    pictures[0].bytes = reference;
    pictures[1].bytes = test;
    return measure(pictures, width, height, pixelsPerDegree, mean, map, error);
}
