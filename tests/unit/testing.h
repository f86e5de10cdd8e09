// cmocka with the headers it wants before it, and what several tests share.
#pragma once

// clang-format off
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
// clang-format on

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "vitrine.h"

#define assert_near(actual, expected, tolerance) assert_float_equal(actual, expected, tolerance)

/// vt_ok, or the test fails with the library's own sentence.
#define assert_ok(call, error)                                                                               \
    do {                                                                                                     \
        if ((call) != vt_ok) {                                                                               \
            fail_msg("%s: %s", #call, (error).message);                                                      \
        }                                                                                                    \
    } while (0)
