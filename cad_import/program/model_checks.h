#pragma once
#include <Interface_InterfaceModel.hxx>

namespace nurbeam {

/// Throws std::runtime_error for a file that OpenCASCADE would go on with all the same, with other numbers
/// than those of the file, or for minutes: errors of syntax, coordinates above 1e15, curves nested so that
/// they repeat others more than a million times. The message says where.
void check_model(const Interface_InterfaceModel& model);

}  // namespace nurbeam
