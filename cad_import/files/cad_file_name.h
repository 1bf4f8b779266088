#pragma once
#include <filesystem>
#include <optional>

#include "cad_import/report/format.h"

namespace nurbeam {

/// What a CAD file may be, for messages.
inline constexpr const char* cad_formats = "STEP, IGES, DXF, IFC or BREP";

/// The format that the ending of a file's name says, in small letters or large ones; nothing where it says
/// none.
std::optional<CadFormat> format_by_name(const std::filesystem::path& file);

/// Whether a file of this name is likely one that can be read: its ending says a format, or that it is
/// packed.
bool is_named_as_cad_file(const std::filesystem::path& file);

}  // namespace nurbeam
