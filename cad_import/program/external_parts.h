#pragma once
#include <XSControl_Reader.hxx>
#include <filesystem>
#include <functional>

#include "cad_import/program/restated_curves.h"
#include "cad_import/report/import_report.h"

namespace nurbeam {

/// How another CAD file is read.
using ReadFile = std::function<ImportReport(const std::filesystem::path&)>;

/// Adds the curves of the parts of a STEP assembly that lie in other files, at each of the places where the
/// assembly has the part, under its path. Such a file is looked for beside the one of the report, under the
/// path that is given, if it leads nowhere above, else under its last component. A warning names part and
/// file where it is not there, holds nothing that can be read, or the part has shapes here, too.
void add_external_parts(const XSControl_Reader& reader, const RestatedCurves& restated, const ReadFile& read,
                        ImportReport& report);

}  // namespace nurbeam
