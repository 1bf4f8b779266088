#include "solver/algebra/lowest_frequencies.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/algebra/eigenpairs.h"

namespace nurbeam {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

// The lowest squared frequencies by the inverse of K + shift M. The larger the shift beside them, the more
// digits are lost.
std::optional<SquaredFrequencies> lowest_by_shift(const Matrix& kkt, const Matrix& mass_kkt, int n, int count,
                                                  double shift, const std::function<void()>& between) {
  const Matrix M = mass_kkt.topLeftCorner(n, n);
  // The constraints must be added once, and both matrices have them.
  Matrix shifted = kkt;
  Matrix mass_alone = mass_kkt;
  for (int column = 0; column < mass_alone.cols(); ++column)
    for (Matrix::InnerIterator entry(mass_alone, column); entry; ++entry)
      if (entry.row() >= n || column >= n) entry.valueRef() = 0;
  shifted += shift * mass_alone;
  std::optional<Eigenpairs> found = largest_eigenpairs(shift * M, shifted, count, between);
  if (!found) return std::nullopt;
  constexpr double accuracy = 1e-14;  // relative, for an eigenvalue near 1
  SquaredFrequencies result{shift * (found->values.cwiseInverse().array() - 1).matrix(), found->vectors,
                            accuracy * shift};
  for (Eigen::Index i = 0; i < result.values.size(); ++i) {
    Vector x = result.shapes.col(i) / std::sqrt(result.shapes.col(i).dot(M * result.shapes.col(i)));
    Eigen::Index largest = 0;
    x.cwiseAbs().maxCoeff(&largest);
    result.shapes.col(i) = x[largest] < 0 ? Vector(-x) : x;
  }
  return result;
}

}  // namespace

std::optional<SquaredFrequencies> lowest_frequencies(const Matrix& kkt, const Matrix& mass_kkt, int n,
                                                     int count, const std::function<void()>& between) {
  double largest = 0;
  for (int i = 0; i < n; ++i)
    if (mass_kkt.coeff(i, i) > 0) largest = std::max(largest, kkt.coeff(i, i) / mass_kkt.coeff(i, i));
  double shift = largest > 0 ? 1e-12 * largest : 1;
  constexpr int most_attempts = 12;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    const std::optional<SquaredFrequencies> found = lowest_by_shift(kkt, mass_kkt, n, count, shift, between);
    if (!found) {
      shift *= 1e3;  // K + shift M was singular to the last digit
      continue;
    }
    const double last = found->values.size() > 0 ? found->values[found->values.size() - 1] : 0;
    const bool moves_freely = !(last > 1e-6 * shift);  // all are rigid motions
    if (moves_freely && shift <= 1e-12 * largest) return found;
    if (shift > 1e-3 * last && shift < 0.2 * last) return found;
    shift = moves_freely ? shift / 1e4 : 1e-2 * last;
  }
  return std::nullopt;
}

double round_off(const SquaredFrequencies& found, Eigen::Index i, const Matrix& K) {
  const Vector size = found.shapes.col(i).cwiseAbs();
  return std::numeric_limits<double>::epsilon() * size.dot(Matrix(K.cwiseAbs()) * size);
}

std::vector<bool> rigid_motions(const SquaredFrequencies& found, const std::vector<double>& round_off) {
  constexpr double may_be = 100, is = 2;
  const auto count = static_cast<Eigen::Index>(round_off.size());
  // Shapes of equal frequency mix, and with them their round-off.
  double largest = 0;
  std::vector<bool> rigid;
  for (Eigen::Index i = 0; i < count; ++i) {
    rigid.push_back(std::abs(found.values[i]) <= std::max(may_be * round_off[i], found.resolution));
    if (rigid.back()) largest = std::max(largest, round_off[i]);
  }
  for (Eigen::Index i = 0; i < count; ++i)
    rigid[i] = rigid[i] && std::abs(found.values[i]) <= std::max(is * largest, found.resolution);
  return rigid;
}

}  // namespace nurbeam
