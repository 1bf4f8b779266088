#pragma once
#include <string>

class IGESData_IGESModel;
class IGESGeom_Line;

namespace nurbeam {

/// Gives the lines (110) of a model their form numbers from the directory of the file with this content,
/// which OpenCASCADE does not keep.
void restore_line_forms(const std::string& content, const IGESData_IGESModel& model);

/// Throws std::runtime_error for a ray (form 1) and an infinite line (form 2): OpenCASCADE takes the segment
/// between the two points that say where it goes.
void check_bounded(const IGESGeom_Line& line);

}  // namespace nurbeam
