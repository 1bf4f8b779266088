#pragma once
#include "pipelines/command/verify.h"

namespace nurbeam {

/// `nurbeam bench`: the tables of bench.h. Throws UsageError where a number is none.
int bench_command(const Arguments& arguments, Streams streams);

}  // namespace nurbeam
