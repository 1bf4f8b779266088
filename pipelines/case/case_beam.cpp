#include "pipelines/case/case_beam.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "nurbs/number_text.h"
#include "pipelines/case/case_axis.h"
#include "pipelines/case/case_keys.h"
#include "pipelines/case/standard_materials.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

CaseSection pipe(const Json& section, const std::string& path, Findings& findings) {
  const double outer = number(section, "radius"), inner = number(section, "bore", 0);
  if (inner >= outer)
    findings.error(child(path, "bore"), "is " + text_of(inner) + " m, but the radius is " + text_of(outer) +
                                            " m; the inner radius must be less than the outer one");
  return {.area = std::numbers::pi * (outer * outer - inner * inner),
          .second_moment = std::numbers::pi / 4 * (std::pow(outer, 4) - std::pow(inner, 4)),
          .radius = outer,
          .bore = inner > 0 ? std::optional(inner) : std::nullopt,
          .torsion_constant = optional_number(section, "torsion_constant")};
}

// St Venant's constant of a rectangle, by his series.
double torsion_of_rectangle(double a, double b) {
  const double l = std::max(a, b), t = std::min(a, b);
  double sum = 0;
  for (int n = 1; n < 200; n += 2) sum += std::tanh(n * std::numbers::pi * l / (2 * t)) / std::pow(n, 5);
  return l * std::pow(t, 3) / 3 * (1 - 192 * t / (std::pow(std::numbers::pi, 5) * l) * sum);
}

CaseSection rectangle(const Json& section) {
  const std::vector<double> sides = numbers(section, "rectangle");
  if (sides.size() != 2) return {};  // said where the shape was checked
  const double x = sides[0] / 2, y = sides[1] / 2;
  const std::optional<double> given = optional_number(section, "torsion_constant");
  return {.torsion_constant = given ? given : torsion_of_rectangle(sides[0], sides[1]),
          .profile = CaseProfile{.path = "rectangle", .outline = {{-x, -y}, {x, -y}, {x, y}, {-x, y}}}};
}

CaseSection i_section(const Json& section, const std::string& path, Findings& findings) {
  const Json& json = part(section, "i_section");
  const double x = number(json, "width") / 2, y = number(json, "height") / 2;
  const double web = number(json, "web") / 2, inner = y - number(json, "flange");
  // Comparisons with a missing (NaN) size are false: it has been reported.
  if (inner <= 0)
    findings.error(child(path, "flange"), "is " + text_of(number(json, "flange")) +
                                              " m; two flanges must be thinner than the height, " +
                                              text_of(2 * y) + " m");
  if (web >= x)
    findings.error(child(path, "web"),
                   "is " + text_of(2 * web) + " m; must be less than the width, " + text_of(2 * x) + " m");
  return {.torsion_constant = optional_number(section, "torsion_constant"),
          .profile = CaseProfile{.path = "I section",
                                 .outline = {{-x, -y},
                                             {x, -y},
                                             {x, -inner},
                                             {web, -inner},
                                             {web, inner},
                                             {x, inner},
                                             {x, y},
                                             {-x, y},
                                             {-x, inner},
                                             {-web, inner},
                                             {-web, -inner},
                                             {-x, -inner}}}};
}

// Its wires carry together and bend each by itself: n pi r^4/4 with n pi r^2 = A.
CaseSection rope(const Json& section, const std::string& path, Findings& findings) {
  const Json& json = part(section, "rope");
  const double diameter = number(json, "diameter"), area = number(json, "metallic_area");
  const double full = std::numbers::pi * diameter * diameter / 4;
  if (area > full)
    findings.error(child(path, "metallic_area"), "is " + text_of(area) + " m^2, more than the " +
                                                     text_of(full) + " m^2 of a solid rod of that diameter");
  constexpr int usual_wires = 6 * 19;
  const int wires = optional_integer(json, "wires").value_or(usual_wires);
  const double I = area * area / (4 * std::numbers::pi * wires);
  return {.area = area,
          .second_moment = number(json, "second_moment", I),
          .extreme_fibre = std::sqrt(area / (std::numbers::pi * wires)),
          .torsion_constant = optional_number(section, "torsion_constant")};
}

CaseMaterial read_material(const Json& beam, const std::string& path, Findings& findings) {
  static const Json nothing = Json::object();
  const bool by_name = has(beam, "material") && beam["material"].is_string();
  const Json& json = by_name ? nothing : part(beam, "material");
  const std::string name = by_name ? text(beam, "material") : text(json, "name");
  const StandardMaterial* standard = standard_material(name);
  if (!standard && has(beam, "material"))
    for (const auto& [key, what] :
         {std::pair{"density", "mass per volume"}, std::pair{"youngs_modulus", "Young's modulus"}})
      if (!json.contains(key))
        findings.error(path, in_quotes(key) + " is missing (" + what +
                                 "); give it, or the \"name\" of a standard "
                                 "material");
  CaseMaterial material{.density = number(json, "density"),
                        .youngs_modulus = number(json, "youngs_modulus"),
                        .damping = number(json, "damping", 0),
                        .shear_modulus = optional_number(json, "shear_modulus"),
                        .poissons_ratio = optional_number(json, "poissons_ratio"),
                        .thermal_expansion = optional_number(json, "thermal_expansion"),
                        .mass_damping = number(json, "mass_damping", 0),
                        .stiffness_damping = number(json, "stiffness_damping", 0),
                        .name = name};
  if (!standard) return material;
  if (!has(json, "density")) material.density = standard->density;
  if (!has(json, "youngs_modulus")) material.youngs_modulus = standard->youngs_modulus;
  if (!material.shear_modulus && !material.poissons_ratio) material.poissons_ratio = standard->poissons_ratio;
  if (!material.thermal_expansion) material.thermal_expansion = standard->thermal_expansion;
  return material;
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
  if (has(section, "radius")) return pipe(section, path, findings);
  if (has(section, "rectangle")) return rectangle(section);
  if (has(section, "i_section")) return i_section(section, child(path, "i_section"), findings);
  if (has(section, "rope")) return rope(section, child(path, "rope"), findings);
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
  if (beam.form == Form::virtual_work)
    for (const auto& [value, key] : {std::pair{beam.material.mass_damping, "mass_damping"},
                                     std::pair{beam.material.stiffness_damping, "stiffness_damping"}})
      if (value > 0)
        findings.error(child(child(beam.path, "material"), key),
                       "is " + text_of(value) +
                           ", but \"form\": \"virtual-work\" is the papers' element, which has "
                           "\"damping\" alone; leave one of them out");
  if (beam.axial_strain != AxialStrain::pointwise) return;
  for (const auto& [asks, key] : {std::pair{beam.tension != 0, "tension"},
                                  std::pair{beam.unstressed_length.has_value(), "unstressed_length"},
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

/// Others have been reported.
bool is_key_of_beams(const std::string& name) {
  return find_key(find_key(case_keys(), "beams")->shape.items[0], name) != nullptr;
}

/// Reports what a rigid guide takes no more, and what every other beam needs.
void check_guide(const Json& json, const CaseBeam& beam, Findings& findings) {
  if (!beam.rigid) {
    for (const char* key : {"section", "material"})
      if (!json.contains(key))
        findings.error(beam.path, in_quotes(key) + " is missing; a beam needs it unless it is \"rigid\"");
    return;
  }
  static const std::set<std::string> known = {
      "name", "axis", "rigid", "closed", "corners", "smooth_up_to", "approximation_tolerance"};
  for (const auto& [key, value] : json.items())
    if (!known.contains(key) && is_key_of_beams(key))
      findings.error(child(beam.path, key),
                     "is for beams that deform, but \"rigid\" makes this one a guide; "
                     "leave one of them out");
  if (beam.corners == Corners::rigid || beam.corners == Corners::hinge)
    findings.error(child(beam.path, "corners"),
                   "is " + in_quotes(text(json, "corners")) +
                       ", but no body slides over a corner of a rigid guide; use \"smooth\" or \"error\"");
}

}  // namespace

CaseBeam read_beam(const Json& json, const std::string& path, const std::filesystem::path& directory,
                   Findings& findings) {
  CaseBeam beam;
  beam.path = path;
  beam.name = text(json, "name");
  beam.rigid = flag(json, "rigid");
  beam.axis = read_beam_axis(part(json, "axis"), child(path, "axis"), directory, findings);
  beam.section = read_section(part(json, "section"), directory, child(path, "section"), findings);
  beam.material = read_material(json, child(path, "material"), findings);
  const Json& elements = part(json, "elements");
  beam.elements = {.count = optional_integer(elements, "count"),
                   .max_length = optional_number(elements, "max_length"),
                   .per_segment = optional_integer(elements, "per_segment"),
                   .tolerance = optional_number(elements, "tolerance"),
                   .grading = number(elements, "grading", 0)};
  beam.approximation_tolerance = optional_number(json, "approximation_tolerance");
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
  beam.torsion_by_drawing = !has(json, "torsion") && !beam.torsion && !beam.rigid && may_take_it;
  check_torsion(json, path, beam, findings);
  beam.unstressed_length = optional_number(json, "unstressed_length");
  beam.tension = number(json, "tension", 0);
  if (has(json, "temperature"))
    beam.temperature = json["temperature"].is_array() ? time_table(json, "temperature")
                                                      : TimeTable{{0, number(json, "temperature")}};
  check_free_length(beam, findings);
  beam.velocity = read_velocity(part(part(json, "initial"), "velocity"));
  check_guide(json, beam, findings);
  return beam;
}

}  // namespace nurbeam
