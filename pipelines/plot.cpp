#include "pipelines/plot.h"

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

// Round numbers within the axis: 1, 2 or 5 times a power of ten apart; whole decades where it is logarithmic.
std::vector<double> ticks(const Axis& axis) {
  const double range = axis.high - axis.low;
  double step = std::pow(10, std::floor(std::log10(range / 5)));
  if (axis.logarithmic)
    step = std::max(1.0, std::ceil(range / 8));
  else if (range / step > 25)
    step *= 5;
  else if (range / step > 10)
    step *= 2;
  std::vector<double> values;
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
    for (std::size_t i = 0; i < plot_.lines.size(); ++i)
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
    return axis.logarithmic ? "1e" + text(value) : text(value);
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
      marks << "<circle cx=\"" << x << "\" cy=\"" << y << "\" r=\"3\" fill=\"" << colour << "\"/>\n";
      down = true;
    }
    if (line.style != Style::marks)
      out_ << "<path d=\"" << path.str() << "\" fill=\"none\" stroke=\"" << colour
           << "\" stroke-width=\"1.5\"" << (line.style == Style::dashed ? " stroke-dasharray=\"6 4\"" : "")
           << "/>\n";
    if (line.style == Style::marks || line.style == Style::line_and_marks) out_ << marks.str();
  }

  // Upper left corner of the legend: in the corner of the diagram where it covers the fewest values.
  std::pair<double, double> legend_corner(double legend_width, double legend_height) const {
    std::pair<double, double> best;
    int fewest = std::numeric_limits<int>::max();
    for (const double x : {left + 12, left + plot_width - legend_width})
      for (const double y : {top + 4, top + plot_height - legend_height - 4}) {
        int covered = 0;
        for (const PlotLine& line : plot_.lines)
          for (std::size_t i = 0; i < line.x.size(); ++i) {
            if (!x_.takes(line.x[i]) || !y_.takes(line.y[i])) continue;
            const double at_x = px(x_.of(line.x[i])), at_y = py(y_.of(line.y[i]));
            covered += at_x >= x && at_x <= x + legend_width && at_y >= y && at_y <= y + legend_height;
          }
        if (covered >= fewest) continue;
        fewest = covered;
        best = {x, y};
      }
    return best;
  }

  void draw_legend() {
    constexpr double line_height = 16, letter_width = 6.6, sample = 28;
    double legend_width = 0, legend_height = 0;
    for (const PlotLine& line : plot_.lines) {
      if (line.label.empty()) continue;
      legend_width = std::max(legend_width, sample + letter_width * static_cast<double>(line.label.size()));
      legend_height += line_height;
    }
    auto [x, y] = legend_corner(legend_width, legend_height);
    y += 14;
    for (std::size_t i = 0; i < plot_.lines.size(); ++i) {
      const PlotLine& line = plot_.lines[i];
      if (line.label.empty()) continue;
      const char* colour = colours[i % colours.size()];
      if (line.style == PlotLine::Style::marks)
        out_ << "<path d=\"M" << x + 8 << ' ' << y - 4 << "a3 3 0 1 0 6 0a3 3 0 1 0 -6 0\" fill=\"" << colour
             << "\"/>\n";
      else
        out_ << "<path d=\"M" << x << ' ' << y - 4 << "h22\" stroke=\"" << colour << "\" stroke-width=\"2.5\""
             << (line.style == PlotLine::Style::dashed ? " stroke-dasharray=\"6 4\"" : "") << "/>\n";
      write(x + sample, y, "start", line.label, "stroke=\"white\" stroke-width=\"3\" paint-order=\"stroke\"");
      y += line_height;
    }
  }

  const Plot& plot_;
  Axis x_, y_;
  std::ostringstream out_;
};

}  // namespace

std::string svg(const Plot& plot) { return Drawing(plot).svg(); }

}  // namespace nurbeam
