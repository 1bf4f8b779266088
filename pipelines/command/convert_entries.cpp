#include "pipelines/command/convert_entries.h"

#include <Eigen/Geometry>
#include <charconv>
#include <numbers>
#include <ostream>

#include "pipelines/case/quantity.h"
#include "pipelines/command/convert.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

std::vector<std::string> items_of(const std::string& list) {
  std::vector<std::string> items{""};
  for (const char c : list)
    if (c == ',')
      items.emplace_back();
    else
      items.back() += c;
  return items;
}

std::vector<double> values_of(const std::string& option, const std::string& list, Dimension dimension) {
  std::vector<double> values;
  for (const std::string& item : items_of(list)) values.push_back(quantity_argument(option, item, dimension));
  return values;
}

Eigen::Vector3d vector_of(const std::string& option, const std::string& list, Dimension dimension) {
  const std::vector<double> values = values_of(option, list, dimension);
  if (values.size() != 3)
    throw UsageError(option + ": " + in_quotes(list) + " has " + std::to_string(values.size()) +
                     " value(s); give three, as 1,0,0");
  return {values[0], values[1], values[2]};
}

/// "x", "y", "z", or a vector.
Eigen::Vector3d direction_of(const std::string& option, const std::string& text) {
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if (text.size() == 1 && text[0] >= 'x' && text[0] <= 'z') return axes.col(text[0] - 'x');
  const Eigen::Vector3d direction = vector_of(option, text, Dimension::number);
  if (!(direction.norm() > 0)) throw UsageError(option + ": is 0,0,0; must have a direction");
  return direction.normalized();
}

Eigen::Vector3d factors_of(const std::string& text) {
  const std::vector<double> values = values_of("--scale", text, Dimension::number);
  if (values.size() != 1 && values.size() != 3)
    throw UsageError("--scale: " + in_quotes(text) + " is neither one factor nor three, as 1,2,1");
  for (const double value : values)
    if (!(value > 0))
      throw UsageError("--scale: has the factor " + std::to_string(value) +
                       "; must be greater than 0; --mirror mirrors");
  return values.size() == 1 ? Eigen::Vector3d::Constant(values[0])
                            : Eigen::Vector3d(values[0], values[1], values[2]);
}

Eigen::Affine3d map_of(const Arguments& arguments) {
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  if (arguments.has("--scale")) map = Eigen::Scaling(factors_of(arguments.value("--scale", ""))) * map;
  if (arguments.has("--mirror")) {
    const Eigen::Vector3d normal = direction_of("--mirror", arguments.value("--mirror", ""));
    map = Eigen::Affine3d(Eigen::Matrix3d::Identity() - 2 * normal * normal.transpose()) * map;
  }
  if (arguments.has("--axis") && !arguments.has("--turn"))
    throw UsageError("--axis: is that of a turn; give its angle with --turn");
  if (arguments.has("--turn")) {
    constexpr double degree = std::numbers::pi / 180;
    const double angle =
        degree * quantity_argument("--turn", arguments.value("--turn", ""), Dimension::angle);
    map = Eigen::AngleAxisd(angle, direction_of("--axis", arguments.value("--axis", "z"))) * map;
  }
  const Eigen::Vector3d about = vector_of("--about", arguments.value("--about", "0,0,0"), Dimension::length);
  const Eigen::Vector3d move = vector_of("--move", arguments.value("--move", "0,0,0"), Dimension::length);
  return Eigen::Translation3d(move + about) * map * Eigen::Translation3d(-about);
}

Conversion conversion_of(const Arguments& arguments) {
  Conversion conversion{.curves = arguments.values("--curve"),
                        .join = arguments.has("--join"),
                        .exact = arguments.has("--exact")};
  if (arguments.has("--unit")) conversion.unit = parse_length_unit(arguments.value("--unit", ""));
  if (arguments.has("--split-at"))
    conversion.split_at = values_of("--split-at", arguments.value("--split-at", ""), Dimension::number);
  return conversion;
}

int convert_command(const Arguments& arguments, Streams streams) {
  return convert_file(arguments.positional[0], arguments.positional[1], conversion_of(arguments), streams.out,
                      streams.err);
}

int transform_command(const Arguments& arguments, Streams streams) {
  Conversion conversion = conversion_of(arguments);
  conversion.map = map_of(arguments).matrix().topRows<3>();
  return convert_file(arguments.positional[0], arguments.positional[1], conversion, streams.out, streams.err);
}

std::vector<CommandOption> common_options() {
  return {{"--unit", "mm|m|inch", "of OUT; otherwise that of IN, or mm"},
          {"--curve", "NAME|N", "only this curve, by its name or number; otherwise all that are not hidden",
           false, true},
          {"--exact", "", "refuses what would be approximated"}};
}

std::vector<CommandOption> with_common(std::vector<CommandOption> options) {
  for (CommandOption& option : common_options()) options.push_back(std::move(option));
  return options;
}

}  // namespace

Command convert_entry() {
  return {
      "convert",
      "IN OUT",
      "writes the curves of a CAD file to another one, in the format of its name: .step, .igs, .dxf, .brep, "
      ".json, .svg",
      2,
      2,
      with_common({{"--join", "", "curves that meet end to end become one"},
                   {"--split-at", "U,...", "cuts curves at these parameters"}}),
      convert_command,
      exit_not_written};
}

Command transform_entry() {
  return {"transform",
          "IN OUT",
          "writes the curves of a CAD file scaled, mirrored, turned and moved, in this order",
          2,
          2,
          with_common({{"--scale", "F|X,Y,Z", "factor, or one along each axis"},
                       {"--mirror", "x|y|z|X,Y,Z", "at the plane with this normal"},
                       {"--turn", "ANGLE", "by the right hand, in degrees or as \"1.5 rad\""},
                       {"--axis", "x|y|z|X,Y,Z", "of the turn; otherwise z"},
                       {"--move", "X,Y,Z", "in metres, or as \"5 mm,0,0\""},
                       {"--about", "X,Y,Z",
                        "the point that scaling, mirroring and turning leave; otherwise the origin"}}),
          transform_command,
          exit_not_written};
}

}  // namespace nurbeam
