#include "pipelines/study/least_on_sphere.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nurbeam {
namespace {

using Eigen::VectorXd;

/// Counts how often the function is asked for.
struct Counted {
  int calls = 0;
  SphereFunction of(std::function<double(const VectorXd&)> f,
                    std::function<VectorXd(const VectorXd&)> slope) {
    return {[this, f](const VectorXd& u) {
              ++calls;
              return std::optional(f(u));
            },
            [slope](const VectorXd& u) { return std::optional(slope(u)); }};
  }
};

TEST(LeastOnSphere, OfALinearFunctionIsFoundInOneStep) {
  const VectorXd a = (VectorXd(3) << 1, -2, 2).finished();
  Counted counted;
  const auto f =
      counted.of([&](const VectorXd& u) { return 5 + a.dot(u); }, [&](const VectorXd&) { return a; });
  for (const VectorXd& start : {VectorXd(VectorXd::Zero(3)), VectorXd(VectorXd::Ones(3)), VectorXd(a)}) {
    counted.calls = 0;
    const auto place = least_on_sphere(f, 3, start);
    ASSERT_TRUE(place);
    EXPECT_LT((place->u + 3 * a / a.norm()).norm(), 1e-12);
    EXPECT_LE(counted.calls, 2);
  }
}

// f = u' D u / 2 + b' u is least where (D + m) u = -b: m by bisection.
TEST(LeastOnSphere, OfAQuadraticFunctionSatisfiesItsMultiplier) {
  const VectorXd d = (VectorXd(3) << 3, -0.5, 1).finished(), b = (VectorXd(3) << 1, 2, -0.7).finished();
  const double radius = 2.5;
  double low = 0.5 + 1e-9, high = 100;
  const auto at = [&](double m) { return VectorXd(-(b.array() / (d.array() + m)).matrix()); };
  for (int i = 0; i < 200; ++i) {
    const double m = (low + high) / 2;
    (at(m).norm() > radius ? low : high) = m;
  }
  Counted counted;
  const auto f = counted.of([&](const VectorXd& u) { return 0.5 * u.dot(d.cwiseProduct(u)) + b.dot(u); },
                            [&](const VectorXd& u) { return VectorXd(d.cwiseProduct(u) + b); });
  const auto place = least_on_sphere(f, radius, VectorXd::Zero(3));
  ASSERT_TRUE(place);
  EXPECT_LT((place->u - at(low)).norm(), 1e-5);
  EXPECT_LE(counted.calls, 60);
}

// Whole steps jump from one side of the valley to the other for ever (a cycle of the mean value method).
TEST(LeastOnSphere, IsFoundWhereWholeStepsCycle) {
  Counted counted;
  const auto f =
      counted.of([](const VectorXd& u) { return 4 * u[0] * u[0] - u[1]; },
                 [](const VectorXd& u) { return VectorXd((VectorXd(2) << 8 * u[0], -1).finished()); });
  const auto place = least_on_sphere(f, 3, (VectorXd(2) << 1, 1).finished());
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->u[0], 0, 1e-5);
  EXPECT_NEAR(place->u[1], 3, 1e-9);
}

TEST(LeastOnSphere, IsNothingWhereTheFunctionHasNoValue) {
  const SphereFunction none{[](const VectorXd&) { return std::optional<double>(); },
                            [](const VectorXd& u) { return std::optional(u); }};
  EXPECT_FALSE(least_on_sphere(none, 2, VectorXd::Ones(2)));
}

TEST(LeastOnSphere, OfNoRadiusIsTheOrigin) {
  Counted counted;
  const auto f = counted.of([](const VectorXd& u) { return u[0]; },
                            [](const VectorXd& u) { return VectorXd(VectorXd::Unit(u.size(), 0)); });
  EXPECT_EQ(least_on_sphere(f, 0, VectorXd::Zero(2))->u.norm(), 0);
}

}  // namespace
}  // namespace nurbeam
