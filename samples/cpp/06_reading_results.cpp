// Reads what a run has left: the stored times, and the deformed curve at one of them.
#include <cstdio>

#include "pipelines/case/case_file.h"
#include "pipelines/results/export_results.h"
#include "pipelines/results/results.h"
#include "pipelines/run/run.h"

using namespace nurbeam;

int main(int count, char** arguments) {
  const std::filesystem::path root = count > 1 ? arguments[1] : "samples";
  const CaseFileReport read = read_case_file(root / "statics" / "rollup.json");
  if (!read.value || run_case(*read.value, {.out = "rollup_results", .quiet = true}) != 0) return 1;

  const StoredFrames stored("rollup_results");
  std::printf("%zu stored times\n", stored.times().size());
  const auto [time, curves] = stored_curves("rollup_results", 0, CurveParameter::free);
  const NurbsCurve& curve = curves.at(0).curve;
  const double gap = (curve.point(curve.knots().start()) - curve.point(curve.knots().end())).norm();
  std::printf("%s at %g s: %.6f m long, its ends %.1e m apart\n", curves[0].name.c_str(), time, length(curve),
              gap);
  return gap < 1e-4 * length(curve) ? 0 : 1;  // the cantilever is rolled up to a circle
}
