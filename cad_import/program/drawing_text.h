#pragma once
#include <filesystem>
#include <string>

namespace nurbeam {

/// The text of a CAD file, unpacked where it is compressed, as text where it is a binary DXF, and as
/// OpenCASCADE reads it (see tolerant_text). Throws std::runtime_error when the file cannot be read.
std::string drawing_text(const std::filesystem::path& file);

}  // namespace nurbeam
