// How right each technique is: the exit directions of the built-in shapes against those that the reference
// tracer gave, which are kept in tests/directions. What a technique finds within a degree may not change by a
// point unnoticed, nor the median by a tenth. Where that is meant, what the test prints is its new table.
//
// A file of tests/directions holds the 64 x 64 directions of a shape, rows from the top, as codes of
// src/base/octahedral.h, four bytes each, the lowest first; VT_NO_NORMAL: background; LOST. With
// VITRINE_UPDATE_GOLDEN=1 in its environment this test writes them.
#include "base/octahedral.h"
#include "cli/files.h"
#include "lab/metrics/metrics.h"
#include "rendering.h"
#include "shaders_es3/common/constants.h"

enum { resolution = 64, pixelCount = resolution * resolution };

static const uint32_t LOST = 0x80008001u; // as little a direction's code as VT_NO_NORMAL

static const struct {
    vtTechnique technique;
    vtSearch search;
    vtBackSurface back;
} columns[] = {
    {.technique = vt_techniqueSingle},
    {.technique = vt_techniqueWyman},
    {.technique = vt_techniqueWyman, .back = vt_backFarthest},
    {.technique = vt_techniqueOliveira},
    {.technique = vt_techniqueLayered},
    {.technique = vt_techniqueLayered, .search = vt_searchCells},
    {.technique = vt_techniqueExact},
};
enum { columnCount = sizeof columns / sizeof columns[0] };

/// Of the pixels whose true path leaves the glass.
typedef struct Figures {
    double within1; // per cent within a degree
    double median;  // degrees
} Figures;

// The order is that of `columns`.
static const struct {
    const char* shape;
    Figures figures[columnCount];
} rows[] = {
    // clang-format off
    {"sphere", {{0.2, 17.946}, {44.7, 1.346}, {44.7, 1.346}, {99.7, 0.014}, {99.7, 0.014}, {100.0, 0.002}, {100.0, 0.001}}},
    {"torus", {{0.0, 39.996}, {6.8, 28.110}, {0.0, 53.389}, {17.1, 30.758}, {65.9, 0.349}, {82.1, 0.033}, {99.8, 0.002}}},
    {"knot", {{0.0, 16.139}, {51.3, 0.869}, {49.6, 1.042}, {78.2, 0.068}, {93.1, 0.052}, {97.2, 0.012}, {100.0, 0.001}}},
    {"goblet", {{0.0, 19.801}, {31.9, 2.037}, {12.1, 25.943}, {40.3, 1.593}, {75.4, 0.105}, {87.4, 0.009}, {100.0, 0.002}}},
    {"bottle", {{0.0, 21.066}, {21.8, 3.654}, {0.3, 33.520}, {21.6, 3.641}, {65.6, 0.152}, {74.9, 0.023}, {99.9, 0.002}}},
    {"diamond", {{0.3, 38.722}, {23.4, 34.630}, {23.4, 34.630}, {42.5, 10.764}, {74.5, 0.003}, {80.7, 0.002}, {100.0, 0.002}}},
    {"cube", {{2.0, 12.643}, {46.7, 8.796}, {46.7, 8.796}, {49.2, 8.037}, {99.4, 0.001}, {98.6, 0.001}, {100.0, 0.001}}},
    // clang-format on
};
enum { rowCount = sizeof rows / sizeof rows[0] };

static vtMesh makeShape(const char* name)
{
    vtMesh mesh;
    vtError error;
    assert_ok(vtCreateShape(name, &mesh, &error), error);
    assert_ok(vtComputeInnerDistances(&mesh, &error), error);
    return mesh;
}

static vtFrame frameOf(const vtMesh* mesh)
{
    vtFrame frame = smallFrame(vt_techniqueLayered);
    frame.width = frame.height = resolution;
    frame.layerSize = 4 * resolution;
    frame.view = vtViewOfMesh(mesh, 45.0f, 1.0f);
    return frame;
}

// ---------------------------------------------------------------------------------------------- the files

static const char* pathOf(const char* shape)
{
    static char path[1024];
    const char* folder = getenv("VITRINE_TESTS");
    snprintf(path, sizeof path, "%s/directions/%s.bin", folder != NULL ? folder : "tests", shape);
    return path;
}

static void writeDirections(const char* shape, const float* directions)
{
    uint8_t bytes[4 * pixelCount];
    vtError error;
    for (int i = 0; i < pixelCount; ++i) {
        const float* d = directions + 3 * i;
        const vtDirectionKind kind = vtClassifyDirection(d);
        const uint32_t code = kind == vt_directionBackground ? VT_NO_NORMAL
                              : kind == vt_directionLost     ? LOST
                                                             : vtPackNormal(d);
        for (int k = 0; k < 4; ++k) {
            bytes[4 * i + k] = (uint8_t)(code >> 8 * k);
        }
    }
    assert_ok(vtWriteFile(pathOf(shape), bytes, sizeof bytes, &error), error);
}

static void readDirections(const char* shape, float* directions)
{
    uint8_t* bytes;
    size_t size;
    vtError error;
    assert_ok(vtReadFile(pathOf(shape), &bytes, &size, &error), error);
    assert_int_equal(size, 4 * pixelCount);
    for (int i = 0; i < pixelCount; ++i) {
        uint32_t code = 0;
        for (int k = 0; k < 4; ++k) {
            code |= (uint32_t)bytes[4 * i + k] << 8 * k;
        }
        const float mark = code == LOST ? 2.0f : 0.0f;
        const bool isMark = code == LOST || code == VT_NO_NORMAL;
        const vtVec3 d = isMark
                             ? (vtVec3){mark, mark, mark}
                             : vtUnfoldNormal((float)(int16_t)(code & 0xffffu), (float)(int16_t)(code >> 16));
        memcpy(directions + 3 * i, &d, sizeof d);
    }
    free(bytes);
}

// ---------------------------------------------------------------------------------------------- tests

static void referenceGivesTheKeptDirections(void** state)
{
    (void)state;
    for (int row = 0; row < rowCount; ++row) {
        vtMesh mesh = makeShape(rows[row].shape);
        const vtFrame frame = frameOf(&mesh);
        vtReferenceImage truth;
        float kept[3 * pixelCount];
        vtError error;
        traceMesh(&mesh, &frame, &truth);
        vtDestroyMesh(&mesh);
        if (getenv("VITRINE_UPDATE_GOLDEN") != NULL) {
            writeDirections(rows[row].shape, truth.directions);
        }
        readDirections(rows[row].shape, kept);
        vtDirectionError result;
        assert_ok(vtCompareDirections(truth.directions, kept, pixelCount, &result, &error), error);
        print_message("  %s: %zu pixels, %.2f %% within 0.1 degrees, median %.4f\n", rows[row].shape,
                      result.pixels, 100.0 * result.within01, result.median);
        assert_int_equal(result.maskErrors, 0);
        assert_true(result.pixels > pixelCount / 10);
        assert_true(result.within01 >= 0.99); // the rest are paths of many events
        assert_true(result.median < 0.005);   // what the codes round
        vtDestroyReferenceImage(&truth);
    }
}

static void techniquesAreAsRightAsTheyWere(void** state)
{
    Fixture* fixture = *state;
    int changed = 0;
    for (int row = 0; row < rowCount; ++row) {
        vtMesh mesh = makeShape(rows[row].shape);
        vtFrame frame = frameOf(&mesh);
        float truth[3 * pixelCount];
        vtError error;
        readDirections(rows[row].shape, truth);
        assert_ok(vtRenderer_SetMesh(fixture->renderer, &mesh, &error), error);
        vtDestroyMesh(&mesh);
        print_message("  %-8s", rows[row].shape);
        for (int column = 0; column < columnCount; ++column) {
            vtDirectionError result;
            frame.technique = columns[column].technique;
            frame.search = columns[column].search;
            frame.backSurface = columns[column].back;
            draw(fixture, &frame);
            assert_ok(vtCompareDirections(fixture->directions, truth, pixelCount, &result, &error), error);
            const Figures was = rows[row].figures[column], is = {100.0 * result.within1, result.median};
            const bool isSame = fabs(is.within1 - was.within1) <= 1.0 &&
                                fabs(is.median - was.median) <= 0.1 * was.median + 0.002;
            changed += !isSame;
            print_message("  {%.1f, %.3f}%s", is.within1, is.median, isSame ? "" : "!");
        }
        print_message("\n");
    }
    if (changed > 0) {
        fail_msg("%d figures (!) are not those of the table", changed);
    }
}

// What a search costs: a fault that only makes it look around longer shows here.
static void searchesReadAsMuchAsTheyDid(void** state)
{
    Fixture* fixture = *state;
    static const struct {
        vtTechnique technique;
        vtSearch search;
        double reads; // texels a pixel that sees glass, mean
    } cases[] = {{vt_techniqueOliveira, vt_searchSteps, 37.7},
                 {vt_techniqueLayered, vt_searchSteps, 166.3},
                 {vt_techniqueLayered, vt_searchCells, 170.6},
                 {vt_techniqueExact, vt_searchSteps, 198.5}};
    vtMesh mesh = makeShape("knot");
    vtFrame frame = frameOf(&mesh);
    vtError error;
    int changed = 0;
    frame.countReads = true;
    assert_ok(vtRenderer_SetMesh(fixture->renderer, &mesh, &error), error);
    vtDestroyMesh(&mesh);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        static uint32_t states[pixelCount];
        int glass = 0;
        double reads = 0.0;
        frame.technique = cases[i].technique;
        frame.search = cases[i].search;
        draw(fixture, &frame);
        assert_ok(vtRenderer_ReadStates(fixture->renderer, states, &error), error);
        for (int p = 0; p < pixelCount; ++p) {
            const bool isGlass = (states[p] & 255u) != VT_PATH_BACKGROUND;
            glass += isGlass;
            reads += isGlass ? states[p] >> VT_PATH_READS_SHIFT : 0;
        }
        assert_true(glass > pixelCount / 10);
        const bool isSame = fabs(reads / glass - cases[i].reads) <= 0.02 * cases[i].reads;
        changed += !isSame;
        print_message("  %s: %.1f reads%s\n", vtTechnique_Info(frame.technique)->id, reads / glass,
                      isSame ? "" : "!");
    }
    if (changed > 0) {
        fail_msg("%d figures (!) differ by more than 2 %% from those of the table", changed);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(referenceGivesTheKeptDirections),
        cmocka_unit_test(techniquesAreAsRightAsTheyWere),
        cmocka_unit_test(searchesReadAsMuchAsTheyDid),
    };
    return cmocka_run_group_tests(tests, setUp, tearDown);
}
