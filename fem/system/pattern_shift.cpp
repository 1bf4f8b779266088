#include "fem/system/pattern_shift.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "fem/system/coupling.h"

namespace nurbeam {

namespace {

using Dofs = std::span<const int>;

template <class Is>
bool any_dof(Dofs dofs, const Is& is) {
  return std::any_of(
      dofs.begin(), dofs.end(), [&](int dof) { return dof >= 0 && is(dof); });
}

// Whether is(now, old) holds for all pairs of unknowns; -1 may be paired with -1 alone.
template <class Is>
bool all_dofs(Dofs now, Dofs old, const Is& is) {
  if (now.size() != old.size()) return false;
  bool all = true;
  // Arithmetic without branches, as there would be many.
  for (std::size_t k = 0; k < now.size(); ++k) {
    const int a = now[k], b = old[k];
    all = all & (((a < 0) & (b < 0)) | ((a >= 0) & (b >= 0) & is(a, b)));
  }
  return all;
}

// Whether each unknown is where it was, or moved back by `by`.
bool are_shifted(Dofs now, Dofs old, int by) {
  return all_dofs(
      now, old, [by](int a, int b) { return (a == b) | (a == b + by); });
}

}  // namespace

PatternShift::Extent PatternShift::extent(Dofs dofs) {
  constexpr unsigned none = -1;
  unsigned lowest = none;
  int highest = -1;
  for (const int dof : dofs) {
    lowest = std::min(lowest, static_cast<unsigned>(dof));  // -1 is the largest
    highest = std::max(highest, dof);
  }
  return {static_cast<int>(std::min(lowest, none / 2)), highest};
}

std::optional<PatternShift> PatternShift::between(const CoupledGroups& old, const CoupledGroups& now) {
  PatternShift shift;
  shift.by_ = now.unknowns - old.unknowns;
  shift.extents_.reserve(now.elements.size());
  for (const Dofs element : now.elements) shift.extents_.push_back(extent(element));
  if (!shift.find_changed(old, now)) return {};
  shift.find_renewed(now);
  if (!shift.holds_elements(old, now) || !shift.holds_others(old, now)) return {};
  return shift;
}

// Finds the changed elements, between those that may be the same, and their unknowns; returns whether there
// are any.
bool PatternShift::find_changed(const CoupledGroups& old, const CoupledGroups& now) {
  const int count = static_cast<int>(now.elements.size()), old_count = static_cast<int>(old.elements.size());
  const int most = std::min(count, old_count);
  while (same_left_ < most && std::ranges::equal(now.elements[same_left_], old.elements[same_left_]))
    ++same_left_;
  while (same_right_ < most - same_left_ &&
         are_shifted(now.elements[count - 1 - same_right_], old.elements[old_count - 1 - same_right_], by_))
    ++same_right_;
  changed_begin_ = std::numeric_limits<int>::max();
  int old_end = 0;
  const auto widen = [&](const Extent& of, int& end) {
    changed_begin_ = std::min(changed_begin_, of.lowest);
    end = std::max(end, of.highest + 1);
  };
  for (int i = same_left_; i < count - same_right_; ++i) widen(extents_[i], changed_end_);
  for (int i = same_left_; i < old_count - same_right_; ++i) widen(extent(old.elements[i]), old_end);
  changed_end_ = std::max(changed_end_, old_end + by_);
  return changed_begin_ < changed_end_ && changed_begin_ < changed_end_ - by_;
}

void PatternShift::find_renewed(const CoupledGroups& now) {
  begin_ = changed_begin_;
  end_ = changed_end_;
  const int count = static_cast<int>(extents_.size());
  for (int i = 0; i < count; ++i) {
    const auto [lowest, highest] = extents_[i];
    if (highest < changed_begin_ || lowest >= changed_end_ ||
        !any_dof(now.elements[i], [&](int dof) { return is_changed(dof); }))
      continue;
    begin_ = std::min(begin_, lowest);
    end_ = std::max(end_, highest + 1);
  }
  while (left_ < same_left_ && extents_[left_].highest < begin_) ++left_;
  while (right_ < same_right_ && extents_[count - 1 - right_].lowest >= end_) ++right_;
}

// Whether the elements outside the stretch keep their coupling: those on the left have unchanged numbers.
bool PatternShift::holds_elements(const CoupledGroups& old, const CoupledGroups& now) const {
  const int count = static_cast<int>(now.elements.size()), old_count = static_cast<int>(old.elements.size());
  for (int i = 0; i < same_left_; ++i)
    if (by_ != 0 && extents_[i].highest >= changed_end_) return false;
  for (int i = 1; i <= same_right_; ++i)
    if (!all_dofs(now.elements[count - i], old.elements[old_count - i],
                  [&](int a, int b) { return is_changed(a) || is_kept(a, b); }))
      return false;
  return true;
}

// Whether each group of forces or constraints couples kept unknowns only, or renewed ones only.
bool PatternShift::holds_others(const CoupledGroups& old, const CoupledGroups& now) const {
  return std::equal(
      now.others.begin(), now.others.end(), old.others.begin(), old.others.end(),
      [&](const std::vector<int>& a, const std::vector<int>& b) {
        return all_dofs(
                   a, b, [&](int i, int j) { return is_kept(i, j); }) ||
               (!any_dof(
                    a, [&](int i) { return !is_renewed(i); }) &&
                !any_dof(
                    b, [&](int j) { return j < begin_ || j >= end_ - by_; }));
      });
}

// The rows of the columns from begin_ to end_, in order, from all groups that hold one of them.
SparsePattern PatternShift::renewed_columns(const CoupledGroups& now) const {
  const auto is_renewed = [&](int dof) { return this->is_renewed(dof); };
  std::vector<Dofs> groups;
  for (std::size_t i = 0; i < now.elements.size(); ++i)
    if (extents_[i].highest >= begin_ && extents_[i].lowest < end_ && any_dof(now.elements[i], is_renewed))
      groups.push_back(now.elements[i]);
  for (const std::vector<int>& group : now.others)
    if (any_dof(group, is_renewed)) groups.emplace_back(group);
  std::vector<int> unknowns;
  for (const Dofs group : groups)
    std::copy_if(group.begin(), group.end(), std::back_inserter(unknowns), [](int dof) { return dof >= 0; });
  for (int column = begin_; column < end_; ++column) unknowns.push_back(column);
  std::sort(unknowns.begin(), unknowns.end());
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
  const auto place = [&](int unknown) {
    return static_cast<int>(std::lower_bound(unknowns.begin(), unknowns.end(), unknown) - unknowns.begin());
  };
  Coupling coupling(static_cast<int>(unknowns.size()));
  for (const Dofs group : groups) {
    for (const int dof : group)
      if (dof >= 0) coupling.add(place(dof), 1);
    coupling.close();
  }
  const SparsePattern own = coupling.pattern();
  std::vector<int> starts{0}, rows;
  for (int column = begin_; column < end_; ++column) {
    const int at = place(column);
    for (int k = own.column_starts()[at]; k < own.column_starts()[at + 1]; ++k)
      rows.push_back(unknowns[own.rows()[k]]);
    starts.push_back(static_cast<int>(rows.size()));
  }
  return {std::move(starts), std::move(rows)};
}

SparsePattern PatternShift::pattern(const SparsePattern& old, const CoupledGroups& now) const {
  const SparsePattern renewed = renewed_columns(now);
  const std::vector<int>&old_starts = old.column_starts(), &old_rows = old.rows();
  const int old_end = end_ - by_, first = old_starts[begin_], last = old_starts[old_end];
  const int renewed_count = static_cast<int>(renewed.rows().size());
  std::vector<int> starts(static_cast<std::size_t>(now.unknowns) + 1),
      rows(old_rows.size() - static_cast<std::size_t>(last - first) + renewed.rows().size());
  std::copy_n(old_starts.begin(), begin_, starts.begin());
  std::transform(
      renewed.column_starts().begin(), renewed.column_starts().end(), starts.begin() + begin_,
      [&](int start) { return first + start; });
  std::transform(old_starts.begin() + old_end, old_starts.end(), starts.begin() + end_,
                 [&](int start) { return start - last + first + renewed_count; });
  std::copy_n(old_rows.begin(), first, rows.begin());
  const auto behind = std::copy(renewed.rows().begin(), renewed.rows().end(), rows.begin() + first);
  std::transform(old_rows.begin() + last, old_rows.end(), behind, [by = by_](int row) { return row + by; });
  // The few rows of a column that lie on the other side of the stretch.
  for (int column = 0; column < begin_; ++column)
    for (int k = starts[column + 1] - 1; rows[k] >= changed_begin_; --k) rows[k] += by_;
  for (int column = end_; column < now.unknowns; ++column)
    for (int k = starts[column]; rows[k] - by_ < changed_begin_; ++k) rows[k] -= by_;
  return {std::move(starts), std::move(rows)};
}

}  // namespace nurbeam
