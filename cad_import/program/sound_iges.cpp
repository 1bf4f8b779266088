#include "cad_import/program/sound_iges.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "cad_import/iges/divided_spline.h"
#include "cad_import/iges/iges_records.h"
#include "cad_import/iges/iges_values.h"
#include "cad_import/program/entity_origins.h"
#include "cad_import/program/repairs.h"
#include "cad_import/report/leniency.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

constexpr int null_entity = 0, composite_curve = 102, bspline = 126, subfigure = 308, group = 402;
constexpr int most_left_out = 20;

/// "3" of "3." where a whole number stands.
std::string as_whole(const std::string& value) {
  const std::optional<double> number = iges_number(value);
  if (value.find('.') == std::string::npos || !number || *number != std::floor(*number)) return value;
  return std::to_string(static_cast<long>(*number));
}

class SoundIges {
 public:
  SoundIges(const std::string& content, const IgesGlobal& global, const KeptEntities& kept,
            ImportReport& report)
      : records_(content, global.parameter_delimiter, global.record_delimiter), kept_(kept), report_(report) {
    kept.tell(static_cast<int>(records_.all().size()));
  }

  std::string text() {
    for (std::size_t i = 0; i < records_.all().size(); ++i) check(i);
    for (std::size_t i = 0; i < records_.all().size(); ++i) cut_circles(i);
    if (!left_out_.empty()) divide_composites();
    repairs_.tell(report_);
    tell_of_empty();
    if (named_ > most_left_out)
      add_diagnostic(report_, Severity::warning, "",
                     std::to_string(named_ - most_left_out) + " more damaged entities were left out");
    return records_.text();
  }

 private:
  const IgesRecord& record(std::size_t i) const { return records_.all()[i]; }

  std::string label(std::size_t i) const {
    const IgesRecord& entity = record(i);
    return "D" + std::to_string(entity.line) + " " + iges_kind(entity.type) +
           (entity.name.empty() ? "" : " '" + entity.name + "'");
  }

  void warn(std::size_t i, const std::string& what) {
    if (++named_ <= most_left_out) add_diagnostic(report_, Severity::warning, label(i), what);
  }

  void leave_out(std::size_t i) {
    if (record(i).type == composite_curve) divided_[i] = parts_of(i);
    records_.leave_out(i);
    left_out_.insert(i);
  }

  void check(std::size_t i) {
    if (record(i).is_torn) {
      warn(i, "damaged, and left out: a line of its directory entry is lost; export or copy it again");
      return leave_out(i);
    }
    if (record(i).type == null_entity) left_out_.insert(i);
    if (!kept_.contain(static_cast<int>(i))) {
      if (kept_.without.contains(static_cast<int>(i))) warn(i, crashed_on);
      return leave_out(i);
    }
    std::vector<std::string> values = records_.values(i);
    if (const auto defect = values_defect(record(i), values)) {
      warn(i, "damaged, and left out: " + *defect + "; export or copy it again");
      return leave_out(i);
    }
    if (const std::string missing = missing_part(i, values); !missing.empty()) {
      warn(i, "damaged, and " + std::string(is_list(i) ? "read without it" : "left out") + ": it names D" +
                  missing + ", which the file does not have; export or copy it again");
      if (!is_list(i)) return leave_out(i);
    }
    if (empty_numbers(record(i), values) > 0) empty_.push_back(i);
    if (record(i).type == bspline) repair_spline(i, std::move(values));
  }

  /// The first part that is no entity of the file; "" where all are.
  std::string missing_part(std::size_t i, const std::vector<std::string>& values) const {
    for (const std::size_t at : parts_in(record(i), values))
      if (part_at(values[at]) == IgesRecords::npos && (!values[at].empty() && values[at] != "0"))
        return values[at];
    return "";
  }

  void tell_of_empty() {
    if (empty_.empty()) return;
    add_diagnostic(report_, Severity::warning, label(empty_[0]),
                   "numbers of it are empty, and read as 0; so in " + std::to_string(empty_.size()) +
                       (empty_.size() == 1 ? " entity" : " entities") +
                       " in all: where they were lost, the curve is another one: export or copy it again");
  }

  void repair_spline(std::size_t i, std::vector<std::string> values) {
    const std::vector<std::string> before = values;
    for (std::size_t k = 0; k < 6; ++k) values[k] = as_whole(values[k]);
    const auto last = static_cast<std::size_t>(*iges_number(values[0]));
    const int degree = static_cast<int>(*iges_number(values[1]));
    const std::size_t count = last + static_cast<std::size_t>(degree) + 2, range = 6 + count + 4 * (last + 1);
    std::vector<double> knots;
    for (std::size_t k = 0; k < count; ++k) knots.push_back(*iges_number(values[6 + k]));
    if (const double change = repair_knots(knots, degree); change > 0) {
      for (std::size_t k = 0; k < count; ++k) values[6 + k] = iges_real(knots[k]);
      repairs_.add_relative(label(i), repaired_knots, change);
    }
    if (values.size() < range + 2) {
      warn(i, "its last values V(0) and V(1), from where to where it goes, are lost; all of it is read");
      values.resize(range);
      values.push_back(iges_real(knots[static_cast<std::size_t>(degree)]));
      values.push_back(iges_real(knots[last + 1]));
    }
    if (values != before) records_.set_values(i, values);
    divide_spline(i, divided_spline(values, knots));
  }

  /// Its pieces stand for a spline that has gaps, by themselves.
  void divide_spline(std::size_t i, const DividedSpline& spline) {
    if (spline.pieces.empty()) return;
    warn(i, "its knot " + text_of(spline.knot) +
                " stands more often than its degree, and divides it: it is read as " +
                std::to_string(spline.pieces.size()) + " curve(s), whose ends are up to " +
                text_of(spline.widest) + " apart there, in the unit of the file");
    std::vector<std::size_t> pieces;
    for (const std::vector<std::string>& piece : spline.pieces) pieces.push_back(records_.add_like(i, piece));
    leave_out(i);
    divided_[i] = pieces;
  }

  std::vector<std::size_t> parts_of(std::size_t i) const {
    const std::vector<std::string> values = records_.values(i);
    std::vector<std::size_t> parts;
    for (const std::size_t at : parts_in(record(i), values))
      if (const std::size_t part = part_at(values[at]); part != IgesRecords::npos) parts.push_back(part);
    return parts;
  }

  std::size_t part_at(const std::string& value) const {
    return records_.at_line(static_cast<long>(iges_number(value).value_or(0)));
  }

  /// Leaves out what is made of itself, by way of the entities below it. One after another, not nested: files
  /// may be as deep as they are long.
  void cut_circles(std::size_t start) {
    struct Step {
      std::size_t entity;
      std::vector<std::size_t> left;
    };
    if (passed_.contains(start)) return;
    std::vector<Step> path{{start, parts_of(start)}};
    std::set<std::size_t> open{start};
    while (!path.empty()) {
      Step& step = path.back();
      if (step.left.empty()) {
        open.erase(step.entity);
        passed_.insert(step.entity);
        path.pop_back();
        continue;
      }
      const std::size_t next = step.left.back();
      step.left.pop_back();
      if (open.contains(next)) {
        cut(step.entity, next);
      } else if (!passed_.contains(next)) {
        open.insert(next);
        path.push_back({next, parts_of(next)});
      }
    }
  }

  void cut(std::size_t from, std::size_t to) {
    if (left_out_.contains(from)) return;
    warn(from, "left out: it is made of " + label(to) + ", which is made of it: a circle of references");
    if (is_list(from))
      set_parts(from, [&](std::size_t part) { return part != to; });
    else
      leave_out(from);
  }

  /// Of entities that have no shape of their own.
  bool is_list(std::size_t i) const { return record(i).type == group || record(i).type == subfigure; }

  /// Those that have a part that is left out are curves no more, and what is left of them stands by itself.
  void divide_composites() {
    std::map<std::size_t, std::vector<std::size_t>> users;
    for (std::size_t i = 0; i < records_.all().size(); ++i)
      if (record(i).type == composite_curve)
        for (const std::size_t part : parts_of(i)) users[part].push_back(i);
    std::vector<std::size_t> open(left_out_.begin(), left_out_.end());
    while (!open.empty()) {
      const std::size_t part = open.back();
      open.pop_back();
      for (const std::size_t user : users[part]) {
        if (left_out_.contains(user)) continue;
        leave_out(user);
        open.push_back(user);
      }
    }
    for (const auto& [composite, parts] : divided_) pieces_of(composite);
    for (std::size_t i = 0; i < records_.all().size(); ++i)
      if (is_list(i)) set_parts(i, [&](std::size_t part) { return !left_out_.contains(part); });
  }

  /// What is left of a divided composite curve, set free under its transformation.
  std::vector<std::size_t> pieces_of(std::size_t composite) {
    std::vector<std::size_t> pieces;
    std::set<std::size_t> seen;
    std::vector<std::pair<std::size_t, int>> open{{composite, 0}};  // with the matrix above
    while (!open.empty()) {
      const auto [i, above] = open.back();
      open.pop_back();
      const auto divided = divided_.find(i);
      if (!seen.insert(i).second || (left_out_.contains(i) && divided == divided_.end())) continue;
      if (above != 0 && record(i).matrix != 0 && record(i).matrix != above) {
        warn(i, "left out: the composite curve that it is a part of is damaged, and both are moved");
        continue;
      }
      if (divided == divided_.end()) {
        records_.set_free(i, above);
        pieces.push_back(i);
      } else {
        for (const std::size_t part : divided->second)
          open.emplace_back(part, std::max(above, record(i).matrix));
      }
    }
    return pieces;
  }

  /// Keeps those parts of a list, with the pieces of divided ones.
  template <class Keep>
  void set_parts(std::size_t i, const Keep& keep) {
    const std::vector<std::string> values = records_.values(i);
    const std::vector<std::size_t> places = parts_in(record(i), values);
    if (places.empty()) return;
    std::vector<std::string> kept;
    const auto line = [&](std::size_t part) { return std::to_string(record(part).line); };
    for (const std::size_t at : places) {
      const std::size_t part = part_at(values[at]);
      if (part == IgesRecords::npos || keep(part))
        kept.push_back(values[at]);
      else if (divided_.contains(part))
        for (const std::size_t piece : pieces_of(part)) kept.push_back(line(piece));
    }
    std::vector<std::string> changed(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(places[0]));
    changed.back() = std::to_string(kept.size());
    changed.insert(changed.end(), kept.begin(), kept.end());
    changed.insert(changed.end(), values.begin() + static_cast<std::ptrdiff_t>(places.back()) + 1,
                   values.end());
    if (changed != values) records_.set_values(i, changed);
  }

  IgesRecords records_;
  const KeptEntities& kept_;
  ImportReport& report_;
  Repairs repairs_;
  std::set<std::size_t> left_out_, passed_;
  std::vector<std::size_t> empty_;  // that have empty numbers
  std::map<std::size_t, std::vector<std::size_t>>
      divided_;  // composites and splines left out, with their parts
  int named_ = 0;
};

}  // namespace

std::string sound_iges(const std::string& content, const IgesGlobal& global, const KeptEntities& kept,
                       ImportReport& report) {
  return SoundIges(content, global, kept, report).text();
}

}  // namespace nurbeam
