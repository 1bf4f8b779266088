#include "pipelines/model/pipe_bends.h"

#include <algorithm>
#include <cmath>

#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

// A segment of a curve: by how much it turns [rad], and its mean radius [m].
struct SegmentBend {
  double turn, radius;
};
SegmentBend bend_of(const ReferenceCurve& curve, int j) {
  constexpr int parts = 64;
  double turn = 0;
  for (int i = 0; i < parts; ++i) {
    const Eigen::Matrix<double, 3, 6> r = curve.segment(j).derivatives((i + 0.5) / parts);
    const Eigen::Vector3d r_u = r.col(1), r_uu = r.col(2);
    turn += r_u.cross(r_uu).norm() / r_u.squaredNorm() / parts;
  }
  return {turn, (curve.breaks()[j + 1] - curve.breaks()[j]) / turn};
}

}  // namespace

double Elbow::flexibility() const { return std::max(1.0, 1.65 / characteristic); }
double Elbow::stress_factor() const { return std::max(1.0, 0.9 / std::pow(characteristic, 2. / 3)); }

std::vector<Elbow> elbows(const Section& section, const ReferenceCurve& curve) {
  constexpr double least_turn = 0.02;   // a rounded corner of the drawing is no bend [rad]
  constexpr double least_radius = 1.5;  // of the pipe's own: in a tighter bend its inside would fold
  std::vector<Elbow> found;
  if (!section.radius || !section.bore || curve.straight()) return found;
  const double wall = *section.radius - *section.bore, mean = (*section.radius + *section.bore) / 2;
  for (int j = 0; j < curve.segment_count(); ++j) {
    const SegmentBend bend = bend_of(curve, j);
    if (bend.turn < least_turn) continue;
    if (bend.radius < least_radius * mean) continue;
    const Elbow elbow{j, bend.radius, (curve.breaks()[j] + curve.breaks()[j + 1]) / 2,
                      wall * bend.radius / (mean * mean)};
    if (elbow.flexibility() > 1) found.push_back(elbow);
  }
  return found;
}

std::vector<PipeBend> pipe_bends(const CaseBeam& from, const Beam& beam, const ModelFrame& frame,
                                 Findings& findings) {
  constexpr double noticed = 1;  // h
  constexpr int digits = 4;
  if (from.section.flexible_bends && !beam.section.bore)
    findings.error(from.path + ".section.bends",
                   "is \"flexible\", which is of pipes, but the section has no \"bore\"; give it, or leave "
                   "\"bends\" out");
  const std::vector<Elbow> all = elbows(beam.section, beam.curve);
  if (all.empty()) return {};
  if (!from.section.flexible_bends) {
    const Elbow& most = *std::ranges::min_element(all, {}, &Elbow::characteristic);
    if (most.characteristic < noticed)
      findings.warn(from.path + ".section",
                    "is a pipe that becomes oval in its bends: at s = " + text_of(most.s, digits) + " m, " +
                        text_of(frame.to_world(beam.curve.position(most.s)), 6) + ", with a radius of " +
                        text_of(most.radius, digits) + " m, it bends " + text_of(most.flexibility(), digits) +
                        " times as easily as the beam (1.65/h, h = t "
                        "R/r^2 = " +
                        text_of(most.characteristic, digits) + ")" +
                        (most.stress_factor() > 1 ? ", with " + text_of(most.stress_factor(), digits) +
                                                        " times the stress of bending (0.9/h^(2/3))"
                                                  : std::string()) +
                        "; \"bends\": \"flexible\" of the section takes account of that");
    return {};
  }
  std::vector<PipeBend> bends;
  for (const Elbow& elbow : all)
    bends.push_back(
        {elbow.segment, beam.properties.with_softer_bending(elbow.flexibility()), elbow.stress_factor()});
  return bends;
}

}  // namespace nurbeam
