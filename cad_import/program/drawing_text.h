#pragma once
#include <filesystem>
#include <string>

#include "cad_import/program/unpacked.h"

namespace nurbeam {

/// The text of a CAD file, unpacked where it is compressed, as text where it is a binary DXF, and as
/// OpenCASCADE reads it (see tolerant_text). Throws std::runtime_error when the file cannot be read.
Unpacked drawing_text(const std::filesystem::path& file);

/// That of a file with this content.
Unpacked drawing_text_of(std::string content);

}  // namespace nurbeam
