#include "pipelines/case/case_beam.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <numbers>
#include <set>

#include "cad_import/files/cad_format.h"
#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

std::vector<std::string> cad_files_in(const std::filesystem::path& directory) {
  static const std::set<std::string> extensions = {".step", ".stp", ".iges", ".igs",
                                                   ".STEP", ".STP", ".IGES", ".IGS"};
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(directory, ignored))
    if (extensions.contains(entry.path().extension().string()))
      names.push_back(entry.path().filename().string());
  return names;
}

/// Reports a CAD file that is not there.
void check_cad_file(const std::filesystem::path& file, const std::string& path, Findings& findings) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(file, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    const bool is_directory = std::filesystem::is_directory(status);
    findings.error(path, in_quotes(file.string()) + " is a " +
                             (is_directory ? "directory" : "device or pipe") +
                             "; expected a STEP or IGES file" +
                             (is_directory ? known_names("", cad_files_in(file)) : ""));
  } else if (!std::filesystem::exists(status)) {
    findings.error(path, "there is no file " + in_quotes(file.string()) +
                             known_names(file.filename().string(), cad_files_in(file.parent_path())));
  }
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

std::optional<NurbsCurve> read_nurbs(const Json& nurbs, const std::string& path, Findings& findings) {
  const std::vector<Eigen::Vector3d> points_in = points(nurbs, "control_points");
  const std::vector<double> knots = numbers(nurbs, "knots");
  std::vector<double> weights = numbers(nurbs, "weights");
  const bool complete = has(nurbs, "degree") && points_in.size() == part(nurbs, "control_points").size() &&
                        knots.size() == part(nurbs, "knots").size() &&
                        weights.size() == part(nurbs, "weights").size();
  if (!complete || knots.empty() || points_in.empty()) return {};  // what is missing has been reported
  if (!has(nurbs, "weights")) weights.assign(points_in.size(), 1.0);
  if (weights.size() != points_in.size()) {
    findings.error(path, "has " + std::to_string(weights.size()) + " weights for " +
                             std::to_string(points_in.size()) +
                             " control points; give one per control point");
    return {};
  }
  Eigen::Matrix3Xd control_points(3, points_in.size());
  for (std::size_t i = 0; i < points_in.size(); ++i) control_points.col(i) = points_in[i];
  try {
    return make_nurbs_curve(KnotVector(nurbs["degree"].get<int>(), knots), control_points,
                            Eigen::Map<const Eigen::VectorXd>(weights.data(), weights.size()));
  } catch (const std::invalid_argument& error) {
    findings.error(path, error.what());
    return {};
  }
}

CaseAxis::Polyline read_polyline(const Json& axis, const std::string& path, Findings& findings) {
  const CaseAxis::Polyline polyline = points(axis, "polyline");
  for (std::size_t i = 1; i < polyline.size(); ++i)
    if (polyline[i] == polyline[i - 1])
      findings.error(child(child(path, "polyline"), i), "is the same point as the one before; remove one");
  return polyline;
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
  } else if ((a - b).norm() <= relative * a.norm()) {
    findings.error(path, "start and end are the same point; a full circle can be given as \"nurbs\"");
  }
  return arc;
}

CaseAxis read_axis(const Json& axis, const std::string& path, const std::filesystem::path& directory,
                   Findings& findings) {
  if (has(axis, "file")) return {read_axis_file(axis, directory, path, findings)};
  if (has(axis, "nurbs")) {
    const auto curve = read_nurbs(axis["nurbs"], child(path, "nurbs"), findings);
    return curve ? CaseAxis{*curve} : CaseAxis{};
  }
  if (has(axis, "polyline")) return {read_polyline(axis, path, findings)};
  if (has(axis, "arc")) return {read_arc(axis, path, findings)};
  return {};
}

CaseSection read_section(const Json& section, const std::filesystem::path& directory, const std::string& path,
                         Findings& findings) {
  if (has(section, "profile")) {
    const Json& profile = section["profile"];
    CaseSection drawn = {.torsion_constant = optional_number(section, "torsion_constant"),
                         .profile = CaseProfile{(directory / text(profile, "file")).lexically_normal(),
                                                text(profile, "in_plane") == "x"}};
    if (has(profile, "file")) check_cad_file(drawn.profile->path, child(path, "profile.file"), findings);
    return drawn;
  }
  if (has(section, "radius")) {
    const double r = number(section, "radius");
    return {.area = std::numbers::pi * r * r,
            .second_moment = std::numbers::pi * std::pow(r, 4) / 4,
            .radius = r,
            .torsion_constant = optional_number(section, "torsion_constant")};
  }
  if (has(section, "from"))
    return {.torsion_constant = optional_number(section, "torsion_constant"), .from_cad = true};
  CaseSection sizes{.area = number(section, "area"),
                    .second_moment = number(section, "second_moment"),
                    .extreme_fibre = optional_number(section, "extreme_fibre"),
                    .torsion_constant = optional_number(section, "torsion_constant")};
  if (has(section, "second_moments")) {
    const std::vector<double> moments = numbers(section, "second_moments");
    if (moments.size() == 2 && section["second_moments"].size() == 2) {
      sizes.second_moments = {moments[0], moments[1]};
      sizes.second_moment = moments[0];
    } else {
      findings.error(child(path, "second_moments"), "expected two: [I_x, I_y]");
    }
    sizes.product = number(section, "product", 0);
  } else if (has(section, "area") && !has(section, "second_moment")) {
    findings.error(path, "\"area\" needs \"second_moment\" or \"second_moments\"");
  }
  return sizes;
}

/// Where the section's y axis points.
Orientation read_orientation(const Json& json) {
  Orientation orientation;
  if (has(json, "up")) orientation = {Orientation::Rule::up, vector(json, "up")};
  if (has(json, "start")) orientation.direction = vector(json, "start");
  if (flag(json, "frenet")) orientation.rule = Orientation::Rule::frenet;
  for (const auto& [s, degrees] : time_table(json, "twist"))
    orientation.twist.emplace_back(s, degrees * std::numbers::pi / 180);
  return orientation;
}

/// Reports what a beam cannot be with torsion.
void check_torsion(const Json& json, const std::string& path, const CaseBeam& beam, Findings& findings) {
  const auto refuse = [&](const std::string& key, const std::string& why) {
    findings.error(child(path, key), why + "; leave one of them out");
  };
  for (const auto& [asks, key] :
       {std::pair{has(json, "orientation"), "orientation"},
        std::pair{beam.section.second_moments.has_value(), "section.second_moments"}})
    if (asks && !beam.torsion) refuse(key, "is for beams with torsion, but \"torsion\" is false");
  if (!beam.torsion) return;
  if (beam.stress_free == StressFree::as_drawn_without_torsion)
    refuse("stress_free", "is \"as-drawn-without-torsion\", but the beam has torsion");
  if (beam.curvature == CurvatureMeasure::spatial)
    refuse("curvature", "\"spatial\" is the papers' measure, but the beam has torsion");
  if (beam.metric == Metric::label) refuse("metric", "\"none\" is a comparison without torsion");
  if (beam.form == Form::virtual_work) refuse("form", "\"virtual-work\" is a comparison without torsion");
}

/// Reports what a beam needs to be longer or shorter than it is drawn when it is free.
void check_free_length(const CaseBeam& beam, Findings& findings) {
  if (!beam.temperature.empty() && !beam.material.thermal_expansion)
    findings.error(child(beam.path, "temperature"),
                   "needs \"thermal_expansion\" in the beam's \"material\"; of steel it is about 1.2e-5 /K");
  if (beam.axial_strain != AxialStrain::pointwise) return;
  for (const auto& [asks, key] : {std::pair{beam.unstressed_length.has_value(), "unstressed_length"},
                                  std::pair{!beam.temperature.empty(), "temperature"}})
    if (asks)
      findings.error(
          child(beam.path, key),
          "is for the axial strain \"ends-and-mean\", but the beam has the papers' \"pointwise\" one; "
          "leave one of them out");
}

std::optional<CaseVelocity> read_velocity(const Json& json) {
  if (json.empty()) return {};
  CaseVelocity velocity;
  velocity.translation = vector(json, "translation", velocity.translation);
  velocity.rotation = vector(json, "rotation", velocity.rotation);
  velocity.about = vector(json, "about", velocity.about);
  velocity.along = number(json, "along", 0);
  return velocity;
}

/// Of the papers' elements (constant weights, no metric, form P) the pointwise strain when omitted.
AxialStrain read_axial_strain(const Json& json, const std::string& path, const CaseBeam& beam,
                              Findings& findings) {
  const bool papers =
      beam.weights == WeightRule::constant || beam.metric == Metric::label || beam.form == Form::virtual_work;
  const AxialStrain strain =
      chosen<AxialStrain>(json, "axial_strain",
                          {{"", papers ? AxialStrain::pointwise : AxialStrain::ends_and_mean},
                           {"pointwise", AxialStrain::pointwise},
                           {"ends-and-mean", AxialStrain::ends_and_mean}});
  if (strain == AxialStrain::ends_and_mean && beam.form == Form::virtual_work)
    findings.error(child(path, "axial_strain"),
                   "is \"ends-and-mean\", but \"form\": \"virtual-work\" is the papers' element, which has "
                   "\"pointwise\"; leave one of them out");
  return strain;
}

}  // namespace

CaseBeam read_beam(const Json& json, const std::string& path, const std::filesystem::path& directory,
                   Findings& findings) {
  CaseBeam beam;
  beam.path = path;
  beam.name = text(json, "name");
  beam.axis = read_axis(part(json, "axis"), child(path, "axis"), directory, findings);
  beam.section = read_section(part(json, "section"), directory, child(path, "section"), findings);
  const Json& material = part(json, "material");
  beam.material = {.density = number(material, "density"),
                   .youngs_modulus = number(material, "youngs_modulus"),
                   .damping = number(material, "damping", 0),
                   .shear_modulus = optional_number(material, "shear_modulus"),
                   .poissons_ratio = optional_number(material, "poissons_ratio"),
                   .thermal_expansion = optional_number(material, "thermal_expansion")};
  const Json& elements = part(json, "elements");
  beam.elements = {.count = optional_integer(elements, "count"),
                   .max_length = optional_number(elements, "max_length"),
                   .per_segment = optional_integer(elements, "per_segment"),
                   .tolerance = optional_number(elements, "tolerance"),
                   .grading = number(elements, "grading", 0)};
  beam.approximation_tolerance = number(json, "approximation_tolerance", beam.approximation_tolerance);
  beam.ring = flag(json, "closed");
  beam.corners = chosen<Corners>(json, "corners",
                                 {{"error", Corners::error},
                                  {"smooth", Corners::smooth},
                                  {"rigid", Corners::rigid},
                                  {"hinge", Corners::hinge}});
  const double default_degrees = beam.corners == Corners::smooth ? 5 : 0;
  beam.smooth_angle = number(json, "smooth_up_to", default_degrees) * std::numbers::pi / 180;
  beam.element = chosen<ElementKind>(
      json, "element", {{"ale-rancf", ElementKind::ale_rancf}, {"ale-ancf", ElementKind::ale_ancf}});
  beam.weights = chosen<WeightRule>(json, "weights",
                                    {{"material", WeightRule::material}, {"constant", WeightRule::constant}});
  beam.merge = chosen<MergeRule>(
      json, "merge",
      {{"default", MergeRule::standard}, {"paper", MergeRule::paper}, {"ones", MergeRule::ones}});
  beam.stress_free = chosen<StressFree>(json, "stress_free",
                                        {{"", StressFree::automatic},
                                         {"as-drawn", StressFree::as_drawn},
                                         {"straight", StressFree::straight},
                                         {"as-drawn-without-torsion", StressFree::as_drawn_without_torsion}});
  beam.curvature = chosen<CurvatureMeasure>(
      json, "curvature", {{"material", CurvatureMeasure::material}, {"spatial", CurvatureMeasure::spatial}});
  beam.metric = chosen<Metric>(json, "metric", {{"reference", Metric::arc_length}, {"none", Metric::label}});
  beam.form =
      chosen<Form>(json, "form", {{"variational", Form::variational}, {"virtual-work", Form::virtual_work}});
  beam.axial_strain = read_axial_strain(json, path, beam, findings);
  beam.torsion = has(json, "torsion") ? flag(json, "torsion")
                                      : has(json, "orientation") || beam.section.second_moments.has_value();
  beam.orientation = read_orientation(part(json, "orientation"));
  const bool may_take_it =
      (beam.stress_free == StressFree::automatic || beam.stress_free == StressFree::as_drawn) &&
      beam.curvature == CurvatureMeasure::material && beam.metric == Metric::arc_length &&
      beam.form == Form::variational && beam.element == ElementKind::ale_rancf &&
      beam.weights == WeightRule::material;
  beam.torsion_by_drawing = !has(json, "torsion") && !beam.torsion && may_take_it;
  check_torsion(json, path, beam, findings);
  beam.unstressed_length = optional_number(json, "unstressed_length");
  if (has(json, "temperature"))
    beam.temperature = json["temperature"].is_array() ? time_table(json, "temperature")
                                                      : TimeTable{{0, number(json, "temperature")}};
  check_free_length(beam, findings);
  beam.velocity = read_velocity(part(part(json, "initial"), "velocity"));
  return beam;
}

}  // namespace nurbeam
