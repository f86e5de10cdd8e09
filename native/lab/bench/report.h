// The figures of `vitrine bench` as Markdown.
#pragma once

#include <stdio.h>

#include "lab/bench/figures.h"

void vtBench_WriteTable(const vtBench* bench, FILE* out);
