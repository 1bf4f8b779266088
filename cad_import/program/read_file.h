#pragma once
#include <filesystem>
#include <string>

#include "cad_import/program/kept_entities.h"
#include "cad_import/report/import_report.h"

namespace nurbeam {

/// read_cad_file() of the file, unpacked and recognised by its content, with the parts of an assembly from
/// the files beside it; what is no CAD file, or a part of itself, is refused in the report. To be called as
/// that is.
ImportReport read_file(const std::filesystem::path& file, double tolerance, const KeptEntities& kept = {});

/// The same of a file that has this content.
ImportReport read_content(const std::filesystem::path& file, std::string content, double tolerance);

}  // namespace nurbeam
