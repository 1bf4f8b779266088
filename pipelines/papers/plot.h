#pragma once
#include <string>
#include <vector>

namespace nurbeam {

struct PlotLine {
  std::string label;  ///< empty: not in the legend
  std::vector<double> x, y;
  enum class Style { line, dashed, marks, line_and_marks } style = Style::line;
};

/// One diagram; lines get colours that colour-blind readers can tell apart, in order.
struct Plot {
  std::string title, x_label, y_label;
  std::vector<PlotLine> lines;
  bool log_x = false, log_y = false;  ///< values that are not positive are left out
  bool equal_axes = false;            ///< the same scale on both axes, for shapes
};

/// The plot as a self-contained SVG document. Values that are not finite are left out. Throws
/// std::invalid_argument when a line's x and y differ in length or no line has a value to draw.
std::string svg(const Plot& plot);

}  // namespace nurbeam
