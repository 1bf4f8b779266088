#include "pipelines/bench/bench_command.h"

#include "pipelines/bench/bench.h"

namespace nurbeam {

int bench_command(const Arguments& arguments, Streams streams) {
  BenchOptions options;
  options.largest = whole_number(arguments, "--largest", options.largest, 10, 10'000'000);
  if (arguments.has("--cad")) options.cad = arguments.value("--cad", "");
  if (arguments.has("--plot")) options.plot = arguments.value("--plot", "");
  bench(options, streams.out);
  return exit_done;
}

}  // namespace nurbeam
