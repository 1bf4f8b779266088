// Beams and risers of published experiments and comparisons of programs.

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "fem/system/observables.h"
#include "nurbs/number_text.h"
#include "pipelines/verification/noted.h"
#include "pipelines/verification/rod_models.h"
#include "pipelines/verification/verify.h"
#include "pipelines/verification/verify_oracles.h"

namespace nurbeam {

namespace {

using namespace verification;
using Eigen::Vector3d;
using std::numbers::pi;

/// A bar of the Princeton experiment under its weight at the tip [N], at an angle from its stiff side, and
/// the tip with the section's first axis by shooting.
struct PrincetonLoad {
  double force, degrees;
  Vector3d tip, d1;
};

/// The bar of Dowell & Traybar (1975) with the numbers of Bauchau et al. (2016): 508 x 12.3777 x 3.2024 mm of
/// aluminium 7075, E = 71.7 GPa, nu = 0.31; the torsion constant is Saint-Venant's series.
VerifyResult princeton() {
  const Rod bar{2842069.4426160, 2.4288718041122, 36.28551939540042, 0, 3.1035479832842};
  const double length = 0.508;
  const std::vector<PrincetonLoad> loads{
      {4.448, 0, {0.507966123388, 0, 0.005356136935}, {-0.015815063253, 0, 0.999874934066}},
      {4.448, 90, {0.500741207202, 0.078075300956, 0}, {0, 0, 1}},
      {4.448,
       45,
       {0.504253735836, 0.056050373987, 0.003962732099},
       {-0.010679102355, -0.007607462383, 0.999914037950}},
      {8.896,
       45,
       {0.493612967748, 0.109032748025, 0.008883900805},
       {-0.018554207879, -0.029047656209, 0.999405810989}},
      {13.345,
       45,
       {0.477643372164, 0.156576311259, 0.015334704736},
       {-0.021802347461, -0.060760968010, 0.997914205937}},
      {13.345, 90, {0.457600703868, 0.200679674057, 0}, {0, 0, 1}}};
  VerifyResult result;
  constexpr int elements = 32;
  const std::string source = "Kirchhoff rod, shooting";
  for (const PrincetonLoad& load : loads) {
    const double angle = load.degrees * pi / 180;
    const Vector3d force = load.force * Vector3d(0, std::sin(angle), std::cos(angle));
    const Rest rest(clamped(straight_rod(length), bar, elements).force(0, length, force));
    const std::string under = ", " + text_of(load.force) + " N at " + text_of(load.degrees) + " degrees";
    result.add("tip to the thin side [m]" + under, load.tip.y(), source, rest.tip().y(), 1e-7);
    result.add("tip to the wide side [m]" + under, load.tip.z(), source, rest.tip().z(), 1e-7);
    result.add("turn of the tip's section [rad]" + under, 0, source, (rest.axis() - load.d1).norm(), 1e-6);
  }
  return result;
}

/// The flexible jumper of Lowe & Langley (2006) at rest in water: 170 m of 165 kg/m and 0.396 m between two
/// hinges, EA = 500 MN, EI = 120.8 kN m^2, straight when free.
VerifyResult jumper() {
  constexpr double length = 170, diameter = 0.396, g = 9.807, water = 1000, mass = 165;
  const Vector3d top(100, 50, 0);
  const double chord = top.norm(),
               half = root([&](double a) { return chord / length - std::sin(a) / a; }, 1, 3),
               radius = length / (2 * half), along = std::atan2(top.y(), top.x());
  const Vector3d centre = top / 2 + radius * std::cos(half) * Vector3d(-std::sin(along), std::cos(along), 0);
  ModelBuilder builder(2);
  const int pipe = builder.add_beam(
      ReferenceCurve(arc_cubics(centre, radius, along - pi / 2 - half, along - pi / 2 + half, 2), 2)
          .straightened(),
      BeamProperties(500e6, 120.8e3, mass), {80});
  const double weight = g * (mass - water * pi / 4 * diameter * diameter);
  builder.pin(pipe, 0).pin(pipe, length).add(LineLoad{pipe, {0, -weight, 0}});
  const Rest rest(builder);
  const auto pull = [&](int support) {
    return Vector3d(reaction(rest.system, rest.state, rest.state.lambda, support).force / 1e3);
  };
  VerifyResult result;
  const std::string source = "Lowe & Langley 2006";
  constexpr double digits = 0.006;  // kN
  result.add("horizontal force [kN]", 11.40, source, std::abs(pull(0).x()), digits);
  result.add("vertical force at the top [kN]", 45.71, source, std::abs(pull(1).y()), digits);
  result.add("vertical force at the bottom [kN]", 24.04, source, std::abs(pull(0).y()), digits);
  return result;
}

}  // namespace

std::vector<VerifyProblem> experiment_problems() {
  return {{"experiment-princeton", "material, Green, as drawn, torsion", princeton},
          {"experiment-jumper", "material, Green, straight", jumper}};
}

}  // namespace nurbeam
