// The figures of `vitrine bench` as JSON.
#pragma once

#include <stdio.h>

#include "lab/bench/figures.h"

void vtBench_WriteJson(const vtBench* bench, FILE* out);
