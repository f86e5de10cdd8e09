#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/limit_options.h"
#include "image/image.h"
#include "image/pfm.h"
#include "lab/metrics/metrics.h"
#include "lab/metrics/metrics_image.h"
#include "lab/metrics/metrics_map.h"

typedef struct Request {
    const char* paths[2]; // the result, the truth
    const char* difference;
    const char* events;
    int threshold;
    vtLimits limits; // 0 where not given
    bool json, help;
} Request;

/// A PFM whose pixels are all unit vectors, (0,0,0) or (2,2,2) holds directions; one of zeros only may be
/// either; all else is a picture.
typedef enum Content { contentPicture, contentDirections, contentEither } Content;

typedef struct Input {
    float* pixels; // linear RGB or directions
    int width, height;
    Content content;
} Input;

static void printHelp(void)
{
    printf(
        "vitrine compare A B [options]; A is the result, B the truth it is held against\n"
        "\n"
        "Pictures (.png, .jpg, .exr, .hdr or .pfm, compared as 8-bit sRGB): PSNR, SSIM, mean FLIP at 67\n"
        "pixels a degree, pixels over a threshold. Direction images (.pfm of 'vitrine render "
        "--directions'):\n"
        "shares within 0.1, 1 and 5 degrees, median, lost. - is standard input.\n"
        "\n"
        "      --json                           one JSON object instead of text; psnr is null where equal\n"
        "      --difference FILE                difference picture, PNG: FLIP in magma, or the angle from\n"
        "                                       0 (blue) to 5 degrees (red), lost magenta\n"
        "      --threshold N                    count pixels with a channel off by more than N (2), 0 to "
        "254\n"
        "      --events FILE                    split directions by the true path's number of events: an\n"
        "                                       8-bit grey PNG of the same size, one count a pixel\n"
        "      --max-memory SIZE                a file that asks for more than this is refused, as 512M "
        "(4G)\n"
        "      --max-pixels N                   a picture of more is not read (67108864, 8192 x 8192)\n"
        "  -h, --help                           this text\n");
}

static vtResult readThreshold(const char* text, int* threshold, vtError* error)
{
    char* end;
    long value = strtol(text, &end, 10);
    if (end == text || *end != '\0' || value < 0 || value > 254) {
        return vtFail(error, vt_errorArgument, "--threshold is '%s'; it must be a whole number from 0 to 254",
                      text);
    }
    *threshold = (int)value;
    return vt_ok;
}

static vtResult readRequest(int count, char** words, Request* request, vtError* error)
{
    static const struct option options[] = {
        {"json", no_argument, NULL, 'j'},
        {"difference", required_argument, NULL, 'd'},
        {"threshold", required_argument, NULL, 't'},
        {"events", required_argument, NULL, 'e'},
        {"max-memory", required_argument, NULL, 'm'},
        {"max-pixels", required_argument, NULL, 'p'},
        {"help", no_argument, NULL, 'h'},
        {NULL, 0, NULL, 0},
    };
    *request = (Request){.threshold = 2};
    opterr = 0;
    optind = 1;
    int code;
    while ((code = getopt_long(count, words, ":h", options, NULL)) != -1) {
        vtResult result = vt_ok;
        switch (code) {
        case 'j':
            request->json = true;
            break;
        case 'd':
            request->difference = optarg;
            break;
        case 't':
            result = readThreshold(optarg, &request->threshold, error);
            break;
        case 'e':
            request->events = optarg;
            break;
        case 'm':
        case 'p':
            result = vtReadLimit(code == 'm' ? "max-memory" : "max-pixels", optarg, &request->limits, error);
            break;
        case 'h':
            request->help = true;
            return vt_ok;
        default:
            result = vtFail(error, vt_errorArgument, "%s option %s; see 'vitrine compare --help'",
                            code == ':' ? "no value for" : "unknown", words[optind - 1]);
            break;
        }
        if (result != vt_ok) {
            return result;
        }
    }
    if (count - optind != 2) {
        return vtFail(
            error, vt_errorArgument,
            "two files are compared, the result and the truth; %d given; see 'vitrine compare --help'",
            count - optind);
    }
    if (request->difference != NULL && strcmp(request->difference, "-") == 0) {
        return vtFail(error, vt_errorArgument,
                      "--difference is -, but standard output carries the numbers; "
                      "name a file");
    }
    request->paths[0] = words[optind];
    request->paths[1] = words[optind + 1];
    return vt_ok;
}

static Content classify(const float* pixels, size_t count)
{
    bool allZero = true;
    for (size_t i = 0; i < count; ++i) {
        const float* p = pixels + 3 * i;
        vtDirectionKind kind = vtClassifyDirection(p);
        float length = sqrtf(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        if (kind == vt_directionExit && !(fabsf(length - 1.0f) < 0.01f)) {
            return contentPicture;
        }
        allZero = allZero && kind == vt_directionBackground;
    }
    return allZero ? contentEither : contentDirections;
}

static vtResult loadInput(const char* path, const vtLimits* limits, Input* input, vtError* error)
{
    uint8_t* bytes;
    size_t size;
    vtResult result = vtReadInput(path, limits, &bytes, &size, error);
    if (result != vt_ok) {
        return result;
    }
    result = vtCheckPicture(bytes, size, path, limits, 3 * sizeof(float), NULL, error);
    if (result != vt_ok) {
        vtFree(bytes);
        return result;
    }
    if (size >= 2 && memcmp(bytes, "PF", 2) == 0) {
        result = vtDecodePfm(bytes, size, path, &input->pixels, &input->width, &input->height, error);
        if (result == vt_ok) {
            input->content = classify(input->pixels, (size_t)input->width * (size_t)input->height);
        }
    } else {
        result = vtDecodeImageLinear(bytes, size, path, &input->pixels, &input->width, &input->height, error);
    }
    vtFree(bytes);
    return result;
}

/// Counts as they stand in the file: the decoder's conversion to linear is undone, exactly for 8 bits.
static vtResult loadEvents(const char* path, const vtLimits* limits, const Input* truth, uint8_t** events,
                           vtError* error)
{
    Input image = {0};
    vtResult result = loadInput(path, limits, &image, error);
    if (result != vt_ok) {
        return result;
    }
    const size_t count = (size_t)image.width * (size_t)image.height;
    if (image.width != truth->width || image.height != truth->height) {
        result = vtFail(error, vt_errorFormat, "%s has %d x %d event counts for %d x %d pixels", path,
                        image.width, image.height, truth->width, truth->height);
    } else if ((*events = malloc(count)) == NULL) {
        result =
            vtFail(error, vt_errorMemory, "%s: out of memory for %d x %d", path, image.width, image.height);
    }
    for (size_t i = 0; i < count && result == vt_ok; ++i) {
        const float* p = image.pixels + 3 * i;
        if (!(p[0] == p[1] && p[1] == p[2])) {
            result =
                vtFail(error, vt_errorFormat, "%s is coloured; event counts are an 8-bit grey PNG", path);
            break;
        }
        (*events)[i] = (uint8_t)(255.0f * fminf(fmaxf(vtLinearToSrgb(p[0]), 0.0f), 1.0f) + 0.5f);
    }
    vtFree(image.pixels);
    return result;
}

static vtResult writeDifference(const char* path, const uint8_t* rgb, const Input* size, vtError* error)
{
    uint8_t* bytes = NULL;
    size_t length;
    vtResult result = vtEncodePng(rgb, 3, size->width, size->height, &bytes, &length, error);
    if (result == vt_ok) {
        result = vtWriteFile(path, bytes, length, error);
    }
    vtFree(bytes);
    return result;
}

static void printPictureJson(const Request* request, const Input* size, const vtPictureError* measured)
{
    const size_t over = vtPictureError_CountOver(measured, request->threshold);
    vtJson json = {.out = stdout};
    vtJson_BeginObject(&json, NULL);
    vtJson_Text(&json, "kind", "pictures");
    vtJson_Integer(&json, "width", size->width);
    vtJson_Integer(&json, "height", size->height);
    vtJson_Number(&json, "psnr", measured->psnr, 4);
    vtJson_Number(&json, "ssim", measured->ssim, 6);
    vtJson_Number(&json, "flip", measured->flip, 6);
    vtJson_Integer(&json, "threshold", request->threshold);
    vtJson_Integer(&json, "pixelsOver", (long long)over);
    vtJson_Number(&json, "shareOver", (double)over / (double)measured->pixels, 6);
    vtJson_Integer(&json, "largestDifference", measured->largest);
    vtJson_EndObject(&json);
    putchar('\n');
}

static void printPictureError(const Request* request, const vtPictureError* measured)
{
    const size_t over = vtPictureError_CountOver(measured, request->threshold);
    char psnr[32] = "equal";
    if (isfinite(measured->psnr)) {
        snprintf(psnr, sizeof psnr, "%.2f dB", measured->psnr);
    }
    printf("PSNR       %s\n"
           "SSIM       %.5f\n"
           "FLIP mean  %.5f\n"
           "over %-3d   %zu of %zu pixels, %.2f %%; largest difference %d of 255\n",
           psnr, measured->ssim, measured->flip, request->threshold, over, measured->pixels,
           100.0 * (double)over / (double)measured->pixels, measured->largest);
}

static vtResult comparePictures(const Request* request, const Input inputs[2], vtError* error)
{
    const size_t count = (size_t)inputs[0].width * (size_t)inputs[0].height;
    if (request->events != NULL) {
        return vtFail(error, vt_errorArgument, "--events splits direction images, but %s and %s are pictures",
                      request->paths[0], request->paths[1]);
    }
    vtPictureError measured;
    const bool isDrawn = request->difference != NULL;
    float* flipMap = isDrawn ? malloc(sizeof(float) * count) : NULL;
    uint8_t* rgb = isDrawn ? malloc(3 * count) : NULL;
    vtResult result = vt_ok;
    if (isDrawn && (flipMap == NULL || rgb == NULL)) {
        result = vtFail(error, vt_errorMemory, "comparison: out of memory for %zu pixels", count);
    }
    if (result == vt_ok) {
        result = vtComparePictures(inputs[0].pixels, inputs[1].pixels, inputs[0].width, inputs[0].height,
                                   &measured, flipMap, error);
    }
    if (result == vt_ok && isDrawn) {
        vtDrawFlip(flipMap, count, rgb);
        result = writeDifference(request->difference, rgb, inputs, error);
    }
    if (result == vt_ok) {
        if (request->json) {
            printPictureJson(request, inputs, &measured);
        } else {
            printPictureError(request, &measured);
        }
    }
    free(flipMap);
    free(rgb);
    return result;
}

/// The whole, its paths of up to 4 events (what methods are judged by) and up to 6 (of several objects), and
/// the groups.
typedef struct DirectionReport {
    vtDirectionError all, upTo4, upTo6, groups[VT_EVENT_GROUPS];
    bool split;
} DirectionReport;

static void writeShares(vtJson* json, const vtDirectionError* e)
{
    vtJson_Integer(json, "pixels", (long long)e->pixels);
    vtJson_Number(json, "within01", e->within01, 6);
    vtJson_Number(json, "within1", e->within1, 6);
    vtJson_Number(json, "within5", e->within5, 6);
    vtJson_Number(json, "median", e->median, 6);
    vtJson_Number(json, "lost", e->lost, 6);
    vtJson_Integer(json, "maskErrors", (long long)e->maskErrors);
}

static void writeSharesOf(vtJson* json, const char* name, const vtDirectionError* e)
{
    vtJson_BeginObject(json, name);
    writeShares(json, e);
    vtJson_EndObject(json);
}

static void printJsonReport(const Input* size, const DirectionReport* report)
{
    vtJson json = {.out = stdout};
    vtJson_BeginObject(&json, NULL);
    vtJson_Text(&json, "kind", "directions");
    vtJson_Integer(&json, "width", size->width);
    vtJson_Integer(&json, "height", size->height);
    writeShares(&json, &report->all);
    if (report->split) {
        writeSharesOf(&json, "upTo4Events", &report->upTo4);
        writeSharesOf(&json, "upTo6Events", &report->upTo6);
        vtJson_BeginArray(&json, "byEvents");
        for (int i = 0; i < VT_EVENT_GROUPS; ++i) {
            const vtEventRange range = vtEventGroup(i);
            vtJson_BeginObject(&json, NULL);
            vtJson_Integer(&json, "from", range.low);
            vtJson_Number(&json, "to", range.high == 255 ? (double)INFINITY : range.high, 0);
            writeShares(&json, &report->groups[i]);
            vtJson_EndObject(&json);
        }
        vtJson_EndArray(&json);
    }
    vtJson_EndObject(&json);
    putchar('\n');
}

static void printRow(const char* name, const vtDirectionError* e)
{
    printf("%-12s %9zu %9.2f %% %8.2f %% %8.2f %% %9.4f %8.2f %%\n", name, e->pixels, 100.0 * e->within01,
           100.0 * e->within1, 100.0 * e->within5, e->median, 100.0 * e->lost);
}

static void printTextReport(const DirectionReport* report)
{
    printf("%-12s %9s %11s %10s %10s %9s %10s\n", "", "pixels", "<= 0.1 deg", "<= 1 deg", "<= 5 deg",
           "median", "lost");
    printRow("all", &report->all);
    if (report->split) {
        printRow("1-4 events", &report->upTo4);
        printRow("1-6 events", &report->upTo6);
        for (int i = 0; i < VT_EVENT_GROUPS; ++i) {
            vtEventRange range = vtEventGroup(i);
            char name[24];
            snprintf(name, sizeof name, range.high == 255 ? "%d+ events" : "%d-%d events", range.low,
                     range.high);
            printRow(name, &report->groups[i]);
        }
    }
    printf("glass in one, background in the other: %zu pixels\n", report->all.maskErrors);
}

static vtResult measureDirections(const Request* request, const Input inputs[2], DirectionReport* report,
                                  vtError* error)
{
    const float *directions = inputs[0].pixels, *truth = inputs[1].pixels;
    const size_t count = (size_t)inputs[0].width * (size_t)inputs[0].height;
    uint8_t* events = NULL;
    vtResult result = vtCompareDirections(directions, truth, count, &report->all, error);
    if (result == vt_ok && request->events != NULL) {
        result = loadEvents(request->events, &request->limits, &inputs[1], &events, error);
        report->split = result == vt_ok;
    }
    if (report->split) {
        result = vtCompareDirectionsOfEvents(directions, truth, events, count, (vtEventRange){1, 4},
                                             &report->upTo4, error);
    }
    if (report->split && result == vt_ok) {
        result = vtCompareDirectionsOfEvents(directions, truth, events, count, (vtEventRange){1, 6},
                                             &report->upTo6, error);
    }
    for (int i = 0; i < VT_EVENT_GROUPS && report->split && result == vt_ok; ++i) {
        result = vtCompareDirectionsOfEvents(directions, truth, events, count, vtEventGroup(i),
                                             &report->groups[i], error);
    }
    free(events);
    return result;
}

static vtResult compareDirections(const Request* request, const Input inputs[2], vtError* error)
{
    DirectionReport report = {0};
    vtResult result = measureDirections(request, inputs, &report, error);
    if (result == vt_ok && request->difference != NULL) {
        const size_t count = (size_t)inputs[0].width * (size_t)inputs[0].height;
        uint8_t* rgb = malloc(3 * count);
        if (rgb == NULL) {
            return vtFail(error, vt_errorMemory, "comparison: out of memory for %zu pixels", count);
        }
        vtDrawDirectionDifference(inputs[0].pixels, inputs[1].pixels, count, rgb);
        result = writeDifference(request->difference, rgb, inputs, error);
        free(rgb);
    }
    if (result == vt_ok) {
        if (request->json) {
            printJsonReport(inputs, &report);
        } else {
            printTextReport(&report);
        }
    }
    return result;
}

static vtResult compareInputs(const Request* request, const Input inputs[2], vtError* error)
{
    if (inputs[0].width != inputs[1].width || inputs[0].height != inputs[1].height) {
        return vtFail(error, vt_errorArgument, "%s is %d x %d and %s is %d x %d; only equal sizes compare",
                      request->paths[0], inputs[0].width, inputs[0].height, request->paths[1],
                      inputs[1].width, inputs[1].height);
    }
    Content a = inputs[0].content, b = inputs[1].content;
    if (a != contentEither && b != contentEither && a != b) {
        int directions = a == contentDirections ? 0 : 1;
        return vtFail(error, vt_errorArgument, "%s holds directions and %s a picture; only like compares",
                      request->paths[directions], request->paths[1 - directions]);
    }
    return a == contentPicture || b == contentPicture ? comparePictures(request, inputs, error)
                                                      : compareDirections(request, inputs, error);
}

vtResult vtRunCompare(int count, char** words, vtError* error)
{
    Request request;
    vtResult result = readRequest(count, words, &request, error);
    if (result != vt_ok) {
        return result;
    }
    if (request.help) {
        printHelp();
        return vtSucceed(error);
    }
    Input inputs[2] = {0};
    for (int i = 0; i < 2 && result == vt_ok; ++i) {
        result = loadInput(request.paths[i], &request.limits, &inputs[i], error);
    }
    if (result == vt_ok) {
        result = compareInputs(&request, inputs, error);
    }
    vtFree(inputs[0].pixels);
    vtFree(inputs[1].pixels);
    return result;
}
