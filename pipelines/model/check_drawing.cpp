#include "pipelines/model/check_drawing.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

constexpr double degrees = std::numbers::pi / 180, largest_turn = 60 * degrees;

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

}  // namespace

void check_turns(const std::vector<CaseBeam>& beams, const BeamModel& model, const ModelFrame& frame,
                 Findings& findings) {
  for (std::size_t b = 0; b < model.beams.size(); ++b) {
    const Beam& beam = model.beams[b];
    if (!beam.has_torsion()) continue;
    double most = 0, s = 0;
    for (std::size_t i = 1; i < beam.home.size(); ++i) {
      const double s_a = beam.home[i - 1].s, s_b = beam.home[i].s;
      const double turn = turn_between(beam.curve, s_a, s_b);
      if (turn <= most) continue;
      most = turn;
      s = (s_a + s_b) / 2;
    }
    if (most > largest_turn)
      findings.warn(beams[b].path + ".elements",
                    "the axis turns by " + text_of(most / degrees, 3) +
                        " degrees within the element about s = " + text_of(s, 6) + " m, " +
                        text_of(frame.to_world(beam.curve.position(s))) +
                        ": the sections of a beam with torsion are carried along it to few digits; divide it "
                        "so that elements turn by less than 60 degrees");
  }
}

}  // namespace nurbeam
