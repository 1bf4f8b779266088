#pragma once
#include <filesystem>

#include "cad_import/files/cad_format.h"
#include "cad_import/program/external_parts.h"
#include "cad_import/program/kept_entities.h"
#include "cad_import/report/import_report.h"

namespace nurbeam {

/// All curves of a file, read by OpenCASCADE in this very process, with the deviation of approximated ones
/// within `tolerance` [m]. The parts of an assembly in other files are read by `read_other`, if there is one.
/// Of STEP and IGES only what is kept is read; in STEP that is items of sets and representations.
///
/// For the child process of import_curves only: a bad file may crash it, it changes the process's signal
/// handlers and OpenCASCADE's printers, and two threads must not be in it at once.
ImportReport read_cad_file(const std::filesystem::path& file, const std::string& content, CadFormat format,
                           double tolerance, const ReadFile& read_other = {}, const KeptEntities& kept = {});

}  // namespace nurbeam
