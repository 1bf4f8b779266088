#include "pipelines/papers/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace nurbeam {

namespace {

// Okabe and Ito's colours, without the yellow that is pale on white.
constexpr std::array<const char*, 7> colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                             "#56b4e9", "#e69f00", "#000000"};
constexpr double width = 640, height = 420, left = 78, right = 16, top = 34, bottom = 52;

struct Axis {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  bool logarithmic = false;

  bool takes(double value) const { return std::isfinite(value) && (!logarithmic || value > 0); }
  double of(double value) const { return logarithmic ? std::log10(value) : value; }
  void include(double value) {
    low = std::min(low, of(value));
    high = std::max(high, of(value));
  }
  void widen() {
    const double margin = high > low ? 0.04 * (high - low) : std::max(0.5, 0.1 * std::abs(high));
    low -= margin;
    high += margin;
  }
};

std::string text(double value) {
  std::ostringstream stream;
  stream.precision(6);
  stream << (std::abs(value) < 1e-300 ? 0 : value);
  return stream.str();
}

std::string escaped(const std::string& plain) {
  std::string out;
  for (char c : plain) out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

// Round numbers within the axis: 1, 2 or 5 times a power of ten apart; where it is logarithmic whole decades,
// and 2 and 5 times them on a short axis.
std::vector<double> ticks(const Axis& axis) {
  const double range = axis.high - axis.low;
  std::vector<double> values;
  if (axis.logarithmic && range < 2.5) {
    for (double decade = std::floor(axis.low); decade <= axis.high; ++decade)
      for (double k : {1.0, 2.0, 5.0}) {
        const double value = decade + std::log10(k);
        if (value >= axis.low && value <= axis.high) values.push_back(value);
      }
    if (values.size() > 1) return values;
    values.clear();
  }
  double step = std::pow(10, std::floor(std::log10(range / 5)));
  if (axis.logarithmic)
    step = std::max(1.0, std::ceil(range / 8));
  else if (range / step > 25)
    step *= 5;
  else if (range / step > 10)
    step *= 2;
  for (double k = std::ceil(axis.low / step); k * step <= axis.high; ++k) values.push_back(k * step);
  return values;
}

class Drawing {
 public:
  explicit Drawing(const Plot& plot) : plot_(plot) {
    x_.logarithmic = plot.log_x;
    y_.logarithmic = plot.log_y;
    for (const PlotLine& line : plot.lines) {
      if (line.x.size() != line.y.size())
        throw std::invalid_argument("line \"" + line.label + "\" has " + std::to_string(line.x.size()) +
                                    " x values and " + std::to_string(line.y.size()) + " y values");
      for (std::size_t i = 0; i < line.x.size(); ++i) {
        if (!x_.takes(line.x[i]) || !y_.takes(line.y[i])) continue;
        x_.include(line.x[i]);
        y_.include(line.y[i]);
      }
    }
    if (!(x_.low <= x_.high)) throw std::invalid_argument("plot \"" + plot.title + "\" has nothing to draw");
    x_.widen();
    y_.widen();
    if (plot.equal_axes) make_equal();
  }

  std::string svg() {
    out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << width << ' ' << height
         << "\" width=\"" << width << "\" height=\"" << height
         << "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" "
            "fill=\"white\"/>\n";
    draw_axes();
    // Marks alone lie on top, so that no line hides them.
    for (const bool marks : {false, true})
      for (std::size_t i = 0; i < plot_.lines.size(); ++i)
        if ((plot_.lines[i].style == PlotLine::Style::marks) == marks)
          draw_line(plot_.lines[i], colours[i % colours.size()]);
    draw_legend();
    out_ << "</svg>\n";
    return out_.str();
  }

 private:
  static constexpr double plot_width = width - left - right, plot_height = height - top - bottom;

  double px(double x) const { return left + plot_width * (x - x_.low) / (x_.high - x_.low); }
  double py(double y) const { return top + plot_height * (y_.high - y) / (y_.high - y_.low); }

  void make_equal() {
    const double scale = std::max((x_.high - x_.low) / plot_width, (y_.high - y_.low) / plot_height);
    const auto stretch = [&](Axis& axis, double pixels) {
      const double middle = (axis.low + axis.high) / 2;
      axis.low = middle - scale * pixels / 2;
      axis.high = middle + scale * pixels / 2;
    };
    stretch(x_, plot_width);
    stretch(y_, plot_height);
  }

  void write(double x, double y, const std::string& anchor, const std::string& words,
             const std::string& more = "") {
    out_ << "<text x=\"" << text(x) << "\" y=\"" << text(y) << "\" text-anchor=\"" << anchor << "\" " << more
         << '>' << escaped(words) << "</text>\n";
  }

  static std::string label(const Axis& axis, double value) {
    if (!axis.logarithmic) return text(value);
    const double number = std::pow(10, value);
    if (number > 0.9e-2 && number < 1.1e4) return text(number);
    const double decade = std::floor(value + 1e-9), factor = std::round(std::pow(10, value - decade));
    return text(factor) + "e" + text(decade);
  }

  void draw_axes() {
    for (double x : ticks(x_)) {
      out_ << "<path d=\"M" << text(px(x)) << ' ' << top << "V" << top + plot_height
           << "\" stroke=\"#dddddd\"/>\n";
      write(px(x), top + plot_height + 17, "middle", label(x_, x));
    }
    for (double y : ticks(y_)) {
      out_ << "<path d=\"M" << left << ' ' << text(py(y)) << "H" << left + plot_width
           << "\" stroke=\"#dddddd\"/>\n";
      write(left - 6, py(y) + 4, "end", label(y_, y));
    }
    out_ << "<rect x=\"" << left << "\" y=\"" << top << "\" width=\"" << plot_width << "\" height=\""
         << plot_height << "\" fill=\"none\" stroke=\"#555555\"/>\n";
    write(left + plot_width / 2, 20, "middle", plot_.title, "font-size=\"14\"");
    write(left + plot_width / 2, height - 14, "middle", plot_.x_label);
    const std::string turned = "transform=\"rotate(-90 18 " + text(top + plot_height / 2) + ")\"";
    write(18, top + plot_height / 2, "middle", plot_.y_label, turned);
  }

  void draw_line(const PlotLine& line, const char* colour) {
    using Style = PlotLine::Style;
    std::ostringstream path, marks;
    bool down = false;
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      if (!x_.takes(line.x[i]) || !y_.takes(line.y[i])) {
        down = false;
        continue;
      }
      const std::string x = text(px(x_.of(line.x[i]))), y = text(py(y_.of(line.y[i])));
      path << (down ? 'L' : 'M') << x << ' ' << y;
      marks << mark(x, y, line.style, colour);
      down = true;
    }
    if (line.style != Style::marks)
      out_ << "<path d=\"" << path.str() << "\" fill=\"none\" stroke=\"" << colour
           << "\" stroke-width=\"1.5\"" << (line.style == Style::dashed ? " stroke-dasharray=\"6 4\"" : "")
           << "/>\n";
    if (line.style == Style::marks || line.style == Style::line_and_marks) out_ << marks.str();
  }

  static std::string mark(const std::string& x, const std::string& y, PlotLine::Style style,
                          const char* colour) {
    const bool alone = style == PlotLine::Style::marks;
    return "<circle cx=\"" + x + "\" cy=\"" + y + "\" r=\"" + (alone ? "4" : "3") + "\" fill=\"" + colour +
           (alone ? "\" stroke=\"white" : "") + "\"/>\n";
  }

  // How many points along the lines lie in a box of the picture.
  int covered(double x0, double y0, double box_width, double box_height) const {
    int count = 0;
    const auto inside = [&](double x, double y) {
      return x > x0 && x < x0 + box_width && y > y0 && y < y0 + box_height;
    };
    for (const PlotLine& line : plot_.lines)
      for (std::size_t i = 0; i < line.x.size(); ++i) {
        if (!x_.takes(line.x[i]) || !y_.takes(line.y[i])) continue;
        const double x = px(x_.of(line.x[i])), y = py(y_.of(line.y[i]));
        count += inside(x, y);
        if (i == 0 || line.style == PlotLine::Style::marks) continue;
        if (!x_.takes(line.x[i - 1]) || !y_.takes(line.y[i - 1])) continue;
        const double dx = px(x_.of(line.x[i - 1])) - x, dy = py(y_.of(line.y[i - 1])) - y;
        const int pieces = static_cast<int>(std::hypot(dx, dy) / 5);
        for (int k = 1; k < pieces; ++k) count += inside(x + dx * k / pieces, y + dy * k / pieces);
      }
    return count;
  }

  // In the corner, or the middle of a side, where it covers least.
  void draw_legend() {
    std::size_t longest = 0;
    int rows = 0;
    for (const PlotLine& line : plot_.lines) {
      if (line.label.empty()) continue;
      longest = std::max(longest, line.label.size());
      ++rows;
    }
    if (rows == 0) return;
    const double box_width = 46 + 6.6 * static_cast<double>(longest), box_height = 16.0 * rows + 10;
    const double x_far = left + plot_width - box_width - 4, y_far = top + plot_height - box_height - 4;
    double x0 = left + 4, y0 = top + 4;
    int least = std::numeric_limits<int>::max();
    for (const double x : {left + 4, x_far, (left + x_far) / 2})
      for (const double y : {top + 4, y_far, (top + y_far) / 2})
        if (const int count = covered(x, y, box_width, box_height); count < least) {
          least = count;
          x0 = x;
          y0 = y;
        }
    out_ << "<rect x=\"" << x0 << "\" y=\"" << y0 << "\" width=\"" << box_width << "\" height=\""
         << box_height << "\" fill=\"white\" fill-opacity=\"0.8\"/>\n";
    double y = y0 + 18;
    for (std::size_t i = 0; i < plot_.lines.size(); ++i) {
      using Style = PlotLine::Style;
      const PlotLine& line = plot_.lines[i];
      if (line.label.empty()) continue;
      const double x = x0 + 8;
      const char* colour = colours[i % colours.size()];
      if (line.style != Style::marks)
        out_ << "<path d=\"M" << x << ' ' << y - 4 << "h22\" stroke=\"" << colour << "\" stroke-width=\"2.5\""
             << (line.style == Style::dashed ? " stroke-dasharray=\"6 4\"" : "") << "/>\n";
      if (line.style == Style::marks || line.style == Style::line_and_marks)
        out_ << mark(text(x + 11), text(y - 4), line.style, colour);
      write(x + 28, y, "start", line.label);
      y += 16;
    }
  }

  const Plot& plot_;
  Axis x_, y_;
  std::ostringstream out_;
};

}  // namespace

std::string svg(const Plot& plot) { return Drawing(plot).svg(); }

}  // namespace nurbeam
