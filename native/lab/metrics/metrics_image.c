// SSIM is based on: Zhou Wang, Alan C. Bovik, Hamid R. Sheikh and Eero P. Simoncelli. Image Quality
// Assessment: From Error Visibility to Structural Similarity. IEEE Trans. Image Processing 13(4), 2004.
// Departure: colour pictures are compared by their luma, which is not rounded to whole codes.
#include "lab/metrics/metrics_image.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

#include "base/error.h"
#include "image/image.h"

enum { windowSize = 11 };

typedef struct Window {
    int size;
    double weights[windowSize];
} Window;

/// What a window needs: sums of a, b, a^2, b^2 and ab.
enum { sumA, sumB, sumAA, sumBB, sumAB, sumCount };

static Window makeWindow(int width, int height)
{
    const double deviation = 1.5;
    int fits = width < height ? width : height;
    Window window = {.size = fits >= windowSize ? windowSize : fits - (fits + 1) % 2};
    double sum = 0.0;
    for (int i = 0; i < window.size; ++i) {
        double x = i - window.size / 2;
        window.weights[i] = exp(-x * x / (2.0 * deviation * deviation));
        sum += window.weights[i];
    }
    for (int i = 0; i < window.size; ++i) {
        window.weights[i] /= sum;
    }
    return window;
}

static double luma(const uint8_t* rgb)
{
    return 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
}

/// Weighted sums along one row of pixels, one entry a window: sumCount numbers each.
static void sumRow(const Window* window, const uint8_t* a, const uint8_t* b, int channels, int columns,
                   double* sums)
{
    for (int x = 0; x < columns; ++x) {
        double* sum = sums + sumCount * (size_t)x;
        for (int s = 0; s < sumCount; ++s) {
            sum[s] = 0.0;
        }
        for (int i = 0; i < window->size; ++i) {
            const size_t offset = (size_t)channels * (size_t)(x + i);
            double weight = window->weights[i], p = luma(a + offset), q = luma(b + offset);
            sum[sumA] += weight * p;
            sum[sumB] += weight * q;
            sum[sumAA] += weight * p * p;
            sum[sumBB] += weight * q * q;
            sum[sumAB] += weight * p * q;
        }
    }
}

static double similarity(const double sum[sumCount])
{
    const double c1 = (0.01 * 255.0) * (0.01 * 255.0), c2 = (0.03 * 255.0) * (0.03 * 255.0);
    double meanA = sum[sumA], meanB = sum[sumB];
    double varianceA = sum[sumAA] - meanA * meanA, varianceB = sum[sumBB] - meanB * meanB;
    double covariance = sum[sumAB] - meanA * meanB;
    return (2.0 * meanA * meanB + c1) * (2.0 * covariance + c2) /
           ((meanA * meanA + meanB * meanB + c1) * (varianceA + varianceB + c2));
}

static vtResult measureSsim(const uint8_t* a, const uint8_t* b, int channels, int width, int height,
                            double* ssim, vtError* error)
{
    const Window window = makeWindow(width, height);
    const int columns = width - window.size + 1, rows = height - window.size + 1;
    const size_t stride = sumCount * (size_t)columns, rowBytes = (size_t)channels * (size_t)width;
    double* sums = malloc(sizeof(double) * stride * (size_t)window.size); // a ring of rows
    if (sums == NULL) {
        return vtFail(error, vt_errorMemory, "SSIM: out of memory for %d x %d", width, height);
    }
    double total = 0.0;
    for (int y = 0; y < height; ++y) {
        sumRow(&window, a + rowBytes * (size_t)y, b + rowBytes * (size_t)y, channels, columns,
               sums + stride * (size_t)(y % window.size));
        int top = y - window.size + 1;
        for (int x = 0; x < columns && top >= 0; ++x) {
            double sum[sumCount] = {0};
            for (int i = 0; i < window.size; ++i) {
                const double* row = sums + stride * (size_t)((top + i) % window.size) + sumCount * (size_t)x;
                for (int s = 0; s < sumCount; ++s) {
                    sum[s] += window.weights[i] * row[s];
                }
            }
            total += similarity(sum);
        }
    }
    *ssim = total / ((double)columns * (double)rows);
    free(sums);
    return vt_ok;
}

/// Fills the histogram and PSNR.
static void countDifferences(const uint8_t* a, const uint8_t* b, int channels, vtPictureError* result)
{
    uint64_t squares = 0;
    for (size_t i = 0; i < result->pixels; ++i) {
        int largest = 0;
        for (size_t c = 0; c < 3; ++c) {
            const size_t at = (size_t)channels * i + c;
            int difference = abs(a[at] - b[at]);
            squares += (uint64_t)(difference * difference);
            largest = difference > largest ? difference : largest;
        }
        ++result->differences[largest];
        result->largest = largest > result->largest ? largest : result->largest;
    }
    double mean = (double)squares / (3.0 * (double)result->pixels);
    result->psnr = squares > 0 ? 10.0 * log10(255.0 * 255.0 / mean) : (double)INFINITY;
}

vtResult vtComparePictureBytes(const uint8_t* a, const uint8_t* b, int channels, int width, int height,
                               vtPictureError* result, float* flipMap, vtError* error)
{
    assert((channels == 3 || channels == 4) && width > 0 && height > 0);
    *result = (vtPictureError){.pixels = (size_t)width * (size_t)height};
    countDifferences(a, b, channels, result);
    vtResult outcome = measureSsim(a, b, channels, width, height, &result->ssim, error);
    return outcome != vt_ok ? outcome
                            : vtMeasureFlipBytes(a, b, channels, width, height, VT_FLIP_PIXELS_PER_DEGREE,
                                                 &result->flip, flipMap, error);
}

static void encodeBytes(const float* linear, size_t count, uint8_t* bytes)
{
    for (size_t i = 0; i < count; ++i) {
        float value = linear[i] > 0.0f ? fminf(linear[i], 1.0f) : 0.0f;
        bytes[i] = (uint8_t)(255.0f * vtLinearToSrgb(value) + 0.5f);
    }
}

vtResult vtComparePictures(const float* a, const float* b, int width, int height, vtPictureError* result,
                           float* flipMap, vtError* error)
{
    assert(width > 0 && height > 0);
    const size_t count = 3 * (size_t)width * (size_t)height;
    uint8_t* bytes = malloc(2 * count);
    if (bytes == NULL) {
        return vtFail(error, vt_errorMemory, "comparison: out of memory for %d x %d", width, height);
    }
    encodeBytes(a, count, bytes);
    encodeBytes(b, count, bytes + count);
    vtResult outcome = vtComparePictureBytes(bytes, bytes + count, 3, width, height, result, flipMap, error);
    free(bytes);
    return outcome;
}

size_t vtPictureError_CountOver(const vtPictureError* result, int threshold)
{
    size_t count = 0;
    for (int i = threshold + 1; i < 256; ++i) {
        count += i >= 0 ? result->differences[i] : 0;
    }
    return count;
}
