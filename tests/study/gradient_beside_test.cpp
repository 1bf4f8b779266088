// Derivatives over transfers and starts beside the run's own motion, against those of neighbours that do the
// same by themselves.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/study/followed_variant.h"

namespace nurbeam {
namespace {

using test::followed;
using test::FollowedVariant;
using test::plane_slide;
using test::slide_study;
using test::StudyOfCase;

/// Lets neighbours do by themselves what can be found beside the run.
class Alone final : public RunFollower {
 public:
  Alone(RunFollower& of, int& transfers) : of_(of), transfers_(transfers) {}

  void begins(const MeshedState& drawn) override { of_.begins(drawn); }
  void rests(const MeshedState& at) override { of_.rests(at); }
  void steps(const FollowedStep& step) override { of_.steps(step); }
  void changes(const MeshedState& at, const std::function<bool(MeshedState&)>& change) override {
    of_.changes(at, change);
  }
  void transfers(const MeshedState& at, const FollowedTransfer&,
                 const std::function<bool(MeshedState&)>& change) override {
    ++transfers_;
    of_.changes(at, change);
  }
  void starts(const MeshedState& at, const FollowedStart&,
              const std::function<bool(MeshedState&)>& change) override {
    of_.changes(at, change);
  }
  void happens(const RunEvent& event) override { of_.happens(event); }
  void records(const MeshedState& at, bool of_the_moment) override { of_.records(at, of_the_moment); }

 private:
  RunFollower& of_;
  int& transfers_;
};

void expect_what_neighbours_do(const StudyOfCase& of, int fewest, double accuracy) {
  int transfers = 0;
  const FollowedVariant beside = followed(of), alone = followed(of, [&](RunFollower&follower) {
                                                 return std::make_unique<Alone>(follower, transfers);
                                               });
  EXPECT_GE(transfers, fewest);
  ASSERT_EQ(beside.gradient.size(), alone.gradient.size());
  for (std::size_t i = 0; i < alone.gradient.size(); ++i) {
    const auto as_vector = [](const std::vector<double>& x) {
      return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<long>(x.size())));
    };
    const Eigen::VectorXd a = as_vector(alone.gradient[i]), b = as_vector(beside.gradient[i]);
    for (Eigen::Index k = 0; k < a.size(); ++k)
      EXPECT_NEAR(b[k], a[k], accuracy * std::abs(a[k]) + 1e-3 * accuracy * a.cwiseAbs().maxCoeff())
          << "quantity " << i << " by variable " << k;
  }
}

const std::string slide_quantities = R"json("quantities": [{"name": "s", "value": "at(end, slider.s)"},
    {"name": "v", "value": "max(slider.speed)"}, {"name": "z", "value": "at(end, slider.z)"}],
    "plan": {"grid": 2})json";

TEST(GradientBeside, IsWhatNeighboursDoInThePlane) {
  const StudyOfCase of(plane_slide + R"json("analysis": {"type": "dynamic", "end_time": 0.4, "step": "1 ms"},
    "output": {"every": 0.1}})json",
                       slide_study + slide_quantities);
  expect_what_neighbours_do(of, 2, 1e-5);
}

// Over knots, where the bodies are points for a while; friction would be no derivative, damping is one.
TEST(GradientBeside, IsWhatNeighboursDoOverKnotsWithDampingAndTwoBodies) {
  const StudyOfCase of(R"json({"nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{"name": "beam",
      "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 0.4, 1, 1, 1, 1], "weights": [1, 1.1, 0.9, 1.05, 1],
                         "control_points": [[0, 0, 1], [0.8, 0, 0.3], [1.7, 0, 0.15], [2.9, 0, 0.2], [3.6, 0, 0.7]]}},
      "section": {"radius": "14 mm"},
      "material": {"density": 1900, "youngs_modulus": "6 GPa", "damping": 1e-5},
      "elements": {"count": 14}}],
    "bodies": [{"name": "slider", "mass": 0.7}, {"name": "b", "mass": 1.9}],
    "sliding_joints": [{"body": "slider", "beam": "beam", "at": {"length": 0.45}, "speed": 2},
                       {"body": "b", "beam": "beam", "at": {"length": 1.52}, "speed": 2.5}],
    "supports": [{"beam": "beam", "at": "start", "type": "pinned"}, {"beam": "beam", "at": "end", "type": "clamped"}],
    "analysis": {"type": "dynamic", "end_time": 0.3, "step": "1 ms"}, "output": {"every": 0.1}})json",
                       R"json("variables": [
      {"name": "z2", "control_point": {"beam": "beam", "index": 2, "axis": "z"}, "range": [0, 0.3]},
      {"name": "w1", "weight": {"beam": "beam", "index": 1}, "range": [0.9, 1.3]},
      {"name": "mass", "path": "bodies[1].mass", "range": [1, 2]}],)json" +
                           slide_quantities);
  expect_what_neighbours_do(of, 4, 1e-5);
}

// Of a narrow range the differences are lost in round-off.
TEST(GradientBeside, IsWhatNeighboursDoInSpace) {
  const StudyOfCase of(R"json({"nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{"name": "beam",
      "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 1, 1, 1, 1], "weights": [1, 0.9, 1.1, 1],
                         "control_points": [[0, 0, 0], [1, 0.3, -0.4], [2, 0.2, -0.7], [3, -0.4, -1.2]]}},
      "section": {"radius": "20 mm"}, "material": {"density": 2700, "youngs_modulus": "2 GPa"},
      "torsion": false, "elements": {"count": 8}}],
    "bodies": [{"name": "slider", "mass": 1.2}],
    "sliding_joints": [{"body": "slider", "beam": "beam", "at": {"length": 0.9}, "speed": 1}],
    "supports": [{"beam": "beam", "at": "start", "type": "clamped"},
                 {"beam": "beam", "at": "end", "type": "pinned"}],
    "analysis": {"type": "dynamic", "end_time": 0.4, "step": "1 ms"}, "output": {"every": 0.1}})json",
                       R"json("variables": [
      {"name": "y2", "control_point": {"beam": "beam", "index": 2, "axis": "y"}, "range": [-2, 2.4]},
      {"name": "w1", "weight": {"beam": "beam", "index": 1}, "range": [0.6, 1.2]},
      {"name": "place", "path": "sliding_joints[0].at.length", "range": [0.8, 1], "nominal": 0.9}],)json" +
                           slide_quantities);
  expect_what_neighbours_do(of, 2, 1e-5);
}

TEST(GradientBeside, IsWhatNeighboursDoOnARailWithTorsion) {
  for (const char* section : {R"json({"radius": "16 mm"})json",
                              R"json({"area": 6.4e-4, "second_moments": [8.5e-8, 1.4e-8],
                                      "torsion_constant": 4.2e-8})json"})
    expect_what_neighbours_do(StudyOfCase(test::rail_case(section), test::rail_study), 3, 1e-5);
}

}  // namespace
}  // namespace nurbeam
