#pragma once
#include <filesystem>
#include <string>

namespace nurbeam {

/// The bytes of what read_file() reports, read in a process of its own. A crash of it costs the entity that
/// it crashes on, which is found by reading fewer and named, where that can be done in time; else the report
/// says that it crashed.
std::string contained_reading(const std::filesystem::path& file, double tolerance);

}  // namespace nurbeam
