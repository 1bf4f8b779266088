#pragma once
#include <string>

namespace nurbeam {

/// The first CAD file of a zip archive (.stpZ, .zip), what gzip packed (.gz, .stpZ too), and any other
/// content as it is. Throws std::runtime_error for a damaged archive, and where more than `limit` bytes are
/// unpacked.
std::string unpacked(std::string content, std::size_t limit);

}  // namespace nurbeam
