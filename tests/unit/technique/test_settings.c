// The table of settings: what it says is what a frame does. That every field of vtFrame has a row is checked
// by tests/cli.test.mjs, which reads the header.
#include "testing.h"

#include <math.h>

#include "technique/settings.h"
#include "technique/technique.h"

static vtFrame validFrame(void)
{
    vtFrame frame = vtDefaultFrame();
    frame.view = (vtView){{0.0f, 0.0f, 3.0f}, {0.0f, 0.0f, 0.0f}, 45.0f};
    return frame;
}

static void everyRangeIsHeld(void** state)
{
    (void)state;
    const vtSetting* setting;
    for (int i = 0; (setting = vtSetting_At(i)) != NULL; ++i) {
        assert_ptr_equal(vtFindSetting(setting->name), setting);
        if (setting->kind > vt_settingNumber) {
            continue;
        }
        const double step = setting->kind == vt_settingInteger ? 1.0 : 0.001 * setting->most;
        const double wrong[] = {setting->least - step, setting->most + step, NAN};
        vtError error;
        for (int k = 0; k < 3; ++k) {
            vtFrame frame = validFrame();
            vtSetting_Set(setting, &frame, wrong[k]);
            if (vtSetting_Get(setting, &frame) != 0.0) { // ior and others take it
                assert_int_equal(vtValidateFrame(&frame, &error), vt_errorArgument);
                assert_ptr_equal(strstr(error.message, setting->name), error.message);
            }
        }
        vtFrame frame = validFrame();
        frame.minTransmittance = 0.0f;
        vtSetting_Set(setting, &frame, setting->least);
        if (setting->offset != offsetof(vtFrame, maxTransmittance)) {
            assert_ok(vtValidateFrame(&frame, &error), error);
        }
        assert_true(setting->words == NULL || setting->words[(int)setting->most] != NULL);
    }
    assert_null(vtFindSetting("no such"));
}

static void everySettingCountsForGoingOn(void** state)
{
    (void)state;
    static const char* const others[] = {"samples", "first-sample", "moving", "count-reads"};
    const vtSetting* setting;
    const vtFrame frame = validFrame();
    assert_true(vtFrame_Same(&frame, &frame));
    for (int i = 0; (setting = vtSetting_At(i)) != NULL; ++i) {
        vtFrame changed = frame;
        if (setting->kind == vt_settingVector) {
            ((vtVec3*)((char*)&changed + setting->offset))->z += 0.25f;
        } else {
            vtSetting_Set(setting, &changed, vtSetting_Get(setting, &frame) == 0.0 ? 1.0 : 0.0);
        }
        bool goesOn = false;
        for (size_t k = 0; k < sizeof others / sizeof others[0]; ++k) {
            goesOn = goesOn || strcmp(setting->name, others[k]) == 0;
        }
        assert_int_equal(vtFrame_Same(&frame, &changed), goesOn);
    }
}

static void presetsAreThoseOfTheHeader(void** state)
{
    (void)state;
    static const int wanted[vt_presetCount][5] = {{2, 25, 4, 0, 1}, {4, 50, 8, 1, 3}, {8, 100, 8, 2, 3}};
    for (int preset = 0; preset < vt_presetCount; ++preset) {
        vtFrame frame = validFrame();
        frame.preset = (vtPreset)preset;
        const vtFrame resolved = vtResolveFrame(&frame);
        assert_int_equal(resolved.layers, wanted[preset][0]);
        assert_int_equal(resolved.steps, wanted[preset][1]);
        assert_int_equal(resolved.maxEvents, wanted[preset][2]);
        assert_int_equal(vtFrame_BranchCount(&frame), wanted[preset][3]);
        assert_int_equal(vtFrame_BranchCount(&resolved), wanted[preset][3]);
        assert_int_equal(resolved.wavelengths, wanted[preset][4]);
        frame.steps = 40;
        vtFrame_Lessen(&frame, vt_presetLow);
        assert_int_equal(frame.layers, 2);
        assert_int_equal(frame.steps, 25);
        assert_int_equal(vtFrame_BranchCount(&frame), 0);
        assert_int_equal(frame.wavelengths, 1);
        frame.steps = 7;
        vtFrame_Lessen(&frame, vt_presetLow);
        assert_int_equal(frame.steps, 7);
    }
}

static void techniquesAreTheRowsThatTakeThem(void** state)
{
    (void)state;
    for (int i = 0; i < vt_techniqueCount; ++i) {
        const vtTechniqueRow* row = vtTechnique_Row((vtTechnique)i);
        const struct {
            const char* name;
            bool takes;
        } cases[] = {{"layers", row->layers == VT_LAYERS_OF_FRAME},
                     {"branches", row->traces},
                     {"wavelengths", row->traces},
                     {"multi", row->refract[vt_variantOrdered].name != NULL},
                     {"search", row->refract[vt_variantCells].name != NULL},
                     {"back-surface", row->innerDistances}};
        for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
            const bool says = (vtFindSetting(cases[k].name)->techniques & (1u << i)) != 0;
            assert_int_equal(says, cases[k].takes);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everyRangeIsHeld),
        cmocka_unit_test(everySettingCountsForGoingOn),
        cmocka_unit_test(presetsAreThoseOfTheHeader),
        cmocka_unit_test(techniquesAreTheRowsThatTakeThem),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
