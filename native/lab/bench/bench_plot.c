// A sweep as a picture: time over triangles, pixels, objects or samples, both logarithmic; a line for each
// technique's strict paths, and a dashed one for its default picture.
#include <math.h>
#include <string.h>

#include "lab/bench/bench.h"

// Of the picture, in pixels.
static const double width = 760.0, height = 460.0, left = 70.0, right = 150.0, top = 20.0, bottom = 50.0;

typedef struct Axes {
    double low[2], high[2]; // log10 of triangles, pixels, objects or samples, of milliseconds
} Axes;

static double variable(const vtBench* bench, const vtBenchCase* measured)
{
    return vtSweepsObjects(bench->sweep)       ? (double)measured->copies
           : bench->sweep == vt_sweepRelief    ? (double)measured->samples
           : bench->sweep == vt_sweepTriangles ? (double)measured->triangles
                                               : (double)measured->width * (double)measured->height;
}

/// Where processors draw, their time is what other programs disturb least.
static bool takesProcessorTime(const vtBench* bench)
{
    return strstr(bench->device, "llvmpipe") != NULL;
}

/// Lines: the rows' strict paths, their default pictures, and the reference's two of the same.
static int lineCount(const vtBench* bench)
{
    return 2 * bench->rowCount + 2;
}

static bool isReference(const vtBench* bench, int line)
{
    return line >= 2 * bench->rowCount;
}

static bool isPicture(const vtBench* bench, int line)
{
    return isReference(bench, line) ? line > 2 * bench->rowCount : line >= bench->rowCount;
}

/// 0: it was not measured.
static double timeOf(const vtBench* bench, const vtBenchCase* measured, int line)
{
    const vtTracedTiming* traced = &measured->traced;
    const bool picture = isPicture(bench, line);
    const vtBenchRow* row = &measured->rows[line % bench->rowCount];
    const vtTiming* time = isReference(bench, line) ? picture ? &traced->picture : &traced->directions
                           : picture                ? &row->pictureTime
                                                    : &row->time;
    return takesProcessorTime(bench) ? time->processor : time->wall;
}

static double across(const Axes* axes, double value)
{
    return left + (log10(value) - axes->low[0]) / (axes->high[0] - axes->low[0]) * (width - left - right);
}

static double down(const Axes* axes, double value)
{
    return top + (axes->high[1] - log10(value)) / (axes->high[1] - axes->low[1]) * (height - top - bottom);
}

static Axes fitAxes(const vtBench* bench)
{
    Axes axes = {{1e9, 1e9}, {-1e9, -1e9}};
    for (int i = 0; i < bench->caseCount; ++i) {
        for (int line = 0; line < lineCount(bench); ++line) {
            if (timeOf(bench, &bench->cases[i], line) == 0.0) {
                continue;
            }
            const double point[2] = {log10(variable(bench, &bench->cases[i])),
                                     log10(timeOf(bench, &bench->cases[i], line))};
            for (int k = 0; k < 2; ++k) {
                axes.low[k] = fmin(axes.low[k], point[k]);
                axes.high[k] = fmax(axes.high[k], point[k]);
            }
        }
    }
    axes.low[1] = floor(axes.low[1]);
    axes.high[1] = fmax(ceil(axes.high[1]), axes.low[1] + 1.0);
    axes.high[0] = fmax(axes.high[0], axes.low[0] + 0.1);
    return axes;
}

static void writeGrid(const vtBench* bench, const Axes* axes, FILE* out)
{
    static const double steps[] = {1.0, 2.0, 5.0};
    for (int decade = (int)axes->low[1]; decade <= (int)axes->high[1]; ++decade) {
        for (int i = 0; i < 3; ++i) {
            const double value = steps[i] * pow(10.0, decade), y = down(axes, value);
            if (y < top - 0.5) {
                continue;
            }
            fprintf(out,
                    "<path d=\"M%.1f %.1fH%.1f\" stroke=\"%s\"/><text x=\"%.1f\" y=\"%.1f\" "
                    "text-anchor=\"end\">%g ms</text>\n",
                    left, y, width - right, i == 0 ? "#bbb" : "#e6e6e6", left - 6.0, y + 4.0, value);
        }
    }
    for (int i = 0; i < bench->caseCount; ++i) {
        const vtBenchCase* measured = &bench->cases[i];
        const double x = across(axes, variable(bench, measured));
        fprintf(out,
                "<path d=\"M%.1f %.1fV%.1f\" stroke=\"#e6e6e6\"/><text x=\"%.1f\" y=\"%.1f\" "
                "text-anchor=\"middle\">",
                x, top, height - bottom, x, height - bottom + 18.0);
        if (bench->sweep == vt_sweepResolution) {
            fprintf(out, "%d x %d</text>\n", measured->width, measured->height);
        } else {
            fprintf(out, "%.0f</text>\n", variable(bench, measured));
        }
    }
    fprintf(out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%s, %s</text>\n",
            0.5 * (left + width - right), height - 8.0,
            takesProcessorTime(bench) ? "CPU time of a frame" : "time of a frame",
            bench->sweep == vt_sweepTriangles    ? "by triangles"
            : bench->sweep == vt_sweepResolution ? "by pixels"
            : bench->sweep == vt_sweepDepth      ? "by objects, one behind the other"
            : bench->sweep == vt_sweepRelief     ? "by samples along a side of the relief"
                                                 : "by objects");
}

static void writeLine(const vtBench* bench, const Axes* axes, int line, double labelY, FILE* out)
{
    static const char* const colors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};
    const bool reference = isReference(bench, line), picture = isPicture(bench, line);
    const int row = line % bench->rowCount;
    const char* color = reference ? "#000" : colors[row % 6];
    fprintf(out, "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"2\"%s points=\"", color,
            picture ? " stroke-dasharray=\"6 4\"" : "");
    for (int i = 0; i < bench->caseCount; ++i) {
        if (timeOf(bench, &bench->cases[i], line) == 0.0) {
            continue;
        }
        fprintf(out, "%.1f,%.1f ", across(axes, variable(bench, &bench->cases[i])),
                down(axes, timeOf(bench, &bench->cases[i], line)));
    }
    fprintf(out, "\"/>\n");
    for (int i = 0; i < bench->caseCount; ++i) {
        if (timeOf(bench, &bench->cases[i], line) == 0.0) {
            continue;
        }
        fprintf(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"%s\"/>",
                across(axes, variable(bench, &bench->cases[i])),
                down(axes, timeOf(bench, &bench->cases[i], line)), color);
    }
    fprintf(out, "\n<text x=\"%.1f\" y=\"%.1f\" fill=\"%s\">%s%s</text>\n", width - right + 10.0, labelY,
            color, reference ? "Embree" : bench->cases[0].rows[row].label, picture ? ", picture" : "");
}

/// Time of a line in the last case that it was measured in; 0: in none.
static double lastTime(const vtBench* bench, int line)
{
    double time = 0.0;
    for (int i = bench->caseCount - 1; i >= 0 && time == 0.0; --i) {
        time = timeOf(bench, &bench->cases[i], line);
    }
    return time;
}

/// The line of the longest last time among those not written yet; -1: none is left.
static int findNext(const vtBench* bench, const bool* written)
{
    int next = -1;
    for (int line = 0; line < lineCount(bench); ++line) {
        const double time = written[line] ? 0.0 : lastTime(bench, line);
        if (time > 0.0 && (next < 0 || time > lastTime(bench, next))) {
            next = line;
        }
    }
    return next;
}

void vtBench_WritePlot(const vtBench* bench, FILE* out)
{
    const Axes axes = fitAxes(bench);
    fprintf(out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %g %g\" font-family=\"sans-serif\" "
            "font-size=\"12\">\n<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n",
            width, height);
    writeGrid(bench, &axes, out);
    // Lines in the order of their last points, from the top, so that labels need only be kept apart
    // downwards.
    bool written[2 * vt_maxBenchRows + 2] = {false};
    double lowest = top;
    for (int next = findNext(bench, written); next >= 0; next = findNext(bench, written)) {
        written[next] = true;
        lowest = fmax(lowest + 15.0, down(&axes, lastTime(bench, next)) + 4.0);
        writeLine(bench, &axes, next, lowest, out);
    }
    fprintf(out, "</svg>\n");
}
