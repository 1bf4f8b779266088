#include "nurbs/number_text.h"

#include <sstream>

namespace nurbeam {

std::string text_of(double value, int digits) {
  std::ostringstream text;
  text.precision(digits);
  text << value;
  return text.str();
}

std::string text_of(const Eigen::Vector3d& point, int digits) {
  return "(" + text_of(point.x(), digits) + ", " + text_of(point.y(), digits) + ", " +
         text_of(point.z(), digits) + ") m";
}

}  // namespace nurbeam
