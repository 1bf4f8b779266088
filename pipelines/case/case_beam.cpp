#include "pipelines/case/case_beam.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "cad_import/files/cad_file_name.h"
#include "nurbs/number_text.h"
#include "pipelines/case/case_axis.h"
#include "pipelines/case/case_keys.h"
#include "pipelines/case/standard_materials.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

// [width, height].
Shape sides() {
  Shape shape = shapes::array(shapes::quantity(Dimension::length, shapes::plausible(1e-9, 1e4)), 2);
  shape.most_items = 2;
  shape.argument_name = "width, height";
  return shape;
}

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
  CaseMaterial material;
  material_fields().read(json, path, material, findings);
  material.name = name;
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
    CaseSection drawn = {
        .torsion_constant = optional_number(section, "torsion_constant"),
        .profile = CaseProfile{.path = (directory / text(profile, "file")).lexically_normal(),
                               .x_in_plane = text(profile, "in_plane") == "x",
                               .curves = {.part = optional_text(profile, "part"),
                                          .layer = optional_text(profile, "layer"),
                                          .colour = optional_text(profile, "colour")}}};
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

/// Reports what a beam cannot be with torsion.
void check_torsion(const Json& json, const std::string& path, const CaseBeam& beam, Findings& findings) {
  const auto refuse = [&](const std::string& key, const std::string& why) {
    findings.error(child(path, key), why + "; leave one of them out");
  };
  for (const auto& [asks, key] :
       {std::pair{has(json, "orientation") && !beam.rigid, "orientation"},
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

/// Reports a law that an element of comparison does not have.
void check_law(const CaseBeam& beam, Findings& findings) {
  const bool papers = beam.metric == Metric::label || beam.form == Form::virtual_work;
  if (papers && beam.material.law && !std::holds_alternative<GreenLaw>(*beam.material.law))
    findings.error(
        child(child(beam.path, "material"), "law"),
        std::string("is not \"green\", but ") +
            (beam.metric == Metric::label ? "\"metric\": \"none\"" : "\"form\": \"virtual-work\"") +
            " is the papers' element, which has that law alone; leave one of them out");
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
  if (beam.material.compression == Compression::buckles)
    findings.error(
        child(child(beam.path, "material"), "compression"),
        "is \"buckles\", which is for the axial strain \"ends-and-mean\", but the beam has the papers' "
        "\"pointwise\" one; leave one of them out");
  for (const auto& [asks, key] : {std::pair{beam.tension != 0, "tension"},
                                  std::pair{beam.unstressed_length.has_value(), "unstressed_length"},
                                  std::pair{!beam.temperature.empty(), "temperature"}})
    if (asks)
      findings.error(
          child(beam.path, key),
          "is for the axial strain \"ends-and-mean\", but the beam has the papers' \"pointwise\" one; "
          "leave one of them out");
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
      "name", "axis", "rigid", "closed", "corners", "smooth_up_to", "approximation_tolerance", "orientation"};
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

Shape section_shape() {
  using namespace shapes;
  const Shape profile =
      object({{"file", any_text(),
               std::string(cad_formats) + " file with an outline and its holes, relative to the case file",
               required},
              {"in_plane", choice({"y", "x"}),
               "the profile's axis that lies in the plane of a planar model; y when omitted"},
              {"part", any_text(), only_part},
              {"layer", any_text(), only_layer},
              {"colour", any_text(), only_colour}});
  const Shape size = quantity(Dimension::length, plausible(1e-9, 1e4));
  const Shape i_section = object({{"width", size, "of the flanges", required},
                                  {"height", size, "from outside to outside", required},
                                  {"flange", size, "thickness of the flanges", required},
                                  {"web", size, "thickness of the web", required}});
  const Shape rope = object(
      {{"diameter", size, "over all", required},
       {"metallic_area", quantity(Dimension::area, plausible(1e-18, 1e8)), "of all wires together", required},
       {"wires", integer({.lower = 1, .upper = 10000}),
        "how many, each of which bends by itself; 114 (6 x 19) when omitted"},
       {"second_moment", quantity(Dimension::second_moment, plausible(1e-36, 1e16)),
        "where it is known better than from the wires"}});
  return object(
      {{"radius", quantity(Dimension::length, plausible(1e-9, 1e4)), "radius of a round section"},
       {"bore", quantity(Dimension::length, not_negative()), "inner radius of a pipe; 0 when omitted", false,
        "radius"},
       {"rectangle", sides(),
        "[width, height] of a rectangle; the height lies in the plane of a planar model, and "
        "along the section's y axis"},
       {"i_section", i_section, "of an I, upright along the section's y axis"},
       {"rope", rope, "wire rope"},
       {"area", quantity(Dimension::area, plausible(1e-18, 1e8)), "cross-section area"},
       {"second_moment", quantity(Dimension::second_moment, plausible(1e-36, 1e16)), "second moment of area",
        false, "area"},
       {"second_moments", array(quantity(Dimension::second_moment, plausible(1e-36, 1e16)), 2),
        "[I_x, I_y] about the section's own axes, of a beam with torsion; y is where the orientation points",
        false, "area"},
       {"product", quantity(Dimension::second_moment), "I_xy, the integral of x y; 0 when omitted", false,
        "second_moments"},
       {"torsion_constant", quantity(Dimension::second_moment, plausible(1e-36, 1e16)),
        "St Venant's; when omitted that of the profile, or I_x + I_y of a round section"},
       {"extreme_fibre", quantity(Dimension::length, plausible(1e-9, 1e4)),
        "largest distance of the section from its axis of bending; without it no stress is given", false,
        "area"},
       {"profile", profile,
        "section drawn in a CAD file; all curves of the file together, or of a part, layer and colour of it"},
       {"bends", choice({"stiff", "flexible"}),
        "bends of a pipe; flexible: its section becomes oval there, so that it bends 1.65/h times as easily, "
        "with 0.9/h^(2/3) times the stress, h = t R/r^2 (ASME B31, EN 13480); stiff when omitted"},
       {"from", choice({"cad"}), "the section of the pipe in the CAD file whose centre line is the axis"}},
      {{{"radius", "rectangle", "i_section", "rope", "area", "profile", "from"}, required},
       {{"second_moment", "second_moments"}, false}});
}

CaseBeam read_beam(const Json& json, const std::string& path, const std::filesystem::path& directory,
                   Findings& findings) {
  CaseBeam beam;
  beam.path = path;
  beam_fields().read(json, path, beam, findings);
  beam.has_orientation = has(json, "orientation");
  beam.axis = read_beam_axis(part(json, "axis"), child(path, "axis"), directory, findings);
  beam.section = read_section(part(json, "section"), directory, child(path, "section"), findings);
  beam.section.flexible_bends = text(part(json, "section"), "bends") == "flexible";
  beam.material = read_material(json, child(path, "material"), findings);
  constexpr double default_smooth_angle = 5 * std::numbers::pi / 180;
  if (beam.corners == Corners::smooth && !has(json, "smooth_up_to")) beam.smooth_angle = default_smooth_angle;
  beam.axial_strain = read_axial_strain(json, path, beam, findings);
  if (!has(json, "torsion"))
    beam.torsion = !beam.rigid && (has(json, "orientation") || beam.section.second_moments.has_value());
  const bool may_take_it =
      (beam.stress_free == StressFree::automatic || beam.stress_free == StressFree::as_drawn) &&
      beam.curvature == CurvatureMeasure::material && beam.metric == Metric::arc_length &&
      beam.form == Form::variational && beam.element == ElementKind::ale_rancf &&
      beam.weights == WeightRule::material;
  beam.torsion_by_drawing = !has(json, "torsion") && !beam.torsion && !beam.rigid && may_take_it;
  check_torsion(json, path, beam, findings);
  check_law(beam, findings);
  check_free_length(beam, findings);
  check_guide(json, beam, findings);
  return beam;
}

}  // namespace nurbeam
