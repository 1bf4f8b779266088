#include "pipelines/model/beam_section.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "nurbs/number_text.h"
#include "pipelines/model/curve_choice.h"
#include "pipelines/section/stress_places.h"
#include "pipelines/section/torsion_constant.h"

namespace nurbeam {

namespace {

constexpr double alike = 1e-3;  ///< of the greater principal second moment

bool bends_alike(const SectionProfile& profile) {
  return profile.principal_1() - profile.principal_2() <= alike * profile.principal_1();
}

// In space a beam without torsion has one bending stiffness for all directions.
void check_isotropy(const std::string& where, const SectionProfile& profile, Findings& findings) {
  const double most = profile.principal_1(), least = profile.principal_2();
  if (!bends_alike(profile))
    findings.error(
        where,
        "the profile's principal second moments are " + text_of(most) + " and " + text_of(least) +
            " m^4; in space a beam without torsion bends alike in all directions, and they may differ by " +
            text_of(alike * most) +
            " m^4: give the beam \"torsion\": true, draw a section that is alike in both, or give "
            "\"area\" and \"second_moment\"");
}

// The greatest value of `distance` over the outline.
template <class Distance>
double farthest(const SectionProfile& profile, Distance distance) {
  constexpr int samples = 200;  // of one cubic: exact at its ends, to 1e-5 between them
  double greatest = 0;
  for (const Loop& loop : profile.loops)
    for (const RationalCubic& cubic : loop)
      for (int i = 0; i <= samples; ++i)
        greatest = std::max(greatest, distance(cubic.point(static_cast<double>(i) / samples)));
  return greatest;
}

// The sides of a polygon, as if from a file.
std::vector<ImportedCurve> sides_of(const std::vector<Eigen::Vector2d>& corners) {
  std::vector<ImportedCurve> sides;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, 2);
    points.col(0).head<2>() = corners[i];
    points.col(1).head<2>() = corners[(i + 1) % corners.size()];
    sides.push_back(
        {.entity = "line",
         .curve = make_nurbs_curve(KnotVector(1, {0, 0, 1, 1}), points, Eigen::Vector2d::Ones())});
  }
  return sides;
}

// Those of the file that the case chooses; none where an error says why.
std::vector<ImportedCurve> drawn_curves(const CaseProfile& source, const std::string& where, CadFiles& files,
                                        Findings& findings) {
  const ImportReport& report = files.read(source.path, findings);
  if (!report.ok()) return {};
  const ChosenCurves chosen = chosen_curves(source.curves, report);
  if (!chosen.error.empty()) findings.error(where + "." + chosen.key, chosen.error);
  std::vector<ImportedCurve> curves;
  for (const int i : chosen.indices) curves.push_back(report.curves[i]);
  return curves;
}

// Its JSON path: there may be numbers instead.
std::string place_of_profile(const CaseBeam& beam) {
  return beam.path + (beam.section.profile->outline.empty() ? ".section.profile" : ".section");
}

}  // namespace

std::optional<BeamSection> beam_section(const CaseBeam& beam, int dimension, CadFiles& files,
                                        Findings& findings) {
  if (!beam.section.profile) return BeamSection{beam.section};
  const CaseProfile& source = *beam.section.profile;
  const bool by_numbers = !source.outline.empty();
  const std::string where = place_of_profile(beam);
  const auto curves = by_numbers ? sides_of(source.outline) : drawn_curves(source, where, files, findings);
  if (curves.empty()) return {};
  ProfileReport drawn = section_profile(curves, findings.where(where) + ": " + source.path.string());
  if (!drawn.value && !by_numbers)
    drawn.diagnostics.back().message += what_chooses(source.curves, files.read(source.path, findings));
  findings.append(drawn.diagnostics);
  if (!drawn.value) return {};
  const SectionProfile& profile = *drawn.value;
  CaseSection section{.area = profile.area, .second_moment = profile.second_x};
  if (beam.torsion || (dimension == 3 && beam.torsion_by_drawing && !bends_alike(profile))) {
    section.second_moments = {profile.second_x, profile.second_y};
    section.product = profile.product;
    section.torsion_constant = beam.section.torsion_constant;
  } else if (dimension == 3) {
    check_isotropy(where, profile, findings);
    section.extreme_fibre = farthest(profile, [](const Eigen::Vector3d& p) { return p.norm(); });
  } else {
    const bool x_in_plane = beam.section.profile->x_in_plane;
    if (x_in_plane) section.second_moment = profile.second_y;
    section.extreme_fibre =
        farthest(profile, [&](const Eigen::Vector3d& p) { return std::abs(x_in_plane ? p.x() : p.y()); });
    if (std::abs(profile.product) > 1e-6 * profile.principal_1())
      findings.warn(where,
                    "the principal axes of the profile are turned by " +
                        text_of(profile.principal_angle() * 180 / std::numbers::pi) +
                        " degrees: it would bend out of the plane; the planar model holds it in its plane");
  }
  return BeamSection{section, profile};
}

namespace {

double shear_modulus(const CaseBeam& beam, Findings& findings) {
  const CaseMaterial& material = beam.material;
  if (material.shear_modulus) return *material.shear_modulus;
  constexpr double usual_ratio = 0.3;
  if (!material.poissons_ratio)
    findings.add(Severity::note, beam.path + ".material",
                 "has neither \"shear_modulus\" nor \"poissons_ratio\": a ratio of " + text_of(usual_ratio) +
                     " is taken for torsion");
  return material.youngs_modulus / (2 * (1 + material.poissons_ratio.value_or(usual_ratio)));
}

// Nothing where it is not known. `found` is that of the profile, where there is one.
std::optional<double> constant_of(const CaseSection& sizes, const std::optional<TorsionReport>& found) {
  if (sizes.torsion_constant) return sizes.torsion_constant;
  if (found) return found->status == TorsionStatus::no_mesh ? std::nullopt : std::optional(found->value);
  if (!sizes.second_moments) return 2 * sizes.second_moment;
  return std::nullopt;
}

std::optional<SectionStresses> stresses_of(const BeamSection& section, double torsion_constant,
                                           const std::optional<TorsionReport>& found) {
  const CaseSection& sizes = section.section;
  if (section.profile)
    return SectionStresses(sizes.area, {section.profile->second_x, section.profile->second_y},
                           section.profile->product, stress_places(*section.profile, *found));
  if (sizes.second_moments || !(sizes.radius || sizes.extreme_fibre)) return {};
  return SectionStresses::round(sizes.area, sizes.second_moment, torsion_constant,
                                sizes.radius ? *sizes.radius : *sizes.extreme_fibre);
}

// What the drawn section does that the element does not know.
void check_warping(const std::string& where, const SectionProfile& profile, const TorsionReport& found,
                   double stiffness_ratio, double length, Findings& findings) {
  constexpr int digits = 3;
  constexpr double allowed_offset = 0.01;  // of the radius of gyration
  const double gyration = std::sqrt((profile.second_x + profile.second_y) / profile.area);
  const Eigen::Vector2d& centre = found.shear_centre;
  if (centre.norm() > allowed_offset * gyration)
    findings.warn(where,
                  "has its shear centre at (" + text_of(centre.x(), digits) + ", " +
                      text_of(centre.y(), digits) +
                      ") m from its centroid; the beam takes the two for one: where forces act through "
                      "the centroid the twist that they give is missing; add it as a moment");
  constexpr double allowed_reach = 0.05;  // of the length
  const double reach = std::sqrt(stiffness_ratio * found.warping_constant / found.value);
  if (reach > allowed_reach * length)
    findings.warn(where,
                  "is open and thin-walled, or the beam short: warping, which is not modelled, would "
                  "stiffen it against twist within about " +
                      text_of(reach, digits) + " m of clamps, of a length of " + text_of(length, digits) +
                      " m; a closed section does not, or give a \"torsion_constant\" that counts it");
}

}  // namespace

std::optional<TorsionSection> torsion_section(const CaseBeam& beam, double length, const BeamSection& section,
                                              Findings& findings) {
  const CaseSection& sizes = section.section;
  std::optional<TorsionReport> found;
  if (section.profile) found = torsion_constant(section.profile->loops);
  const std::optional<double> J = constant_of(sizes, found);
  if (!J) {
    findings.error(
        beam.path + ".section",
        "needs its \"torsion_constant\"" + std::string(section.profile ? ": it was not found from the profile"
                                                                       : " beside \"second_moments\""));
    return {};
  }
  if (!sizes.second_moments && !sizes.radius && !sizes.torsion_constant)
    findings.add(
        Severity::note, beam.path + ".section",
        "is taken for a round one in torsion, with a torsion constant of twice \"second_moment\": give "
        "\"torsion_constant\" where it is not");
  if (sizes.second_moments && sizes.extreme_fibre && !section.profile)
    findings.warn(
        beam.path + ".section.extreme_fibre",
        "has no place on a section with \"second_moments\", of which it gives no stress: that needs a "
        "\"profile\"");
  const double E = beam.material.youngs_modulus, G = shear_modulus(beam, findings);
  const auto [I_x, I_y] = sizes.second_moments.value_or(std::array{sizes.second_moment, sizes.second_moment});
  if (!(I_x * I_y > sizes.product * sizes.product)) {
    findings.error(beam.path + ".section", "no section has a product of " + text_of(sizes.product) +
                                               " m^4 with second moments of " + text_of(I_x) + " and " +
                                               text_of(I_y) + " m^4");
    return {};
  }
  if (found && found->status != TorsionStatus::no_mesh)
    check_warping(place_of_profile(beam), *section.profile, *found, E / G, length, findings);
  return TorsionSection{
      {E * I_x, E * I_y, 0 - E * sizes.product, G * *J, beam.material.density * (I_x + I_y)},
      stresses_of(section, *J, found)};
}

}  // namespace nurbeam
