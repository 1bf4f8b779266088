#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "cad_import/report/length_unit.h"

namespace nurbeam {

/// What becomes of the curves of a file on their way into another one.
struct Conversion {
  std::vector<std::string> curves = {};  ///< names, or numbers from 1; none: all that are not hidden
  bool join = false;                     ///< chains become one curve each
  std::vector<double> split_at = {};     ///< parameters of the curves
  bool exact = false;                    ///< what would be approximated is refused
  std::optional<LengthUnit> unit = {};   ///< otherwise that of the file, where one can write it, or mm
  Eigen::Matrix<double, 3, 4> map = Eigen::Matrix<double, 3, 4>::Identity();  ///< of all points [m]
};

/// Writes the curves of one file to another, in the format of its name. Messages go to `err`, what was
/// written to `out`. Returns the exit code: 0; 2 where the input cannot be used, or does not hold what is
/// asked for; 4 where the output cannot be written. Throws std::invalid_argument for an output of unknown
/// format.
int convert_file(const std::filesystem::path& in, const std::filesystem::path& to,
                 const Conversion& conversion, std::ostream& out, std::ostream& err);

}  // namespace nurbeam
