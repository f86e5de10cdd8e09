#include "lab/sheet.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"

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

// ------------------------------------------------------------------------------------------------- words

/// A letter, row by row from the top of the capitals; the eighth and ninth row are below the line.
typedef struct Glyph {
    char letter;
    const char* rows;
} Glyph;

/// What captions are made of.
static const Glyph glyphs[] = {
    {'a', "//.##/...#/.###/#..#/.###"},
    {'b', "#/#/###/#..#/#..#/#..#/###"},
    {'c', "//.##/#/#/#/.##"},
    {'d', "...#/...#/.###/#..#/#..#/#..#/.###"},
    {'e', "//.##/#..#/####/#/.###"},
    {'f', ".##/#/###/#/#/#/#"},
    {'g', "//.###/#..#/#..#/#..#/.###/...#/.##"},
    {'h', "#/#/###/#..#/#..#/#..#/#..#"},
    {'i', "#//#/#/#/#/#"},
    {'j', ".#//.#/.#/.#/.#/.#/.#/#"},
    {'k', "#/#/#..#/#.#/##/#.#/#..#"},
    {'l', "#/#/#/#/#/#/.#"},
    {'m', "//##.#/#.#.#/#.#.#/#.#.#/#.#.#"},
    {'n', "//###/#..#/#..#/#..#/#..#"},
    {'o', "//.##/#..#/#..#/#..#/.##"},
    {'p', "//###/#..#/#..#/#..#/###/#/#"},
    {'q', "//.###/#..#/#..#/#..#/.###/...#/...#"},
    {'r', "//#.#/##/#/#/#"},
    {'s', "//.###/#/.##/...#/###"},
    {'t', "#/#/###/#/#/#/.##"},
    {'u', "//#..#/#..#/#..#/#..#/.###"},
    {'v', "//#...#/#...#/.#.#/.#.#/..#"},
    {'w', "//#...#/#...#/#.#.#/#.#.#/.#.#"},
    {'x', "//#...#/.#.#/..#/.#.#/#...#"},
    {'y', "//#..#/#..#/#..#/#..#/.###/...#/.##"},
    {'z', "//####/...#/.##/#/####"},
    {'0', ".##/#..#/#..#/#..#/#..#/#..#/.##"},
    {'1', ".#/##/.#/.#/.#/.#/.#"},
    {'2', ".##/#..#/...#/..#/.#/#/####"},
    {'3', "###/...#/...#/.##/...#/...#/###"},
    {'4', "..#/.##/#.#/#.#/####/..#/..#"},
    {'5', "####/#/#/###/...#/...#/###"},
    {'6', ".##/#/#/###/#..#/#..#/.##"},
    {'7', "####/...#/..#/..#/.#/.#/.#"},
    {'8', ".##/#..#/#..#/.##/#..#/#..#/.##"},
    {'9', ".##/#..#/#..#/.###/...#/...#/.##"},
    {'E', "####/#/#/###/#/#/####"},
    {'F', "####/#/#/###/#/#/#"},
    {'I', "###/.#/.#/.#/.#/.#/###"},
    {'L', "#/#/#/#/#/#/####"},
    {'P', "###/#..#/#..#/###/#/#/#"},
    {'.', "//////#"},
    {',', "/////.#/.#/#"},
    {'(', ".#/#/#/#/#/#/.#"},
    {')', "#/.#/.#/.#/.#/.#/#"},
    {'-', "////###"},
    {'%', "##..#/##..#/...#/..#/.#/#..##/#..##"},
};

static void fillBlack(vtSheet* sheet, int left, int top, int side)
{
    for (int y = top < 0 ? 0 : top; y < top + side && y < sheet->height; ++y) {
        for (int x = left < 0 ? 0 : left; x < left + side && x < sheet->width; ++x) {
            memset(sheet->pixels + 4 * ((size_t)y * (size_t)sheet->width + (size_t)x), 0, 3);
        }
    }
}

/// Gives the width.
static int drawGlyph(vtSheet* sheet, int x, int y, int scale, const char* rows)
{
    int row = 0, column = 0, width = 0;
    for (; *rows != '\0'; ++rows) {
        if (*rows == '/') {
            ++row;
            column = 0;
            continue;
        }
        if (*rows == '#') {
            fillBlack(sheet, x + column * scale, y + row * scale, scale);
        }
        width = ++column > width ? column : width;
    }
    return width * scale;
}

void vtSheet_Text(vtSheet* sheet, int x, int y, int scale, const char* text)
{
    for (; *text != '\0'; ++text) {
        const char* rows =
            *text == ' ' ? ".." : "####/#..#/#..#/#..#/#..#/#..#/####"; // a box: not in the table
        for (size_t i = 0; i < sizeof glyphs / sizeof glyphs[0]; ++i) {
            rows = glyphs[i].letter == *text ? glyphs[i].rows : rows;
        }
        x += drawGlyph(sheet, x, y, scale, rows) + scale;
    }
}
