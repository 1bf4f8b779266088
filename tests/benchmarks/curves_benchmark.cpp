// What do the ways of a curve cost: to cubics, to a length, to the nearest place, and back?
#include <benchmark/benchmark.h>

#include "nurbs/arc_length.h"
#include "nurbs/bezier_path.h"
#include "nurbs/closest_point.h"
#include "nurbs/smooth/smooth_nurbs.h"

namespace nurbeam {
namespace {

/// A wavy spline of that degree with single knots.
NurbsCurve wave(int degree, int spans) {
  std::vector<double> knots(degree, 0.0);
  for (int i = 0; i <= spans; ++i) knots.push_back(i);
  knots.insert(knots.end(), degree, spans);
  Eigen::Matrix3Xd points(3, spans + degree);
  for (int i = 0; i < points.cols(); ++i) points.col(i) << i, std::sin(1.3 * i), std::cos(0.7 * i);
  return make_nurbs_curve(KnotVector(degree, knots), points, Eigen::VectorXd::Ones(points.cols()));
}

void to_cubics(benchmark::State& timing) {
  const NurbsCurve curve = wave(static_cast<int>(timing.range(0)), 10);
  for (auto _ : timing) benchmark::DoNotOptimize(BezierPath::from_nurbs(curve, 1e-6));
}
BENCHMARK(to_cubics)->Arg(3)->Arg(5)->Unit(benchmark::kMicrosecond);

void smooth_curve_of_cubics(benchmark::State& timing) {
  const BezierPath path = BezierPath::from_nurbs(wave(3, static_cast<int>(timing.range(0))), 1e-6);
  for (auto _ : timing) benchmark::DoNotOptimize(smooth_nurbs(path, CurveParameter::free, 1e-12));
}
BENCHMARK(smooth_curve_of_cubics)->Arg(10)->Arg(100)->Unit(benchmark::kMicrosecond);

void arc_length_and_back(benchmark::State& timing) {
  const RationalCubic cubic = BezierPath::from_nurbs(wave(3, 4), 1e-6).segments[1];
  const ArcLengthMap map(cubic);
  double u = 0.3;
  for (auto _ : timing) benchmark::DoNotOptimize(u = map.parameter(map.arc_length(u)));
}
BENCHMARK(arc_length_and_back);

void nearest_place(benchmark::State& timing) {
  const BezierPath path = BezierPath::from_nurbs(wave(3, static_cast<int>(timing.range(0))), 1e-6);
  for (auto _ : timing) benchmark::DoNotOptimize(closest_point(path.segments, {5.2, 0.1, 0.4}));
}
BENCHMARK(nearest_place)->Arg(10)->Arg(1000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace nurbeam
