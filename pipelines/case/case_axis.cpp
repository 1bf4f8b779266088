#include "pipelines/case/case_axis.h"

#include <algorithm>
#include <cmath>

#include "cad_import/files/cad_file_name.h"
#include "nurbs/curve_through.h"
#include "nurbs/even_knots.h"
#include "nurbs/number_text.h"
#include "pipelines/case/case_values.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

Shape axis_shape() {
  using namespace shapes;
  const Shape nurbs = object(
      {{"degree", integer(from(1)), "degree of the curve", required},
       {"knots", array(quantity(Dimension::number), 4),
        "full non-decreasing knots, both ends included; those of a clamped curve with equal spans on [0, 1] "
        "when omitted"},
       {"control_points", array(point(), 2), "plain (not weighted) control points", required},
       {"weights", array(quantity(Dimension::number, positive()), 2),
        "one per control point; 1 when omitted"}});
  const Shape arc =
      object({{"center", point(), "centre of the circle", required},
              {"start", point(), "start point", required},
              {"end", point(), "end point", required},
              {"normal", vector(Dimension::number),
               "the arc turns by the right hand about it; a whole circle where start and end are one point",
               required}});
  return object(
      {{"file", any_text(),
        std::string(cad_formats) +
            " file, which may be packed (.stpZ, .zip, .gz), relative to the case file"},
       {"curve", either(any_text(), integer(from(1))),
        "name or index (from 1) as `nurbeam inspect` prints them", false, "file"},
       {"chain", boolean(), "also the tangent-continuous curves connected to `curve`", false, "curve"},
       {"part", any_text(), only_part, false, "file"},
       {"layer", any_text(), only_layer, false, "file"},
       {"colour", any_text(), only_colour, false, "file"},
       {"near", point(), "the chain of curves nearest to this point", false, "file"},
       {"longest", boolean(), "the longest chain of curves", false, "file"},
       {"chains", choice({"all"}), "every chain becomes a beam: \"name 1\", \"name 2\", ...", false, "file"},
       {"gap", quantity(Dimension::length, not_negative()),
        "ends of curves up to this far apart meet; the file's own resolution when omitted", false, "file"},
       {"nurbs", nurbs, "an inline NURBS curve"},
       {"polyline", array(point(), 2), "straight pieces through these points"},
       {"bend_radius",
        either(quantity(Dimension::length, positive()), array(quantity(Dimension::length, positive()), 1)),
        "of arcs instead of the corners, as a bent tube has: one for all, or one for each corner in turn; "
        "where the last point is the first there is one too; corners stay when omitted",
        false, "polyline"},
       {"through", array(point(), 2),
        "the smooth curve through these points; closed where the last one is the first"},
       {"degree", integer(from(1)), "of that curve; 3, or less for fewer points, when omitted", false,
        "through"},
       {"tangents", array(vector(Dimension::number), 2),
        "its directions: at both ends, or one at every point; found from the points when omitted", false,
        "through"},
       {"arc", arc, "a circular arc"}},
      {{{"file", "nurbs", "polyline", "through", "arc"}, required},
       {{"curve", "near", "longest", "chains"}, false}});
}

namespace {

std::vector<std::string> cad_files_in(const std::filesystem::path& directory) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(directory, ignored))
    if (is_named_as_cad_file(entry.path())) names.push_back(entry.path().filename().string());
  return names;
}

CaseAxis::File read_axis_file(const Json& axis, const std::filesystem::path& directory,
                              const std::string& path, Findings& findings) {
  CaseAxis::File file;
  file.path = (directory / text(axis, "file")).lexically_normal();
  file.chain = flag(axis, "chain");
  file.layer = optional_text(axis, "layer");
  file.part = optional_text(axis, "part");
  file.colour = optional_text(axis, "colour");
  if (has(axis, "near")) file.near = vector(axis, "near");
  file.longest = flag(axis, "longest");
  file.all_chains = text(axis, "chains") == "all";
  file.gap = optional_number(axis, "gap");
  if (has(axis, "curve")) {
    const Json& curve = axis["curve"];
    if (curve.is_string())
      file.curve_name = curve.get<std::string>();
    else
      file.curve_index = curve.get<int>();
  }
  check_cad_file(file.path, child(path, "file"), findings);
  return file;
}

// With a greater ratio all but a sliver of the parameter lies at one control point. Only ratios matter: where
// products with points might overflow they are divided by a power of two, which changes no digit.
bool scale_weights(std::vector<double>& weights, const std::string& path, Findings& findings) {
  constexpr double greatest_ratio = 1e9;
  const auto [least, largest] = std::minmax_element(weights.begin(), weights.end());
  if (*largest > greatest_ratio * *least) {
    findings.error(path, "are from " + text_of(*least) + " to " + text_of(*largest) +
                             "; the largest may be at most " + text_of(greatest_ratio, 1) +
                             " times the smallest");
    return false;
  }
  if (const int exponent = std::ilogb(*largest); std::abs(exponent) > 64)
    for (double& weight : weights) weight = std::ldexp(weight, -exponent);
  return true;
}

std::optional<NurbsCurve> read_nurbs(const Json& nurbs, const std::string& path, Findings& findings) {
  const std::vector<Eigen::Vector3d> points_in = points(nurbs, "control_points");
  std::vector<double> knots = numbers(nurbs, "knots");
  std::vector<double> weights = numbers(nurbs, "weights");
  const bool complete = has(nurbs, "degree") && points_in.size() == part(nurbs, "control_points").size() &&
                        knots.size() == part(nurbs, "knots").size() &&
                        weights.size() == part(nurbs, "weights").size();
  if (!complete || points_in.empty()) return {};  // what is missing has been reported
  const int degree = nurbs["degree"].get<int>(), count = static_cast<int>(points_in.size());
  if (!has(nurbs, "knots")) {
    if (nurbs.contains("knots")) return {};
    if (count <= degree) {
      findings.error(path, "has " + std::to_string(count) + " control points; a curve of degree " +
                               std::to_string(degree) + " has at least " + std::to_string(degree + 1));
      return {};
    }
    knots = even_clamped_knots(degree, count);
  }
  if (!has(nurbs, "weights")) weights.assign(points_in.size(), 1.0);
  if (weights.size() != points_in.size()) {
    findings.error(path, "has " + std::to_string(weights.size()) + " weights for " +
                             std::to_string(points_in.size()) +
                             " control points; give one per control point");
    return {};
  }
  if (!scale_weights(weights, child(path, "weights"), findings)) return {};
  Eigen::Matrix3Xd control_points(3, points_in.size());
  for (std::size_t i = 0; i < points_in.size(); ++i) control_points.col(i) = points_in[i];
  try {
    return make_nurbs_curve(KnotVector(degree, knots), control_points,
                            Eigen::Map<const Eigen::VectorXd>(weights.data(), weights.size()));
  } catch (const std::invalid_argument& error) {
    findings.error(path, error.what());
    return {};
  }
}

bool is_sound(const CaseAxis::Polyline& polyline, const std::string& path, Findings& findings) {
  bool sound = true;
  for (std::size_t i = 1; i < polyline.size(); ++i)
    if (polyline[i] == polyline[i - 1]) {
      findings.error(child(child(path, "polyline"), i), "is the same point as the one before; remove one");
      sound = false;
    }
  return sound;
}

// Of which the last digit shown is no more than the number.
std::string rounded_down(double number) {
  constexpr int digits = 5;
  const double last = std::pow(10, std::floor(std::log10(number)) - (digits - 1));
  return text_of(std::floor(number / last) * last, digits);
}

std::string text_of_tight(const BentLines& lines, const TightBend& bend) {
  const std::size_t i = lines.point_of(bend.corner);
  const std::string corner = "polyline[" + std::to_string(i) + "], " + text_of(lines.points[i]);
  if (bend.folds)
    return "rounds no corner where the line goes back on itself, as at " + corner + "; remove that point";
  const std::string is = "is " + text_of(bend.radius, all_digits) + " m; at the corner " + corner + ", ";
  if (!(bend.largest > 0)) return is + "the arcs beside it leave no room for one: make those smaller";
  return is + "the lines are long enough for at most " + rounded_down(bend.largest) + " m" +
         (lines.radii.size() > 1 ? ", beside the arcs next to it" : "");
}

// Lines with arcs in the place of their corners.
std::optional<BentLines> read_bent_lines(const Json& axis, const std::string& axis_path, Findings& findings) {
  BentLines lines{points(axis, "polyline"), {}};
  if (lines.points.size() < 2 || lines.points.size() != part(axis, "polyline").size()) return {};
  const std::string path = child(axis_path, "bend_radius");
  const bool alike = axis["bend_radius"].is_number();
  lines.radii = alike ? std::vector{number(axis, "bend_radius")} : numbers(axis, "bend_radius");
  if (!alike && lines.radii.size() != axis["bend_radius"].size()) return {};
  const std::size_t corners = lines.corner_count();
  if (corners == 0) {
    findings.error(path, "is of corners, but one line has none; give \"polyline\" a third point");
    return {};
  }
  if (!alike && lines.radii.size() != corners) {
    findings.error(path, "has " + std::to_string(lines.radii.size()) + " radii for " +
                             std::to_string(corners) + " corners; give one for each, or one number for all");
    return {};
  }
  if (const auto tight = tight_bend(lines)) {
    findings.error(alike ? path : child(path, tight->corner), text_of_tight(lines, *tight));
    return {};
  }
  return lines;
}

CaseAxis read_polyline(const Json& axis, const std::string& path, Findings& findings) {
  const CaseAxis::Polyline polyline = points(axis, "polyline");
  if (!is_sound(polyline, path, findings) || !has(axis, "bend_radius")) return {polyline};
  const auto lines = read_bent_lines(axis, path, findings);
  return lines ? CaseAxis{*lines} : CaseAxis{};
}

std::optional<NurbsCurve> read_through(const Json& axis, const std::string& path, Findings& findings) {
  const std::vector<Eigen::Vector3d> through = points(axis, "through"), tangents = points(axis, "tangents");
  if (through.size() < 2 || through.size() != part(axis, "through").size() ||
      tangents.size() != part(axis, "tangents").size())
    return {};  // what is missing has been reported
  const bool closed = through.size() > 3 && through.front() == through.back();
  const int usual = tangents.empty() && !closed ? std::min(3, static_cast<int>(through.size()) - 1) : 3;
  try {
    return curve_through(through, {optional_integer(axis, "degree").value_or(usual), tangents, closed});
  } catch (const std::invalid_argument& error) {
    findings.error(child(path, "through"), error.what());
    return {};
  }
}

CaseAxis::Arc read_arc(const Json& axis, const std::string& axis_path, Findings& findings) {
  const Json& json = part(axis, "arc");
  const std::string path = child(axis_path, "arc");
  const CaseAxis::Arc arc = {vector(json, "center"), vector(json, "start"), vector(json, "end"),
                             vector(json, "normal")};
  const Eigen::Vector3d a = arc.start - arc.center, b = arc.end - arc.center;
  constexpr double relative = 1e-6;
  // Comparisons with a missing (NaN) point are false: it has been reported.
  if (arc.normal.norm() == 0) {
    findings.error(child(path, "normal"), "is [0, 0, 0]; must have a direction");
  } else if (a.norm() == 0) {
    findings.error(child(path, "start"), "is the center; must be apart from it");
  } else if (std::abs(a.norm() - b.norm()) > relative * a.norm()) {
    findings.error(path, "start is " + text_of(a.norm(), all_digits) + " m and end " +
                             text_of(b.norm(), all_digits) + " m from the center; must be the same distance");
  } else if (std::max(std::abs(a.dot(arc.normal)), std::abs(b.dot(arc.normal))) >
             relative * a.norm() * arc.normal.norm()) {
    findings.error(child(path, "normal"), "is not perpendicular to the plane of center, start and end");
  } else if (const double apart = (a - b).norm(); apart > 0 && apart <= relative * a.norm()) {
    findings.error(path, "start and end are " + text_of(apart) +
                             " m apart, too little for an arc; give the same point twice for a whole circle");
  }
  return arc;
}

}  // namespace

void check_cad_file(const std::filesystem::path& file, const std::string& path, Findings& findings) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(file, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    const bool is_directory = std::filesystem::is_directory(status);
    findings.error(path, in_quotes(file.string()) + " is a " +
                             (is_directory ? "directory" : "device or pipe") + "; expected a " + cad_formats +
                             " file" + (is_directory ? known_names("", cad_files_in(file)) : ""));
  } else if (!std::filesystem::exists(status)) {
    const std::filesystem::path folder = file.parent_path();
    const std::vector<std::string> there = cad_files_in(folder);
    const std::string why = !std::filesystem::is_directory(folder, ignored)
                                ? "; there is no folder " + in_quotes(folder.string())
                                : "; no CAD file is in that folder";
    findings.error(path, "there is no file " + in_quotes(file.string()) +
                             (there.empty() ? why + "; paths are relative to the case file"
                                            : known_names(file.filename().string(), there)));
  }
}

CaseAxis read_beam_axis(const Json& axis, const std::string& path, const std::filesystem::path& directory,
                        Findings& findings) {
  if (has(axis, "file")) return {read_axis_file(axis, directory, path, findings)};
  if (has(axis, "nurbs")) {
    const auto curve = read_nurbs(axis["nurbs"], child(path, "nurbs"), findings);
    return curve ? CaseAxis{*curve} : CaseAxis{};
  }
  if (has(axis, "through")) {
    const auto curve = read_through(axis, path, findings);
    return curve ? CaseAxis{*curve} : CaseAxis{};
  }
  if (has(axis, "polyline")) return read_polyline(axis, path, findings);
  if (has(axis, "arc")) return {read_arc(axis, path, findings)};
  return {};
}

// A disk, or with a bore a pipe.

}  // namespace nurbeam
