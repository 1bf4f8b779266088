#pragma once
#include <array>

#include "fem/element/fixed_lanes.h"
#include "fem/material/numbers.h"

/// The arithmetic of fem/material/numbers.h for numbers of eight elements, in sources that are compiled for
/// every processor.
namespace nurbeam {

using Lanes8 = ElementLanes;

NURBEAM_WITHIN Lanes8 operator+(const Lanes8& a, const Lanes8& b) {
  return {{a.half[0] + b.half[0], a.half[1] + b.half[1]}};
}
NURBEAM_WITHIN Lanes8 operator-(const Lanes8& a, const Lanes8& b) {
  return {{a.half[0] - b.half[0], a.half[1] - b.half[1]}};
}
NURBEAM_WITHIN Lanes8 operator*(const Lanes8& a, const Lanes8& b) {
  return {{a.half[0] * b.half[0], a.half[1] * b.half[1]}};
}
NURBEAM_WITHIN Lanes8 operator/(const Lanes8& a, const Lanes8& b) {
  return {{a.half[0] / b.half[0], a.half[1] / b.half[1]}};
}
NURBEAM_WITHIN Lanes8 operator+(const Lanes8& a, double b) { return {{a.half[0] + b, a.half[1] + b}}; }
NURBEAM_WITHIN Lanes8 operator-(const Lanes8& a, double b) { return {{a.half[0] - b, a.half[1] - b}}; }
NURBEAM_WITHIN Lanes8 operator/(const Lanes8& a, double b) { return {{a.half[0] / b, a.half[1] / b}}; }
NURBEAM_WITHIN Lanes8 operator+(double a, const Lanes8& b) { return {{a + b.half[0], a + b.half[1]}}; }
NURBEAM_WITHIN Lanes8 operator-(double a, const Lanes8& b) { return {{a - b.half[0], a - b.half[1]}}; }
NURBEAM_WITHIN Lanes8 operator*(double a, const Lanes8& b) { return {{a * b.half[0], a * b.half[1]}}; }
NURBEAM_WITHIN Lanes8 operator/(double a, const Lanes8& b) { return {{a / b.half[0], a / b.half[1]}}; }
NURBEAM_WITHIN Lanes8 operator-(const Lanes8& a) { return {{-a.half[0], -a.half[1]}}; }
NURBEAM_WITHIN void operator+=(Lanes8& a, const Lanes8& b) { a = a + b; }
NURBEAM_WITHIN void operator-=(Lanes8& a, const Lanes8& b) { a = a - b; }
NURBEAM_WITHIN void operator*=(Lanes8& a, const Lanes8& b) { a = a * b; }

NURBEAM_WITHIN Lanes8 square_root(const Lanes8& a) {
  Lanes8 root = a;
  for (auto& half : root.half)
    for (int i = 0; i < 4; ++i) half[i] = __builtin_sqrt(half[i]);
  return root;
}

// The numbers, or 0 where they are not positive.
NURBEAM_WITHIN Lanes8 positive(const Lanes8& a) {
  Lanes8 part;
  for (int i = 0; i < 2; ++i) part.half[i] = a.half[i] > 0 ? a.half[i] : ElementLanes::Half{};
  return part;
}

// 1 where the numbers are zero, else 0.
NURBEAM_WITHIN Lanes8 is_zero(const Lanes8& a) {
  Lanes8 part;
  for (int i = 0; i < 2; ++i)
    part.half[i] = a.half[i] == 0 ? ElementLanes::Half{} + 1. : ElementLanes::Half{};
  return part;
}

NURBEAM_WITHIN double largest(const Lanes8& a) {
  const ElementLanes::Half half = a.half[0] > a.half[1] ? a.half[0] : a.half[1];
  const double x = half[0] > half[1] ? half[0] : half[1], y = half[2] > half[3] ? half[2] : half[3];
  return x > y ? x : y;
}

template <class Function>
Lanes8 each(const Lanes8& a, const Function& f) {
  Lanes8 values;
  for (int i = 0; i < FixedLanes::lanes; ++i) values.set(i, f(a.of(i)));
  return values;
}

}  // namespace nurbeam
