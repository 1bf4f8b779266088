#pragma once
#include <string>

#include "cad_import/iges/iges_global.h"
#include "cad_import/program/kept_entities.h"
#include "cad_import/report/import_report.h"

namespace nurbeam {

/// The text of an IGES file as OpenCASCADE may see it. Entities whose values are lost or no numbers are left
/// out, with a warning that names each: it would take zeros for them, or crash. So are those that are made of
/// themselves; the other parts of a composite curve that they were in stand by themselves. Knots and ranges
/// of B-splines that nearly agree are repaired, with a note. Those that are not kept are left out, too; the
/// number of an entity is its place in the directory.
std::string sound_iges(const std::string& content, const IgesGlobal& global, const KeptEntities& kept,
                       ImportReport& report);

}  // namespace nurbeam
