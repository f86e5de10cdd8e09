#include "cli/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "testing.h"

static void writesWhatReadersTake(void** state)
{
    (void)state;
    char* text;
    size_t size;
    FILE* out = open_memstream(&text, &size);
    assert_non_null(out);
    vtJson json = {.out = out};
    vtJson_BeginObject(&json, NULL);
    vtJson_Text(&json, "text", "a \"quoted\" \\ line\nand\x01 °");
    vtJson_BeginArray(&json, "empty");
    vtJson_EndArray(&json);
    vtJson_BeginArray(&json, "numbers");
    vtJson_Number(&json, NULL, 0.25, 3);
    vtJson_Number(&json, NULL, (double)NAN, 3);
    vtJson_Number(&json, NULL, -(double)INFINITY, 3);
    vtJson_Integer(&json, NULL, -9007199254740993);
    vtJson_EndArray(&json);
    vtJson_BeginObject(&json, "inner");
    vtJson_Integer(&json, "a", 1);
    vtJson_Integer(&json, "b", 2);
    vtJson_EndObject(&json);
    vtJson_EndObject(&json);
    fclose(out);
    assert_string_equal(text, "{\"text\":\"a \\\"quoted\\\" \\\\ line\\u000aand\\u0001 °\",\"empty\":[],"
                              "\"numbers\":[0.250,null,null,-9007199254740993],\"inner\":{\"a\":1,\"b\":2}}");
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(writesWhatReadersTake)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
