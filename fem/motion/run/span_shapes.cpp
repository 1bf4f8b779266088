#include "fem/motion/run/span_shapes.h"

#include <algorithm>
#include <cmath>

#include "fem/element/lane_arithmetic.h"

namespace nurbeam {

namespace {

NURBEAM_WITHIN Lanes8 magnitude(const Lanes8& a) { return positive(a) + positive(-a); }
NURBEAM_WITHIN Lanes8 larger(const Lanes8& a, const Lanes8& b) {
  Lanes8 both;
  for (int i = 0; i < 2; ++i) both.half[i] = a.half[i] > b.half[i] ? a.half[i] : b.half[i];
  return both;
}
NURBEAM_WITHIN double sum(const Lanes8& a) {
  const ElementLanes::Half half = a.half[0] + a.half[1];
  return (half[0] + half[1]) + (half[2] + half[3]);
}

// The mean of |r_s|^2 and the curvatures at both ends of the cubic in s through the nodal values of a span.
template <class T>
struct Shape {
  T squared_stretch, curvature[2];
};
template <class T>
NURBEAM_WITHIN Shape<T> shape_of(const T& dd, const T& da, const T& db, const T& aa, const T& ab, const T& bb,
                                 const T& length) {
  const T squared_stretch = (36. * dd - 6. * (da + db) + 4. * (aa + bb) - 2. * ab) / 30.;
  const T start = 36. * dd + 16. * aa + 4. * bb - 48. * da - 24. * db + 16. * ab,
          end = 36. * dd + 4. * aa + 16. * bb - 24. * da - 48. * db + 16. * ab;
  return {squared_stretch, {square_root(positive(start)) / length, square_root(positive(end)) / length}};
}

template <std::size_t n>
NURBEAM_WITHIN Lanes8 gathered(const double* from, const std::array<int, n>& first, int k) {
  Lanes8 numbers;
  for (std::size_t i = 0; i < n; ++i) numbers.set(static_cast<int>(i), from[first[i] + k]);
  return numbers;
}

}  // namespace

double near_place(const Beam& beam, double s) {
  const double apart = beam.curve.length() / 4096;
  return std::clamp(std::round(s / apart) * apart, beam.curve.start(), beam.curve.end());
}

SpanShapes::SpanShapes(const Beam& beam, const Mesh& mesh, int number, const State& state) {
  const int first = mesh.first_span[number], count = mesh.first_span[number + 1] - first;
  spans_.resize((count + lanes - 1) / lanes);
  for (int i = 0; i < static_cast<int>(spans_.size()) * lanes; ++i) {
    const MeshSpan& span = mesh.spans[first + std::min(i, count - 1)];
    const MeshNode &a = mesh.node_a(span), &b = mesh.node_b(span);
    Eight& of = spans_[i / lanes];
    of.place[0][i % lanes] = a.r;
    of.place[1][i % lanes] = b.r;
    of.slope[0][i % lanes] = a.slope_right;
    of.slope[1][i % lanes] = b.slope_left;
    draw(beam, span.start(state.q), span.end(state.q), i);
    if (i >= count) of.counted.set(i % lanes, 0);
    if (i < count && (span.place_a >= 0 || span.place_b >= 0)) moving_.push_back({&span, i, -1, -1});
  }
}

void SpanShapes::draw(const Beam& beam, double s_a, double s_b, int number) {
  const double length = s_b - s_a;
  const Eigen::Vector3d a = beam.curve.tangent(s_a), b = beam.curve.tangent(s_b, true),
                        d = (beam.curve.position(s_b) - beam.curve.position(s_a)) / length;
  const Shape<double> drawn =
      shape_of<double>(d.dot(d), d.dot(a), d.dot(b), a.dot(a), a.dot(b), b.dot(b), length);
  Eight& of = spans_[number / lanes];
  const int lane = number % lanes;
  of.length.set(lane, length);
  of.counted.set(lane, length);
  of.strain.set(lane, (drawn.squared_stretch - 1) / 2);
  for (const int end : {0, 1}) of.curvature[end].set(lane, drawn.curvature[end]);
}

void SpanShapes::move(const Beam& beam, Moving& moving, const State& state) {
  const double s_a = moving.span->start(state.q), s_b = moving.span->end(state.q);
  const double near_a = near_place(beam, s_a), near_b = near_place(beam, s_b);
  if ((near_a != moving.s_a || near_b != moving.s_b) && near_a < near_b) {
    draw(beam, near_a, near_b, moving.number);
    moving.s_a = near_a;
    moving.s_b = near_b;
  }
  Eight& of = spans_[moving.number / lanes];
  of.length.set(moving.number % lanes, s_b - s_a);
  of.counted.set(moving.number % lanes, s_b - s_a);
}

template <int D>
NURBEAM_FOR_EVERY_PROCESSOR ShapeExtremes SpanShapes::extremes(const Beam& beam, const State& state,
                                                               double radius) {
  for (Moving& each : moving_) move(beam, each, state);
  const double* q = state.q.data();
  Lanes8 zero;
  zero.set_all(0);
  Lanes8 tension = zero, compression = zero, bending = zero, stress = zero, strains = zero, bendings = zero;
  for (const Eight& of : spans_) {
    Lanes8 dd = zero, da = zero, db = zero, aa = zero, ab = zero, bb = zero;
    for (int k = 0; k < D; ++k) {
      const Lanes8 a = gathered(q, of.slope[0], k), b = gathered(q, of.slope[1], k),
                   d = (gathered(q, of.place[1], k) - gathered(q, of.place[0], k)) / of.length;
      dd += d * d;
      da += d * a;
      db += d * b;
      aa += a * a;
      ab += a * b;
      bb += b * b;
    }
    const Shape<Lanes8> shape = shape_of<Lanes8>(dd, da, db, aa, ab, bb, of.length);
    const Lanes8 strain = 0.5 * (shape.squared_stretch - 1.) - of.strain,
                 start = magnitude(shape.curvature[0] - of.curvature[0]),
                 end = magnitude(shape.curvature[1] - of.curvature[1]), bent = larger(start, end);
    tension = larger(tension, strain);
    compression = larger(compression, -strain);
    bending = larger(bending, bent);
    stress = larger(stress, magnitude(strain) + radius * bent);
    strains += strain * strain * of.counted;
    bendings += 0.5 * (start * start + end * end) * of.counted;
  }
  return {largest(tension), largest(compression), largest(bending),
          largest(stress),  sum(strains),         sum(bendings)};
}

template ShapeExtremes SpanShapes::extremes<2>(const Beam& beam, const State& state, double radius);
template ShapeExtremes SpanShapes::extremes<3>(const Beam& beam, const State& state, double radius);

}  // namespace nurbeam
