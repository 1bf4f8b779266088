#pragma once
#include <cmath>
#include <vector>

/// Reference numbers of the examples of the papers, computed by two programs that share no formulation (one
/// with a node that moves with the body, one with a fixed mesh and the body's own coordinate) and confirmed
/// by a third program's element; their difference is the error that stands with each. Spatial curvature
/// unless said, g = 9.81 m/s^2.
namespace nurbeam::references {

/// A body that slides, at one time; NAN where there is no number.
struct Place {
  double time;          ///< [s]
  double x, y, s;       ///< of the body [m]
  double end_y = NAN;   ///< of the beam's free end [m]
  double length = NAN;  ///< of the beam [m]
};

/// Example 1 of Ding & Ouyang, to 1e-5 m.
inline std::vector<Place> falling_beam() {
  return {{0.2, 0.131866, -0.061405, 0.147474, -0.196947, 1.001414},
          {0.4, 0.213265, -0.366831, 0.438555, -0.892306, 1.006318},
          {0.5, 0.110137, -0.663964, 0.712489, -0.802103, 1.005065}};
}
/// When the body leaves it [s], to 5e-5 s.
inline constexpr double falling_beam_leaves = 0.71356;

/// Example 2, to 2e-5 m (s to 1.5e-4 m).
inline std::vector<Place> suspended_beam() {
  return {{0.3, 0.225178, -0.036238, 0.226584, NAN, 1.007698},
          {0.6, 0.510228, -0.097381, 0.506148, NAN, 1.023557},
          {1.0, 0.837282, -0.041253, 0.834099, NAN, 1.008379}};
}

/// Example 2 as a cable without bending stiffness that is drawn at 0.02 EA, to 1e-6 m: linear elements that
/// move with the body on both sides of it, 400 each, by Runge and Kutta's method; from 50 on differences fall
/// with the square of the number.
inline std::vector<Place> suspended_cable() {
  return {{0.3, 0.189880, -0.017259, 0.190348},
          {0.6, 0.403736, -0.075725, 0.405855},
          {0.8, 0.579514, -0.059524, 0.578481},
          {1.0, 0.734935, -0.064788, 0.729757}};
}

/// Example 3, to 2e-5 m as drawn, to 1e-4 m straight.
inline std::vector<Place> semicircle(bool straight) {
  if (straight) return {{0.5, -1.138563, -1.349098, 1.602512}, {1.0, 1.159817, -1.634351, 4.407983}};
  return {{0.5, -1.194665, -1.354761, 1.580274},
          {1.0, 1.152992, -1.625596, 4.408070},
          {1.5, 1.869061, -0.314888, 5.942009}};
}

/// The curved pendulum of the subdivision paper, to 4e-6 m.
struct Swing {
  double time;        ///< [s]
  double AB, fall;    ///< distance of its ends; y_B(t) - y_B(0) [m]
  double length = 0;  ///< of the beam [m]; 0 where there is no number
};
inline std::vector<Swing> pendulum() {
  return {{0.2, 0.423720923, -0.220576957, 0.526796576},
          {0.4, 0.505662695, -0.745614747, 0.523011159},
          {0.8, 0.445215937, -0.065294728, 0.531502082}};
}
/// With the material curvature.
inline std::vector<Swing> pendulum_with_material_curvature() {
  return {
      {0.2, 0.423709655, -0.220890605}, {0.4, 0.505894707, -0.745921325}, {0.8, 0.441658296, -0.066021437}};
}

/// The pendulum by CalculiX 2.20 (tests/calculix/pendulum.py): elements B32R, expanded to solids and so
/// flexible in shear, step 1 ms; with 16 of them, with 8 for what the mesh leaves, and with half the step.
inline std::vector<Swing> pendulum_by_calculix() {
  return {{0.1, 0.476158, -0.049021}, {0.2, 0.423437, -0.220639}, {0.3, 0.527220, -0.641109},
          {0.4, 0.505992, -0.746603}, {0.5, 0.500224, -0.641037}, {0.6, 0.489526, -0.395011},
          {0.7, 0.522223, -0.149586}, {0.8, 0.435352, -0.067503}, {0.9, 0.412278, -0.192627},
          {1, 0.521474, -0.542032}};
}
inline std::vector<Swing> pendulum_by_calculix_with_8() {
  return {{0.1, 0.476147, -0.049009}, {0.2, 0.423428, -0.220626}, {0.3, 0.527242, -0.641154},
          {0.4, 0.505944, -0.746507}, {0.5, 0.500360, -0.641002}, {0.6, 0.490058, -0.394560},
          {0.7, 0.522288, -0.147523}, {0.8, 0.437002, -0.067835}, {0.9, 0.411958, -0.192358},
          {1, 0.522621, -0.542732}};
}

inline std::vector<Swing> pendulum_by_calculix_with_half_the_step() {
  return {{0.1, 0.476159, -0.049022}, {0.2, 0.423429, -0.220635}, {0.3, 0.527220, -0.641114},
          {0.4, 0.505992, -0.746596}, {0.5, 0.500224, -0.641029}, {0.6, 0.489651, -0.394958},
          {0.7, 0.522171, -0.149401}, {0.8, 0.435514, -0.067535}, {0.9, 0.412187, -0.192616},
          {1, 0.521520, -0.542073}};
}
/// Half as high, with the same bending stiffness and mass: 16 elements, 1 ms.
inline std::vector<Swing> thin_pendulum_by_calculix() {
  return {{0.1, 0.475483, -0.049186}, {0.2, 0.422847, -0.222070}, {0.3, 0.521227, -0.644518},
          {0.4, 0.499368, -0.731123}, {0.5, 0.477878, -0.615130}, {0.6, 0.503359, -0.359116},
          {0.7, 0.504851, -0.117294}, {0.8, 0.430274, -0.076024}, {0.9, 0.427184, -0.216667},
          {1, 0.529722, -0.599298}};
}

}  // namespace nurbeam::references
