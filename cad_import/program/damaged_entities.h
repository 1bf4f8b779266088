#pragma once
#include <Interface_InterfaceModel.hxx>
#include <string>

#include "cad_import/report/import_report.h"

namespace nurbeam {

/// Warns of the entities that are there in part only, with which OpenCASCADE goes on as if they had zeros,
/// and of the instances that a STEP file refers to and does not have. `content` is the text of the file.
void add_damaged_entities(const Interface_InterfaceModel& model, const std::string& content,
                          ImportReport& report);

}  // namespace nurbeam
