#pragma once
#include <filesystem>
#include <iosfwd>
#include <optional>

namespace nurbeam {

struct BenchOptions {
  int largest = 10000;                        ///< number of elements
  std::optional<std::filesystem::path> cad;   ///< a CAD file whose reading is timed too
  std::optional<std::filesystem::path> plot;  ///< where the cost by number of elements is drawn (SVG)
};

/// Times nurbeam on this machine, in processor time, and prints tables: single elements; systems of 10, 100,
/// … elements with a body that slides, per element; whole runs of Example 1 of Ding & Ouyang 2022, with the
/// error of each; reading of curves. Throws std::runtime_error where a file cannot be read or written.
void bench(const BenchOptions& options, std::ostream& out);

}  // namespace nurbeam
