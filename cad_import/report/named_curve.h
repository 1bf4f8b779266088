#pragma once
#include <Eigen/Core>
#include <array>
#include <string>
#include <variant>
#include <vector>

#include "nurbs/nurbs_curve.h"

namespace nurbeam {

struct NamedCurve {
  std::string name;
  NurbsCurve curve;
  std::string part = {};    ///< name of its product in STEP; "" for that of the curve
  std::string layer = {};   ///< "" for none; in IGES it is the number of a level
  std::string colour = {};  ///< "#rrggbb"; "" for none
};

/// Whether a text is a colour, "#rrggbb".
bool is_colour(const std::string& text);
/// Its red, green and blue, 0 to 255.
std::array<int, 3> parts_of_colour(const std::string& colour);

/// The number that a layer of IGES is; 0 where its name is none.
int level_number(const std::string& layer);

/// A curve with a circular section, solid or hollow.
struct NamedPipe {
  NamedCurve axis;
  double radius;    ///< [m]
  double bore = 0;  ///< radius of its bore [m]; 0 where it is solid
};

/// What one rational cubic of a section's outline sweeps: its control points move along four curves of the
/// same knots, weights 1; its own weights stay.
struct SweptCubic {
  std::array<NurbsCurve, 4> rails;  ///< [m]
  Eigen::Vector4d weights;
};

/// A section of any outline, with holes, that has been moved and turned along a beam.
struct SweptProfile {
  std::string name;
  std::string part = {};  ///< as that of a NamedCurve
  std::vector<std::vector<SweptCubic>>
      loops;      ///< the outline, anticlockwise, and its holes, clockwise; closed
  double volume;  ///< that it should have [m^3]
};

using NamedSolid = std::variant<NamedPipe, SweptProfile>;

}  // namespace nurbeam
