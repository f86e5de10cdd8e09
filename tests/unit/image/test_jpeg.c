// JPEG, written here by libjpeg: grey, colour, ink, progressive; what is cut off or damaged is refused.
#include "image_cases.h"

#include <jpeglib.h>

enum { side = 24 };

typedef struct Kind {
    J_COLOR_SPACE space; ///< of the samples given and of the file
    J_COLOR_SPACE stored;
    bool progressive;
} Kind;

/// Left half of one colour, right half of another. The caller frees the bytes.
static uint8_t* writeJpeg(Kind kind, int channels, const uint8_t* left, const uint8_t* right, size_t* size)
{
    struct jpeg_error_mgr errors;
    struct jpeg_compress_struct jpeg = {.err = jpeg_std_error(&errors)};
    unsigned char* bytes = NULL;
    unsigned long length = 0;
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &bytes, &length);
    jpeg.image_width = jpeg.image_height = side;
    jpeg.input_components = channels;
    jpeg.in_color_space = kind.space;
    jpeg_set_defaults(&jpeg);
    jpeg_set_colorspace(&jpeg, kind.stored);
    jpeg_set_quality(&jpeg, 100, TRUE);
    if (kind.progressive) {
        jpeg_simple_progression(&jpeg);
    }
    jpeg_start_compress(&jpeg, TRUE);
    uint8_t row[4 * side];
    for (int i = 0; i < side; ++i) {
        memcpy(row + i * channels, i < 16 ? left : right, (size_t)channels);
    }
    while (jpeg.next_scanline < side) {
        JSAMPROW line = row;
        jpeg_write_scanlines(&jpeg, &line, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    *size = length;
    return bytes;
}

static void expectColours(const uint8_t* bytes, size_t size, const uint8_t* left, const uint8_t* right)
{
    vtImage image;
    vtError error = {0};
    assert_ok(vtDecodeImage(bytes, size, "file", &image, &error), error);
    assert_true(image.width == side && image.height == side);
    for (int k = 0; k < 3; ++k) {
        assert_in_range(image.pixels[4 * (5 * side + 3) + k] + 3 - left[k], 0, 6);
        assert_in_range(image.pixels[4 * (5 * side + 22) + k] + 3 - right[k], 0, 6);
    }
    assert_int_equal(image.pixels[3], 255);
    vtFree(image.pixels);
}

static void everyKindIsRead(void** state)
{
    (void)state;
    const uint8_t left[] = {200, 30, 60}, right[] = {10, 250, 128};
    for (int progressive = 0; progressive < 2; ++progressive) {
        size_t size;
        uint8_t* bytes = writeJpeg((Kind){JCS_RGB, JCS_YCbCr, progressive}, 3, left, right, &size);
        expectColours(bytes, size, left, right);
        refusesCuts(bytes, size); // the last two bytes are its end
        survivesDamage(bytes, size, 2000);
        free(bytes);
        bytes = writeJpeg((Kind){JCS_RGB, JCS_RGB, progressive}, 3, left, right, &size);
        expectColours(bytes, size, left, right);
        free(bytes);
        bytes = writeJpeg((Kind){JCS_GRAYSCALE, JCS_GRAYSCALE, progressive}, 1, left, right, &size);
        expectColours(bytes, size, (const uint8_t[]){200, 200, 200}, (const uint8_t[]){10, 10, 10});
        free(bytes);
    }
}

/// libjpeg marks what it writes as Adobe's, where 255 is no ink.
static void inkIsLight(void** state)
{
    (void)state;
    const uint8_t left[] = {255, 128, 0, 255}, right[] = {255, 255, 255, 100};
    const uint8_t red[] = {255, 128, 0}, grey[] = {100, 100, 100};
    const J_COLOR_SPACE stored[] = {JCS_CMYK, JCS_YCCK};
    for (int i = 0; i < 2; ++i) {
        size_t size;
        uint8_t* bytes = writeJpeg((Kind){JCS_CMYK, stored[i], false}, 4, left, right, &size);
        expectColours(bytes, size, red, grey);
        // Without Adobe's marker 255 is all ink: 0, 127, 255 under none; then none under 155.
        uint8_t* adobe = bytes;
        while (memcmp(adobe, "\xFF\xEE", 2) != 0) {
            ++adobe;
        }
        adobe[1] = 0xE7; // another program's
        if (i == 0) {
            expectColours(bytes, size, (const uint8_t[]){0, 0, 0}, (const uint8_t[]){0, 0, 0});
        }
        free(bytes);
    }
}

static void damagedIsRefused(void** state)
{
    (void)state;
    size_t size;
    uint8_t* bytes = loadCase("dht.jpg", &size);
    expectSentence(bytes, size, "Bogus Huffman table");
    free(bytes);
    expectSentence((const uint8_t*)"\xFF\xD8\xFF\xD9", 4, "cannot be decoded as JPEG");

    bytes = writeJpeg((Kind){JCS_GRAYSCALE, JCS_GRAYSCALE, false}, 1, (const uint8_t[]){9},
                      (const uint8_t[]){99}, &size);
    uint8_t* frame = bytes;
    while (memcmp(frame, "\xFF\xC0", 2) != 0) {
        ++frame;
    }
    frame[5] = 0xFF; // 65,304 rows
    expectSentence(bytes, size, "24 x 65304 pixels, but a side must be 1 to 16384");
    free(bytes);
}

/// Each scan is a pass over the whole picture, and needs a dozen bytes.
static void scansAreCounted(void** state)
{
    (void)state;
    size_t size;
    uint8_t* bytes = writeJpeg((Kind){JCS_GRAYSCALE, JCS_GRAYSCALE, true}, 1, (const uint8_t[]){9},
                               (const uint8_t[]){99}, &size);
    uint8_t* last = bytes + size - 2; // before the end
    while (memcmp(last, "\xFF\xDA", 2) != 0) {
        --last;
    }
    const size_t scan = (size_t)(bytes + size - 2 - last), head = (size_t)(last - bytes);
    for (int times = 50; times <= 200; times += 150) {
        uint8_t* many = malloc(head + (size_t)times * scan + 2);
        memcpy(many, bytes, head);
        for (int i = 0; i < times; ++i) {
            memcpy(many + head + (size_t)i * scan, last, scan);
        }
        memcpy(many + head + (size_t)times * scan, "\xFF\xD9", 2);
        vtError error = {0};
        decodeAll(many, head + (size_t)times * scan + 2, &error);
        assert_true((strstr(error.message, "more than 100 scans") != NULL) == (times > 100));
        free(many);
    }
    free(bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everyKindIsRead),
        cmocka_unit_test(inkIsLight),
        cmocka_unit_test(damagedIsRefused),
        cmocka_unit_test(scansAreCounted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
