#pragma once
#include "pipelines/command/commands.h"

namespace nurbeam {

/// `nurbeam verify` and `nurbeam bench`, which `run` carries out.
Command verify_entry(int (*run)(const Arguments&, Streams));
Command bench_entry(int (*run)(const Arguments&, Streams));

/// Become the programs nurbeam-verify and nurbeam-bench. Throw std::runtime_error where they are missing.
int become_verify(const Arguments& arguments, Streams streams);
int become_bench(const Arguments& arguments, Streams streams);

}  // namespace nurbeam
