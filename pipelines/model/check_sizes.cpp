#include "pipelines/model/check_sizes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

constexpr int told_digits = 4;
constexpr double thousand = 1e3;

std::string in_metres(double value) { return text_of(value, told_digits) + " m"; }

// The first of the parts of a value that can be meant; the last one where none can.
template <class IsPlausible>
double probable(double value, std::initializer_list<double> divisors, const IsPlausible& is_plausible) {
  double part = value;
  for (const double divisor : divisors) {
    part = value / divisor;
    if (is_plausible(part)) break;
  }
  return part;
}

// The normal of the plane in which all beams are drawn, or nearly, in the world; nothing where they are in
// none, or on one line.
std::optional<Eigen::Vector3d> normal_of_drawing(const BeamModel& model, const ModelFrame& frame) {
  constexpr double flat = 0.4, straight = 1e-3;  // of the drawing's height; of its length
  constexpr int parts = 3;
  std::vector<Eigen::Vector3d> points;
  for (const Beam& beam : model.beams)
    for (int j = 0; j < beam.curve.segment_count(); ++j)
      for (int i = 0; i <= parts; ++i)
        points.push_back(
            frame.to_world(beam.curve.position(beam.curve.arc_length(j, i / static_cast<double>(parts)))));
  if (points.empty()) return std::nullopt;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) middle += p / static_cast<double>(points.size());
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) moments += (p - middle) * (p - middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(moments);
  const Eigen::Vector3d sizes = axes.eigenvalues().cwiseMax(0).cwiseSqrt();
  if (sizes[0] > flat * sizes[1] || sizes[1] < straight * sizes[2]) return std::nullopt;
  return axes.eigenvectors().col(0);
}

// Gravity up, or across a drawing that stands upright.
void check_direction_of_gravity(const ResolvedCase& resolved, const BeamModel& model, const ModelFrame& frame,
                                Findings& findings) {
  constexpr double along = 0.95, upright = 0.3;  // cosines
  const Eigen::Vector3d& g = resolved.gravity;
  if (g.norm() == 0) return;
  const std::string is = "is [" + text_of(g.x(), told_digits) + ", " + text_of(g.y(), told_digits) + ", " +
                         text_of(g.z(), told_digits) + "], ",
                    usual = "; that of the earth, with z upwards, is [0, 0, -9.81]";
  if (g.z() > along * g.norm())
    findings.warn("gravity", is + "which pulls upwards along z" + usual);
  else if (const auto normal = normal_of_drawing(model, frame);
           normal && std::abs(normal->dot(g)) > along * g.norm() && std::abs(normal->z()) < upright)
    findings.warn("gravity", is + "across the upright plane in which all beams are drawn" + usual);
}

void check_gravity(const ResolvedCase& resolved, Findings& findings) {
  constexpr double greatest = 5000;  // twice that of the strongest centrifuges for models of structures
  const Eigen::Vector3d& g = resolved.gravity;
  if (g.norm() <= greatest) return;
  const Eigen::Vector3d meant = g / thousand;
  findings.warn("gravity", "is " + text_of(g.norm(), told_digits) + " m/s^2, " +
                               text_of(g.norm() / 9.81, told_digits) +
                               " times that of the earth; probably [" + text_of(meant.x(), told_digits) +
                               ", " + text_of(meant.y(), told_digits) + ", " +
                               text_of(meant.z(), told_digits) + "] is meant: 9810 mm/s^2 are 9.81 m/s^2");
}

// No material carries sound faster than diamond does, at 18 km/s.
void check_material(const CaseBeam& from, Findings& findings) {
  constexpr double fastest = 25e3, lightest_solid = 20;  // [m/s], [kg/m^3]
  const double E = from.material.youngs_modulus, density = from.material.density;
  if (!(std::sqrt(E / density) > fastest)) return;
  const std::string found = "sound would travel at " +
                            text_of(std::sqrt(E / density) / thousand, told_digits) +
                            " km/s in it, faster than in any material; ";
  if (density < lightest_solid) {
    const double meant = density * (density < 1e-3 ? 1e12 : thousand);
    findings.warn(from.path + ".material.density", "is " + text_of(density) + " kg/m^3: " + found +
                                                       "probably " + text_of(meant, told_digits) +
                                                       " is meant: 7.85 g/cm^3 are 7850 kg/m^3");
  } else {
    const double meant =
        probable(E, {1e3, 1e6, 1e9}, [&](double part) { return std::sqrt(part / density) <= fastest; });
    findings.warn(from.path + ".material.youngs_modulus", "is " + text_of(E) + " Pa: " + found + "probably " +
                                                              text_of(meant, told_digits) +
                                                              " is meant: \"210 GPa\" is 210e9");
  }
}

// The lesser extent of a section along its own axes [m].
double thickness_of(const SectionOutline& outline) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& p : outline.front()) box.extend(p);
  return box.sizes().minCoeff();
}

// What a size of the section probably was, which this part of it makes plausible; a wire below half a
// millimetre hardly.
std::string meant_size(const CaseBeam& from, double part) {
  constexpr double finest = 5e-4;
  if (part / thousand < finest) return "; give it a longer axis or a thinner section";
  if (!from.section.radius)
    return "; probably its sizes are in mm: " + in_metres(part / thousand) + " (is the unit right?)";
  const double radius = *from.section.radius;
  return "; probably a \"radius\" of \"" + text_of(radius, told_digits) +
         " mm\" is meant: 6 is 6 metres (is the unit right?)";
}

// Warns of a thick section of a short beam; returns whether it has.
bool is_too_thick(const CaseBeam& from, const Beam& beam, double thick, Findings& findings) {
  constexpr double least_slender = 2, stubby = 5, huge = 1;  // of the thickness; [m]
  const double length = beam.curve.length();
  if (!(length < least_slender * thick || (length < stubby * thick && thick > huge))) return false;
  findings.warn(from.path + ".section", "is " + in_metres(thick) + " thick, of a beam " + in_metres(length) +
                                            " long: it is no beam below " +
                                            text_of(thick > huge ? stubby : least_slender, 1) +
                                            " times its thickness" + meant_size(from, thick));
  return true;
}

// The tightest bend of a curve: its radius, infinite for a straight one, and its place [m]; and by how much
// the curve turns where it is tighter than a limit [rad].
struct TightBend {
  double radius, s, turn;
};
TightBend tightest_bend(const ReferenceCurve& curve, double limit) {
  constexpr int parts = 16;
  double greatest = 0, at = 0, turn = 0;
  for (int j = 0; j < curve.segment_count(); ++j)
    for (int i = 0; i < parts; ++i) {
      const double u = (i + 0.5) / parts;
      const Eigen::Matrix<double, 3, 6> r = curve.segment(j).derivatives(u);
      const Eigen::Vector3d r_u = r.col(1), r_uu = r.col(2);
      const double rate = r_u.cross(r_uu).norm() / r_u.squaredNorm(), curvature = rate / r_u.norm();
      if (curvature * limit > 1) turn += rate / parts;
      if (curvature > greatest) {
        greatest = curvature;
        at = curve.arc_length(j, u);
      }
    }
  return {1 / greatest, at, turn};
}

void check_bend(const CaseBeam& from, const Beam& beam, const ModelFrame& frame, double thick,
                Findings& findings) {
  constexpr double tightest = 0.55;    // of the half thickness over the radius: short elbows have 0.5
  constexpr double least_turn = 0.35;  // a rounded corner of the drawing is no bend [rad]
  const TightBend bend = tightest_bend(beam.curve, thick / 2 / tightest);
  const auto is_plausible = [&](double half) { return half <= tightest * bend.radius; };
  if (bend.turn < least_turn) return;
  const double half = probable(thick / 2, {2, 10, 1000}, is_plausible);
  const std::string meant = from.section.radius
                                ? "probably a \"radius\" of " + in_metres(half) + " is meant" +
                                      (half == thick / 4 ? ", half of the diameter" : "")
                                : "probably it is " + in_metres(2 * half) + " thick";
  findings.warn(from.path + ".section", "is " + in_metres(thick) + " thick in a bend with a radius of " +
                                            in_metres(bend.radius) + " at s = " + in_metres(bend.s) + ", " +
                                            text_of(frame.to_world(beam.curve.position(bend.s)), 6) +
                                            ": its inside would fold; " + meant + " (is the unit right?)");
}

double greatest_factor(const TimeTable& table) {
  double greatest = table.empty() ? 1 : 0;
  for (const auto& [time, factor] : table) greatest = std::max(greatest, std::abs(factor));
  return greatest;
}

void check_load(const CaseLoad& load, const Beam& beam, Findings& findings) {
  constexpr double greatest_strain = 1, small = 0.01;
  const bool projected = load.kind == CaseLoad::Kind::force_per_projected_length,
             per_length = projected || load.kind == CaseLoad::Kind::force_per_length;
  if (beam.rigid || (load.kind != CaseLoad::Kind::force && !per_length)) return;
  const double EA = beam.properties.axial_stiffness, length = per_length ? beam.curve.length() : 1,
               force = load.value.norm() * length * greatest_factor(load.time);
  if (!(force > greatest_strain * EA)) return;
  const double part = probable(force, {1e3, 1e6, 1e9}, [&](double f) { return f <= small * EA; }) / force;
  const std::string unit = per_length ? " N/m" : " N";
  findings.warn(load.path + (projected    ? ".force_per_projected_length"
                             : per_length ? ".force_per_length"
                                          : ".force"),
                "is " + text_of(load.value.norm(), told_digits) + unit + " on the beam \"" + beam.name +
                    "\", which " + text_of(EA, told_digits) + " N stretch to twice its length; probably " +
                    text_of(load.value.norm() * part, told_digits) + unit + " are meant (\"1 kN\" is 1000)");
}

}  // namespace

void check_sizes(const ResolvedCase& resolved, const BeamModel& model, const ModelFrame& frame,
                 const std::vector<BeamSource>& sources, Findings& findings) {
  check_gravity(resolved, findings);
  check_direction_of_gravity(resolved, model, frame, findings);
  for (std::size_t b = 0; b < model.beams.size(); ++b) {
    const Beam& beam = model.beams[b];
    const CaseBeam& from = resolved.beams[b];
    if (beam.rigid) continue;
    const double thick = thickness_of(sources[b].outline);
    check_material(from, findings);
    if (!is_too_thick(from, beam, thick, findings)) check_bend(from, beam, frame, thick, findings);
  }
  for (const CaseLoad& load : resolved.loads)
    for (std::size_t b = 0; b < model.beams.size(); ++b)
      if (model.beams[b].name == load.beam) check_load(load, model.beams[b], findings);
}

}  // namespace nurbeam
