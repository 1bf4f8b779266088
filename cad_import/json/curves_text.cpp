#include "cad_import/json/curves_text.h"

#include <Eigen/Geometry>
#include <charconv>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <utility>

namespace nurbeam {
namespace {

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

class JsonText {
 public:
  void add(std::string_view text) { text_ += text; }
  void add(double value) {
    char digits[32];
    text_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  }
  void add(std::span<const double> values) {
    add("[");
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i > 0) add(", ");
      add(values[i]);
    }
    add("]");
  }
  std::string text() && { return std::move(text_); }

 private:
  std::string text_;
};

void add_curve(const NamedCurve& named, double unit, JsonText& out) {
  const NurbsCurve& curve = named.curve;
  const Eigen::Matrix3Xd points = curve.control_points().colwise().hnormalized() / unit;
  out.add("    {\"name\": " + quoted(named.name));
  for (const auto& [key, text] :
       {std::pair("part", &named.part), {"layer", &named.layer}, {"colour", &named.colour}})
    if (!text->empty()) out.add(std::string(", \"") + key + "\": " + quoted(*text));
  out.add(",\n     \"degree\": " + std::to_string(curve.degree()) + ",\n     \"knots\": ");
  out.add(curve.knots().knots());
  out.add(",\n     \"control_points\": [");
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (i > 0) out.add(", ");
    out.add(std::span<const double>(points.col(i).data(), 3));
  }
  out.add("]");
  if (curve.is_rational()) {
    const Eigen::VectorXd weights = curve.control_points().row(3);
    out.add(",\n     \"weights\": ");
    out.add(std::span<const double>(weights.data(), static_cast<std::size_t>(weights.size())));
  }
  out.add("}");
}

}  // namespace

std::string json_text(const std::vector<NamedCurve>& curves, LengthUnit unit) {
  JsonText out;
  out.add("{\n  \"unit\": " + quoted(name_of(unit)) + ",\n  \"curves\": [\n");
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (i > 0) out.add(",\n");
    add_curve(curves[i], metres_of(unit), out);
  }
  out.add("\n  ]\n}\n");
  return std::move(out).text();
}

}  // namespace nurbeam
