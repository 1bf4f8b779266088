// The commonest CAD input there is: a pipe that is bent in space.

#include <gtest/gtest.h>

#include <numbers>

#include "cad_import/import_curves.h"
#include "tests/end_to_end/case_run.h"
#include "tests/support/places.h"
#include "tests/support/straight_frame.h"

namespace nurbeam::test {
namespace {

std::filesystem::path pipe_file() { return test::source_directory() / "tests/cases/pipe_solid.step"; }

// The frame program on the axis of the drawing, nu = 0.3.
double sag_of_frame(int elements) {
  const ImportReport report = import_curves(pipe_file());
  const auto axis = std::find_if(report.curves.begin(), report.curves.end(),
                                 [](const ImportedCurve& curve) { return curve.is_centre_line(); });
  const double E = 210e9, density = 7850, r = axis->pipe_radius, bore = axis->bore_radius;
  const double A = std::numbers::pi * (r * r - bore * bore), I = A * (r * r + bore * bore) / 4;
  nurbeam::testing::StraightFrame frame{E * A, E * I, E / 2.6 * 2 * I, {}};
  for (int i = 0; i <= elements; ++i) {
    const KnotVector& knots = axis->curve.knots();
    frame.nodes.push_back(axis->curve.point(knots.start() + (knots.end() - knots.start()) * i / elements));
  }
  return frame.sag({0, 0, -9.81 * density * A});
}

TEST(BentPipe, SagsByAFrameOfStraightElementsAsItIsSaidTo) {
  const double fine = sag_of_frame(240);
  EXPECT_NEAR(fine, 0.58e-3, 0.005e-3);
  EXPECT_NEAR(sag_of_frame(120), fine, 5e-3 * fine);
}

// Clamped at both ends under its weight.
TEST(BentPipe, SagsAsAPipeWithTorsionDoesWhenNothingIsSaid) {
  const CaseRun run = run_file(pipe_file().parent_path() / "d_pipe_default.json");
  EXPECT_EQ(run.code, 0) << run.messages;
  const double sag = sag_of_frame(240);
  EXPECT_NEAR(run.last("pipe.displacement.max [m]"), sag, 0.02 * sag);
  const double weight = run.last("reaction.pipe.start.fz [N]") + run.last("reaction.pipe.end.fz [N]");
  EXPECT_GT(weight, 500);
  EXPECT_NEAR(run.last("reaction.pipe.start.fx [N]") + run.last("reaction.pipe.end.fx [N]"), 0,
              1e-8 * weight);
}

}  // namespace
}  // namespace nurbeam::test
