#pragma once
#include <vector>

#include "cad_import/ifc/ifc_model.h"
#include "cad_import/ifc/plan_curve.h"

namespace nurbeam {

/// An alignment as the elements of its plan and of its grade, in the file's unit.
struct Alignment {
  std::vector<PlanElement> plan;
  std::vector<GradeElement> grade;
  double begin = 0;  ///< the distance along it where the plan begins
};

/// That of an IFCALIGNMENTCURVE (IFC 4.1). This and the others throw std::runtime_error where an element is
/// none that is read.
Alignment alignment_of_curve(const IfcModel& model, const IfcValue& curve);

/// That of the segments that an IFCALIGNMENT nests (IFC 4.3); empty where it has none.
Alignment alignment_of_segments(const IfcModel& model, int alignment);

/// That of a composite of IFCCURVESEGMENTs (IFC 4.3): an IFCGRADIENTCURVE on its base, or one in plan.
Alignment alignment_of_composite(const IfcModel& model, const IfcValue& curve);

}  // namespace nurbeam
