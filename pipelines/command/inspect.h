#pragma once
#include <filesystem>
#include <iosfwd>
#include <vector>

namespace nurbeam {

/// Lists the curves of CAD files on `out` (a table per file, or one JSON array) and what is wrong with them
/// on `err`. Lengths are in metres. Returns the exit code: 0, or 2 when a file cannot be read.
int inspect_files(const std::vector<std::filesystem::path>& files, bool json, std::ostream& out,
                  std::ostream& err);

/// Prints the properties of the section that the curves of each CAD file draw on `out`, and what is wrong
/// with them on `err`. Returns the exit code: 0, or 2 when a file cannot be read or draws no section.
int inspect_profiles(const std::vector<std::filesystem::path>& files, std::ostream& out, std::ostream& err);

}  // namespace nurbeam
