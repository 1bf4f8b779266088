#pragma once
#include <string>
#include <vector>

namespace nurbeam {

/// The content of a file.
struct Unpacked {
  std::string content;
  std::vector<std::string> left_out = {};  ///< names of the other CAD files of its archive
};

/// The first CAD file of a zip archive (.stpZ, .zip), what gzip packed (.gz, .stpZ too), and any other
/// content as it is. Throws std::runtime_error for a damaged archive, and where more than `limit` bytes are
/// unpacked.
Unpacked unpacked(std::string content, std::size_t limit);

}  // namespace nurbeam
