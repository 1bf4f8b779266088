#pragma once
#include <string>

#include "nurbs/nurbs_curve.h"

namespace nurbeam {

struct NamedCurve {
  std::string name;
  NurbsCurve curve;
  std::string part = {};  ///< name of its product in STEP; "" for that of the curve
};

/// A curve with a circular section, solid or hollow.
struct NamedPipe {
  NamedCurve axis;
  double radius;    ///< [m]
  double bore = 0;  ///< radius of its bore [m]; 0 where it is solid
};

}  // namespace nurbeam
