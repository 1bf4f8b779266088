#include "pipelines/model/check_drawing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <variant>

#include "fem/element/rancf_basis.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

constexpr double degrees = std::numbers::pi / 180, largest_turn = 60 * degrees,
                 largest_section_turn = (30 + 1e-6) * degrees;  // with round-off

// By how much the tangent turns between two places, which no corner lies between [rad].
double turn_between(const ReferenceCurve& curve, double s_a, double s_b) {
  constexpr int parts = 12;  // chords of a turn of 60 degrees: 5 degrees each
  double turn = 0;
  Eigen::Vector3d before = curve.tangent(s_a);
  for (int i = 1; i <= parts; ++i) {
    const Eigen::Vector3d t = curve.tangent(s_a + (s_b - s_a) * i / parts, i == parts);
    turn += std::atan2(before.cross(t).norm(), before.dot(t));
    before = t;
  }
  return turn;
}

// By how much sections turn about it there, against sections that are carried along it [rad].
double section_turn_between(const ReferenceCurve& curve, double s_a, double s_b) {
  constexpr int parts = 4;  // of which each turns one way
  double turn = 0;
  for (int i = 0; i < parts; ++i)
    turn += std::abs(curve.section_turn(s_a + (s_b - s_a) * i / parts, s_a + (s_b - s_a) * (i + 1) / parts));
  return turn;
}

// The most that something turns within an element of a beam [rad], and where the middle of that is [m].
struct Turn {
  double angle = 0, s = 0;
};
template <class Between>
Turn greatest_turn(const Beam& beam, const Between& between) {
  Turn most;
  for (std::size_t i = 1; i < beam.home.size(); ++i) {
    const double s_a = beam.home[i - 1].s, s_b = beam.home[i].s, angle = between(beam.curve, s_a, s_b);
    if (angle > most.angle) most = {angle, (s_a + s_b) / 2};
  }
  return most;
}

// The furthest that elements of weights 1 are from the drawing, sampled [m], and where that is [m].
struct Departure {
  double distance = 0, s = 0;
};
Departure greatest_departure(const Beam& beam) {
  constexpr int parts = 8;
  const ReferenceCurve& curve = beam.curve;
  Departure most;
  for (std::size_t i = 1; i < beam.home.size(); ++i) {
    const double s_a = beam.home[i - 1].s, s_b = beam.home[i].s;
    NodalCoordinates ends;
    ends << curve.position(s_a), curve.tangent(s_a), curve.position(s_b), curve.tangent(s_b, true);
    const RationalCubic cubic = to_bezier(ends, Eigen::Vector4d::Ones(), s_b - s_a);
    for (int k = 1; k < parts; ++k) {
      const double u = k / static_cast<double>(parts), s = s_a + u * (s_b - s_a);
      const Eigen::Vector3d apart = cubic.point(u) - curve.position(s), t = curve.tangent(s).normalized();
      const double across = (apart - t * t.dot(apart)).norm();  // what is along it is no distance
      if (across > most.distance) most = {across, s};
    }
  }
  return most;
}

// Whether it hardly matters for bending how sections are turned.
bool bends_alike(const SectionStiffness& section) {
  constexpr double little = 0.05;
  const double difference = std::hypot(section.bending_1 - section.bending_2, 2 * section.bending_product);
  return difference <= little * std::max(section.bending_1, section.bending_2);
}

// Whether a beam resists bending as bars do: cables are damped by other things.
bool is_bar(const Beam& beam) {
  constexpr double most_slender = 3000;  // length over radius of gyration
  const double length = beam.curve.length(), EA = beam.properties.axial_stiffness,
               EI = beam.properties.bending_stiffness;
  return EI * most_slender * most_slender >= EA * length * length;
}

}  // namespace

void check_drawn_sections(const CaseOutput& output, const std::vector<CaseBeam>& beams, Findings& findings) {
  const bool only_guides = std::ranges::all_of(beams, &CaseBeam::rigid);
  for (std::size_t i = 0; i < output.cad_formats.size(); ++i) {
    const std::string &format = output.cad_formats[i], path = "output.cad.formats[" + std::to_string(i) + "]";
    const bool solid = format == "step-solid", lines = format == "step-section-lines";
    if (only_guides && (solid || lines))
      findings.error(path, "is \"" + format +
                               "\", but all beams are rigid guides, which have no sections; use \"step\" for "
                               "the curves");
    for (const CaseBeam& beam : beams)
      if (!beam.rigid && !beam.torsion && (lines || (solid && !beam.section.radius))) {
        findings.error(path,
                       "is \"" + format + "\", but the beam \"" + beam.name +
                           "\" has no torsion, which orients its section; give it \"torsion\": true, or "
                           "use \"step\" for the curve");
        break;
      }
  }
}

void check_source(const CaseOutput& output, const std::vector<CaseBeam>& beams, CadFiles& files,
                  Findings& findings) {
  const std::vector<std::string>& formats = output.cad_formats;
  const auto source = std::find(formats.begin(), formats.end(), "step-source");
  if (source == formats.end()) return;
  const auto* const first = std::get_if<AxisFile>(&beams.front().axis.source);
  for (const CaseBeam& beam : beams) {
    const auto* const axis = std::get_if<AxisFile>(&beam.axis.source);
    if (first && axis && axis->path == first->path &&
        files.read(axis->path, findings).format == CadFormat::step)
      continue;
    findings.error("output.cad.formats[" + std::to_string(source - formats.begin()) + "]",
                   "is \"step-source\", but the axis of the beam \"" + beam.name + "\" is not from " +
                       (first && axis && axis != first ? "the same" : "a") +
                       " STEP file; use \"step\" for the curve alone");
    return;
  }
}

void check_softness(const std::vector<CaseBeam>& beams, const BeamModel& model, Findings& findings) {
  constexpr double greatest_strain = 0.1, greatest_gravity = 5000;
  constexpr int digits = 4;
  if (model.gravity.norm() > greatest_gravity) return;  // the wrong number is that one (check_sizes)
  for (std::size_t b = 0; b < model.beams.size(); ++b) {
    const Beam& beam = model.beams[b];
    if (beam.rigid) continue;
    const double strain = beam.properties.mass_per_length * model.gravity.norm() * beam.curve.length() /
                          beam.properties.axial_stiffness;
    if (strain > greatest_strain)
      findings.warn(beams[b].path + ".material",
                    "is so soft that the weight of the beam strains it by " + text_of(strain, digits) +
                        " (density times gravity times length over \"youngs_modulus\", " +
                        text_of(beams[b].material.youngs_modulus) +
                        " Pa); it must be small (is the unit right? \"210 GPa\" is 210e9)");
  }
}

void check_polynomial_elements(const std::vector<CaseBeam>& beams, const BeamModel& model,
                               const ModelFrame& frame, Findings& findings) {
  constexpr double noticed = 1e-6;  // of the length
  for (std::size_t b = 0; b < model.beams.size(); ++b) {
    const Beam& beam = model.beams[b];
    if (beam.rigid || beam.weights != WeightRule::ones) continue;
    const Departure most = greatest_departure(beam);
    if (most.distance > noticed * beam.curve.length())
      findings.warn(beams[b].path + ".element",
                    "is \"ale-ancf\", whose polynomial elements depart from the drawing by up to " +
                        text_of(most.distance, 3) + " m, at s = " + text_of(most.s, 6) + " m, " +
                        text_of(frame.to_world(beam.curve.position(most.s))) +
                        ": take \"ale-rancf\", which has the drawn shape, or more elements");
  }
}

void mention_damping(const std::vector<CaseBeam>& beams, const BeamModel& model, Findings& findings) {
  if (model.dimension != 3) return;
  for (std::size_t b = 0; b < model.beams.size(); ++b) {
    const Beam& beam = model.beams[b];
    if (beam.rigid || beam.has_torsion() || !(beam.properties.damping > 0) || !is_bar(beam)) continue;
    findings.add(
        Severity::note, beams[b].path + ".material",
        "a beam without torsion is damped in how much it bends, not in where to: vibrations across the "
        "plane in which it is bent go on; with \"torsion\": true of the beam they decay too");
  }
}

void check_turns(const std::vector<CaseBeam>& beams, const BeamModel& model, const ModelFrame& frame,
                 Findings& findings) {
  for (std::size_t b = 0; b < model.beams.size(); ++b) {
    const Beam& beam = model.beams[b];
    if (!beam.has_torsion()) continue;
    const auto warn = [&](const Turn& turn, const std::string& what, const std::string& why) {
      findings.warn(beams[b].path + ".elements",
                    what + " by " + text_of(turn.angle / degrees, 3) +
                        " degrees within the element about s = " + text_of(turn.s, 6) + " m, " +
                        text_of(frame.to_world(beam.curve.position(turn.s))) + ": " + why);
    };
    if (const Turn turn = greatest_turn(beam, turn_between); turn.angle > largest_turn)
      warn(
          turn, "the axis turns",
          "the sections of a beam with torsion are carried along it to few digits; divide it so that elements "
          "turn by less than 60 degrees");
    if (bends_alike(*beam.properties.sections)) continue;
    if (const Turn turn = greatest_turn(beam, section_turn_between); turn.angle > largest_section_turn)
      warn(
          turn, "the section is drawn with a twist, and turns",
          "an element of a section that bends more easily one way is then too stiff, by some percent from 45 "
          "degrees on; divide it so that sections turn by less than 30 degrees in each, into some " +
              std::to_string(static_cast<int>(
                  std::ceil(turn.angle / largest_section_turn * static_cast<double>(beam.home.size() - 1)))) +
              " elements where they are equal");
  }
}

}  // namespace nurbeam
