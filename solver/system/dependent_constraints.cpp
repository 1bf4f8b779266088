#include "solver/system/dependent_constraints.h"

#include <Eigen/SVD>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "solver/system/tangent_matrix.h"

namespace nurbeam {

namespace {

struct Entry {
  int coordinate;
  double value;
};

// The rows of G, each of unit length.
std::vector<std::vector<Entry>> unit_rows(const SecondOrderSystem& system, const State& state) {
  Eigen::SparseMatrix<double> kkt = tangent_matrix(system, state, {});
  const int n = system.coordinate_count();
  std::vector<std::vector<Entry>> rows(system.constraint_count());
  for (int column = 0; column < n; ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(kkt, column); entry; ++entry)
      if (entry.row() >= n && entry.value() != 0) rows[entry.row() - n].push_back({column, entry.value()});
  for (std::vector<Entry>& row : rows) {
    double square = 0;
    for (const Entry& entry : row) square += entry.value * entry.value;
    for (Entry& entry : row) entry.value /= std::sqrt(square);  // an empty row stays
  }
  return rows;
}

// Sets of rows that are linked by common coordinates.
std::vector<std::vector<int>> linked(const std::vector<std::vector<Entry>>& rows) {
  std::vector<int> first(rows.size());
  std::iota(first.begin(), first.end(), 0);
  const auto root = [&](int row) {
    while (first[row] != row) row = first[row] = first[first[row]];
    return row;
  };
  std::map<int, int> row_of_coordinate;
  for (int row = 0; row < static_cast<int>(rows.size()); ++row)
    for (const Entry& entry : rows[row]) {
      const auto [found, added] = row_of_coordinate.emplace(entry.coordinate, row);
      if (!added) first[root(row)] = root(found->second);
    }
  std::map<int, std::vector<int>> sets;
  for (int row = 0; row < static_cast<int>(rows.size()); ++row) sets[root(row)].push_back(row);
  std::vector<std::vector<int>> all;
  for (auto& [of, set] : sets) all.push_back(std::move(set));
  return all;
}

// The rows of a set that are part of a sum of zero.
std::vector<int> dependent(const std::vector<std::vector<Entry>>& rows, const std::vector<int>& set) {
  constexpr double nothing = 1e-9;
  std::map<int, int> columns;
  for (const int row : set)
    for (const Entry& entry : rows[row]) columns.emplace(entry.coordinate, static_cast<int>(columns.size()));
  Eigen::MatrixXd G =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(set.size()), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < set.size(); ++i)
    for (const Entry& entry : rows[set[i]])
      G(static_cast<Eigen::Index>(i), columns.at(entry.coordinate)) = entry.value;
  if (columns.empty()) return set;  // the rows fix nothing
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(G, Eigen::ComputeFullU | Eigen::ComputeThinV);
  svd.setThreshold(nothing);
  const Eigen::MatrixXd factors = svd.matrixU().rightCols(G.rows() - svd.rank());
  std::vector<int> found;
  for (std::size_t i = 0; i < set.size(); ++i)
    if (factors.row(static_cast<Eigen::Index>(i)).norm() > nothing) found.push_back(set[i]);
  return found;
}

}  // namespace

std::vector<DependentConstraints> dependent_constraints(const SecondOrderSystem& system, const State& state) {
  const std::vector<std::vector<Entry>> rows = unit_rows(system, state);
  std::vector<DependentConstraints> all;
  for (const std::vector<int>& set : linked(rows)) {
    std::vector<int> found = dependent(rows, set);
    if (found.empty()) continue;
    std::set<int> coordinates;
    for (const int row : found)
      for (const Entry& entry : rows[row]) coordinates.insert(entry.coordinate);
    all.push_back({std::move(found), {coordinates.begin(), coordinates.end()}});
  }
  return all;
}

}  // namespace nurbeam
