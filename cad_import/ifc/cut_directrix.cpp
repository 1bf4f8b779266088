#include "cad_import/ifc/cut_directrix.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include "nurbs/number_text.h"
#include "nurbs/split_curve.h"

namespace nurbeam {
namespace {

constexpr double same_parameter = 1e-4;  // of the whole, as files round them

using Measure = std::function<double(const ImportedCurve&)>;

double parameters_of(const ImportedCurve& piece) {
  return piece.curve.knots().end() - piece.curve.knots().start();
}
double length_of(const ImportedCurve& piece) { return length(piece.curve); }
double count_of(const ImportedCurve& piece) {
  return piece.curve.degree() == 1 ? static_cast<double>(piece.curve.knots().breaks().size() - 1) : 1;
}

double total(const std::vector<ImportedCurve>& directrix, const Measure& measure) {
  double sum = 0;
  for (const ImportedCurve& piece : directrix) sum += measure(piece);
  return sum;
}

/// The knot of a piece at this length from its start, by halving.
double knot_at_length(const NurbsCurve& curve, double wanted) {
  double low = curve.knots().start(), high = curve.knots().end();
  constexpr int halvings = 50;
  for (int i = 0; i < halvings; ++i) {
    const double middle = low + (high - low) / 2;
    if (!(middle > low && middle < high)) break;
    (length(split_at(curve, {middle}).front()) < wanted ? low : high) = middle;
  }
  return low + (high - low) / 2;
}

/// Where a share of a piece ends, counted by its parameters or by its length. Arcs of circles have both
/// alike, and other knots inside.
double knot_at(const ImportedCurve& piece, double share, bool by_length) {
  const KnotVector& knots = piece.curve.knots();
  if (piece.entity == "ellipse" && !by_length)
    throw std::runtime_error("it is cut inside an ellipse, which is not read");
  if (!by_length && piece.entity != "circle") return knots.start() + share * (knots.end() - knots.start());
  return knot_at_length(piece.curve, share * length(piece.curve));
}

std::vector<ImportedCurve> between(const std::vector<ImportedCurve>& directrix, double first, double last,
                                   const Measure& measure, bool by_length) {
  const double near = 1e-9 * total(directrix, measure);
  std::vector<ImportedCurve> kept;
  double before = 0;
  for (const ImportedCurve& piece : directrix) {
    const double size = measure(piece), begin = std::max(first - before, 0.0),
                 end = std::min(last - before, size);
    before += size;
    if (!(end - begin > near)) continue;
    ImportedCurve part = piece;
    const bool cut_before = begin > near, cut_behind = end < size - near;
    const double from = cut_before ? knot_at(piece, begin / size, by_length) : 0;
    if (cut_behind) part.curve = split_at(part.curve, {knot_at(piece, end / size, by_length)}).front();
    if (cut_before) part.curve = split_at(part.curve, {from}).back();
    kept.push_back(std::move(part));
  }
  if (kept.empty()) throw std::runtime_error("its StartParam and EndParam leave nothing of its directrix");
  return kept;
}

}  // namespace

CutDirectrix cut_directrix(std::vector<ImportedCurve> directrix, std::optional<double> first,
                           std::optional<double> last) {
  const double parameters = total(directrix, parameters_of), lengths = total(directrix, length_of);
  const double begin = first.value_or(0);
  const auto ends_at = [&](double whole) {
    return begin == 0 && (!last || std::abs(*last - whole) <= same_parameter * whole);
  };
  const auto fits = [&](double whole) {
    return begin >= 0 && begin < whole && last.value_or(whole) <= whole * (1 + same_parameter);
  };
  const bool is_polyline = directrix.size() == 1 && directrix[0].curve.degree() == 1;
  if (ends_at(parameters)) return {std::move(directrix)};
  if (!is_polyline && (ends_at(total(directrix, count_of)) || ends_at(lengths) || ends_at(1)))
    return {std::move(directrix)};
  if (fits(parameters))
    return {between(directrix, begin, last.value_or(parameters), parameters_of, false),
            ends_at(1)
                ? "its EndParam is 1, and cuts it behind the first of its " + text_of(parameters) + " lines"
                : ""};
  if (fits(lengths))
    return {between(directrix, begin, last.value_or(lengths), length_of, true),
            "its StartParam and EndParam are no parameters of its directrix, which runs from 0 to " +
                text_of(parameters) + "; they are taken for lengths along it"};
  throw std::runtime_error("its StartParam " + text_of(begin) + " and EndParam " +
                           (last ? text_of(*last) : "$") +
                           " are neither parameters of its directrix, which runs from 0 to " +
                           text_of(parameters) + ", nor lengths along it, up to " + text_of(lengths));
}

}  // namespace nurbeam
