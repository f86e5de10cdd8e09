#include "lab/sheet.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb/stb_easy_font.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

vtResult vtCreateSheet(int width, int height, uint8_t grey, vtSheet* sheet, vtError* error)
{
    *sheet = (vtSheet){0};
    if (width < 1 || height < 1 || width > 16384 || height > 16384) {
        return vtFail(error, vt_errorArgument,
                      "sheet: %d x %d pixels; at most 16384 a side, use a smaller --resolution", width,
                      height);
    }
    size_t bytes = 4 * (size_t)width * (size_t)height;
    sheet->pixels = malloc(bytes);
    if (sheet->pixels == NULL) {
        return vtFail(error, vt_errorMemory, "sheet: out of memory for %d x %d pixels", width, height);
    }
    sheet->width = width;
    sheet->height = height;
    memset(sheet->pixels, grey, bytes);
    for (size_t i = 3; i < bytes; i += 4) {
        sheet->pixels[i] = 255;
    }
    return vtSucceed(error);
}

void vtDestroySheet(vtSheet* sheet)
{
    free(sheet->pixels);
    *sheet = (vtSheet){0};
}

void vtSheet_Paste(vtSheet* sheet, int x, int y, const uint8_t* rgba, int width, int height, int factor)
{
    const int across = width / factor, down = height / factor;
    assert(x >= 0 && y >= 0 && x + across <= sheet->width && y + down <= sheet->height);
    for (int j = 0; j < down; ++j) {
        uint8_t* to = sheet->pixels + 4 * ((size_t)(y + j) * (size_t)sheet->width + (size_t)x);
        for (int i = 0; i < 4 * across; ++i) {
            int sum = 0;
            for (int k = 0; k < factor * factor; ++k) {
                int row = j * factor + k / factor, column = i / 4 * factor + k % factor;
                sum += rgba[4 * ((size_t)row * (size_t)width + (size_t)column) + (size_t)(i % 4)];
            }
            to[i] = (uint8_t)((sum + factor * factor / 2) / (factor * factor));
        }
    }
}

static void fillBlack(vtSheet* sheet, int left, int top, int right, int bottom)
{
    for (int y = top < 0 ? 0 : top; y < bottom && y < sheet->height; ++y) {
        for (int x = left < 0 ? 0 : left; x < right && x < sheet->width; ++x) {
            memset(sheet->pixels + 4 * ((size_t)y * (size_t)sheet->width + (size_t)x), 0, 3);
        }
    }
}

void vtSheet_Text(vtSheet* sheet, int x, int y, int scale, const char* text)
{
    // stb_easy_font gives quads of four vertices: three floats and a colour each, in units of a font pixel.
    typedef struct Vertex {
        float x, y, z;
        unsigned char color[4];
    } Vertex;
    enum { bytesPerCharacter = 270 }; // the library's own estimate, doubled below for safety
    char copy[256];
    strncpy(copy, text, sizeof copy - 1);
    copy[sizeof copy - 1] = '\0';
    static const size_t capacity = 2 * bytesPerCharacter * sizeof copy;
    Vertex* vertices = malloc(capacity);
    if (vertices == NULL) {
        return; // a caption is not worth failing for
    }
    int quads = stb_easy_font_print(0.0f, 0.0f, copy, NULL, vertices, (int)capacity);
    for (int i = 0; i < quads; ++i) {
        const Vertex* a = &vertices[4 * i];
        const Vertex* c = a + 2;
        fillBlack(sheet, x + (int)a->x * scale, y + (int)a->y * scale, x + (int)c->x * scale,
                  y + (int)c->y * scale);
    }
    free(vertices);
}
