// OpenEXR: every compression and type, tiles, windows that differ; cut, damaged and other files.
#include "exr_cases.h"
#include "image_cases.h"

static ExrBytes file;

/// Of no size that blocks would have.
static exr_attr_box2i_t wide(void)
{
    return exrBox(0, 0, 36, 18);
}

/// `tolerance` of what is lossy.
static void expectValues(const ExrCase* exr, float tolerance)
{
    const int width = exr->display.max.x - exr->display.min.x + 1,
              height = exr->display.max.y - exr->display.min.y + 1;
    float* light = expectLight(file.bytes, file.size, width, height);
    for (int i = 0; i < 3 * width * height; ++i) {
        const int x = i / 3 % width + exr->display.min.x - exr->data.min.x;
        const int y = i / 3 / width + exr->display.min.y - exr->data.min.y;
        const bool isThere = x >= 0 && y >= 0 && x <= exr->data.max.x - exr->data.min.x &&
                             y <= exr->data.max.y - exr->data.min.y;
        const char channel = strcmp(exr->channels, "Y") == 0 ? 'Y' : "RGB"[i % 3];
        float wanted = isThere ? exrValue(channel, x, y) : 0.0f;
        wanted = exr->type == EXR_PIXEL_UINT ? (float)(int)wanted : wanted;
        if (!(light[i] >= wanted - tolerance && light[i] <= wanted + tolerance)) {
            fail_msg("%d %d %c: %g, not %g", x, y, channel, light[i], wanted);
        }
    }
    vtFree(light);
}

static void everyCompressionIsRead(void** state)
{
    (void)state;
    for (int compression = EXR_COMPRESSION_NONE; compression <= EXR_COMPRESSION_B44A; ++compression) {
        for (int type = EXR_PIXEL_UINT; type <= EXR_PIXEL_FLOAT; ++type) {
            for (int tile = 0; tile <= 16; tile += 16) {
                const ExrCase exr = {
                    wide(), wide(), "ABGR", NULL, (exr_pixel_type_t)type, (exr_compression_t)compression,
                    tile};
                putExr(&file, &exr);
                expectValues(&exr, compression < EXR_COMPRESSION_PXR24 ? 0.0f : 0.2f);
            }
        }
    }
}

static void windowsAreFollowed(void** state)
{
    (void)state;
    const exr_attr_box2i_t data = exrBox(-3, 2, 8, 9);
    const exr_attr_box2i_t displays[] = {exrBox(-3, 2, 8, 9), exrBox(0, 0, 5, 5), exrBox(-6, 0, 11, 12),
                                         exrBox(20, 20, 22, 23)};
    for (size_t i = 0; i < sizeof displays / sizeof displays[0]; ++i) {
        for (int tile = 0; tile <= 4; tile += 4) {
            const ExrCase exr = {data, displays[i], "BGR", NULL, EXR_PIXEL_HALF, EXR_COMPRESSION_ZIP, tile};
            putExr(&file, &exr);
            expectValues(&exr, 0.0f);
        }
    }
}

static void channelsAreFound(void** state)
{
    (void)state;
    ExrCase exr = {wide(), wide(), "Y", NULL, EXR_PIXEL_HALF, EXR_COMPRESSION_PIZ, 0};
    putExr(&file, &exr);
    expectValues(&exr, 0.0f);
    exr.channels = "RGBZ";
    putExr(&file, &exr);
    expectValues(&exr, 0.0f);
    exr.channels = "RG";
    putExr(&file, &exr);
    expectSentence(file.bytes, file.size, "without a flat picture in R, G and B or Y");
    exr.channels = "RGB";
    exr.prefix = "diffuse.";
    putExr(&file, &exr);
    expectSentence(file.bytes, file.size, "without a flat picture in R, G and B or Y");
}

static void damagedIsRefused(void** state)
{
    (void)state;
    const exr_attr_box2i_t small = exrBox(0, 0, 5, 4);
    for (int compression = EXR_COMPRESSION_NONE; compression <= EXR_COMPRESSION_B44A; ++compression) {
        for (int tile = 0; tile <= 3; tile += 3) {
            const ExrCase exr = {small, small, "BGR", NULL, EXR_PIXEL_HALF, (exr_compression_t)compression,
                                 tile};
            putExr(&file, &exr);
            refusesCuts(file.bytes, file.size);
            survivesDamage(file.bytes, file.size, 1000);
        }
    }
}

static void headersAreChecked(void** state)
{
    (void)state;
    const exr_attr_box2i_t small = exrBox(0, 0, 5, 4);
    const ExrCase exr = {small, small, "BGR", NULL, EXR_PIXEL_HALF, EXR_COMPRESSION_ZIP, 0};
    putExr(&file, &exr);
    // A compression that OpenEXRCore 3.1 cannot read; to later ones these pixels are damaged.
    uint8_t* compression = file.bytes;
    while (memcmp(compression, "compression", 12) != 0 || memcmp(compression + 12, "compression", 12) != 0) {
        ++compression;
    }
    compression[12 + 12 + 4] = EXR_COMPRESSION_DWAB;
    expectSentence(file.bytes, file.size, "OpenEXR");
    compression[12 + 12 + 4] = EXR_COMPRESSION_ZIP;

    uint8_t* window = file.bytes;
    while (memcmp(window, "dataWindow", 11) != 0) {
        ++window;
    }
    window += 11 + 6 + 4 + 8; // name, type "box2i", size, the least corner
    window[1] = 0x3F;         // 5 + 0x3F00: 16134 columns
    window[5] = 0x3F;
    expectSentence(file.bytes, file.size, "'file'");
    window[1] = 0x4F; // 20230
    expectSentence(file.bytes, file.size, "'file'");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everyCompressionIsRead), cmocka_unit_test(windowsAreFollowed),
        cmocka_unit_test(channelsAreFound),       cmocka_unit_test(damagedIsRefused),
        cmocka_unit_test(headersAreChecked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
