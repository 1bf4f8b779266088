#include "cad_import/ifc/ifc_model.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <numbers>
#include <stdexcept>

namespace nurbeam {
namespace {

/// The end of the statement that begins at `at`, past strings and comments.
std::size_t end_of_statement(std::string_view text, std::size_t at) {
  while (at < text.size() && text[at] != ';') {
    const bool is_string = text[at] == '\'', is_comment = text.substr(at, 2) == "/*";
    if (!is_string && !is_comment) {
      ++at;
      continue;
    }
    const std::string_view mark = is_string ? "'" : "*/";
    const std::size_t end = text.find(mark, at + mark.size());
    at = end == std::string_view::npos ? text.size() : end + mark.size();
  }
  return at;
}

std::size_t skip_space(std::string_view text, std::size_t at) {
  while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at])) != 0) ++at;
  return at;
}

double prefix_of(const std::string& name) {
  static const std::map<std::string, double> known{{"KILO", 1e3},  {"HECTO", 1e2},  {"DECA", 1e1},
                                                   {"DECI", 1e-1}, {"CENTI", 1e-2}, {"MILLI", 1e-3},
                                                   {"MICRO", 1e-6}};
  const auto prefix = known.find(name);
  return prefix == known.end() ? 1 : prefix->second;
}

Eigen::Vector3d direction(const IfcModel& model, const IfcValue& reference,
                          const Eigen::Vector3d& otherwise) {
  if (!reference.is_reference()) return otherwise;
  const Eigen::Vector3d given = ifc_vector(model.at(reference).at(0));
  if (!(given.norm() > 0)) throw std::runtime_error("its direction is (0, 0, 0), which is no direction");
  return given.normalized();
}

/// x as far as it is at right angles to z.
Eigen::Affine3d axes(const Eigen::Vector3d& origin, const Eigen::Vector3d& z, const Eigen::Vector3d& given) {
  Eigen::Vector3d x = given - given.dot(z) * z;
  if (!(x.norm() > 1e-9)) x = Eigen::Vector3d::UnitY().cross(z);
  if (!(x.norm() > 1e-9)) x = Eigen::Vector3d::UnitX();
  x.normalize();
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
  place.linear() << x, z.cross(x), z;
  place.translation() = origin;
  return place;
}

Eigen::Affine3d operator_place(const IfcModel& model, const IfcValue& given) {
  const bool in_space = given.text.find("3D") != std::string::npos;
  const Eigen::Vector3d z =
      in_space ? direction(model, given.at(4), Eigen::Vector3d::UnitZ()) : Eigen::Vector3d(0, 0, 1);
  const Eigen::Affine3d turned =
      axes(ifc_point(model, given.at(2)), z, direction(model, given.at(0), Eigen::Vector3d::UnitX()));
  Eigen::Vector3d y = turned.linear().col(1);
  if (given.at(1).is_reference() && direction(model, given.at(1), y).dot(y) < 0) y = -y;
  const double scale = given.at(3).kind == IfcValue::Kind::none ? 1 : given.at(3).as_number();
  const bool is_uneven = given.text.ends_with("NONUNIFORM");
  const auto own = [&](std::size_t i) {
    return is_uneven && given.at(i).kind != IfcValue::Kind::none ? given.at(i).as_number() : scale;
  };
  if (!(scale > 0)) throw std::runtime_error("the scale of its transformation is not positive");
  Eigen::Affine3d place = turned;
  place.linear() << scale * turned.linear().col(0), own(in_space ? 5 : 4) * y,
      own(6) * turned.linear().col(2);
  return place;
}

Eigen::Affine3d own_place(const IfcModel& model, const IfcValue& given) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), z = Eigen::Vector3d::UnitZ();
  if (given.text == "IFCAXIS2PLACEMENT3D")
    return axes(ifc_point(model, given.at(0)), direction(model, given.at(1), z),
                direction(model, given.at(2), x));
  if (given.text == "IFCAXIS2PLACEMENT2D")
    return axes(ifc_point(model, given.at(0)), z, direction(model, given.at(1), x));
  if (given.text.starts_with("IFCCARTESIANTRANSFORMATIONOPERATOR")) return operator_place(model, given);
  throw std::runtime_error("it is placed by " + given.text + ", which is not read");
}

}  // namespace

IfcModel::IfcModel(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = skip_space(text, at), end = end_of_statement(text, begin);
    at = end + 1;
    if (begin >= text.size() || text[begin] != '#') continue;
    int number = 0;
    const auto [behind, error] = std::from_chars(text.data() + begin + 1, text.data() + end, number);
    const std::size_t equals = skip_space(text, static_cast<std::size_t>(behind - text.data()));
    const bool is_one = error == std::errc() && equals < end && text[equals] == '=';
    const std::size_t value = skip_space(text, equals + 1);
    constexpr std::size_t shown = 30;
    if (!is_one || !instances_.emplace(number, text.substr(value, end - value)).second)
      damaged_.emplace_back(text.substr(begin, std::min(end - begin, shown)));
  }
  read_units();
}

void IfcModel::read_units() {
  for (const int assignment : with_keyword("IFCUNITASSIGNMENT")) try {
      const IfcValue units = instance(assignment).at(0);
      for (const IfcValue& reference : units.items) {
        const IfcValue unit = at(reference);
        const double size = unit_of(unit);
        if (unit.at(1).text == "LENGTHUNIT" && size > 0) length_unit_ = size;
        if (unit.at(1).text == "PLANEANGLEUNIT" && size > 0) angle_unit_ = size;
      }
    } catch (const std::runtime_error&) {
      continue;  // the unit stays undeclared, which is told
    }
}

double IfcModel::unit_of(const IfcValue& unit, int depth) const {
  constexpr int deepest_unit = 10;
  if (unit.text == "IFCSIUNIT") return prefix_of(unit.at(2).text);
  if (!unit.text.starts_with("IFCCONVERSIONBASEDUNIT") || depth > deepest_unit) return 0;
  const IfcValue measure = at(unit.at(3));
  return measure.at(0).as_number() * unit_of(at(measure.at(1)), depth + 1);
}

IfcValue IfcModel::instance(int number) const {
  const auto known = instances_.find(number);
  if (known == instances_.end())
    throw std::runtime_error("it refers to #" + std::to_string(number) + ", which the file does not have");
  return parsed_instance(known->second);
}

IfcValue IfcModel::at(const IfcValue& reference) const {
  if (!reference.is_reference()) throw std::runtime_error("a value that must refer to an instance does not");
  return instance(reference.reference);
}

std::string_view IfcModel::keyword(int number) const {
  const auto known = instances_.find(number);
  if (known == instances_.end()) return {};
  const std::size_t end = known->second.find_first_of("( \t\r\n");
  return known->second.substr(0, end);
}

std::vector<int> IfcModel::with_keyword(std::string_view wanted) const {
  std::vector<int> found = with_prefix(wanted);
  std::erase_if(found, [&](int number) { return keyword(number) != wanted; });
  return found;
}

std::vector<int> IfcModel::with_prefix(std::string_view wanted) const {
  std::vector<int> found;
  for (const auto& [number, text] : instances_)
    if (text.starts_with(wanted)) found.push_back(number);
  return found;
}

std::vector<int> IfcModel::numbers() const {
  std::vector<int> all;
  for (const auto& [number, text] : instances_) all.push_back(number);
  return all;
}

std::string IfcModel::label(int number) const {
  return "#" + std::to_string(number) + " " + std::string(keyword(number));
}

Eigen::Vector3d ifc_vector(const IfcValue& coordinates) {
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  if (coordinates.items.size() < 2 || coordinates.items.size() > 3)
    throw std::runtime_error("a point or direction has not two or three coordinates");
  for (std::size_t i = 0; i < coordinates.items.size(); ++i)
    vector(static_cast<Eigen::Index>(i)) = coordinates.items[i].as_number();
  return vector;
}

Eigen::Vector3d ifc_point(const IfcModel& model, const IfcValue& point) {
  const IfcValue given = model.at(point);
  if (given.text != "IFCCARTESIANPOINT")
    throw std::runtime_error("its place is " + given.text + ", which is not read");
  return ifc_vector(given.at(0));
}

Eigen::Affine3d ifc_placement(const IfcModel& model, const IfcValue& placement) {
  constexpr int longest = 1000;
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
  IfcValue reference = placement;
  for (int i = 0; i < longest; ++i) {
    if (!reference.is_reference()) return place;
    const IfcValue given = model.at(reference);
    if (given.text == "IFCLINEARPLACEMENT") {
      if (!given.at(2).is_reference())
        throw std::runtime_error(
            "it is placed along a curve (IFCLINEARPLACEMENT) without a cartesian position");
      place = own_place(model, model.at(given.at(2))) * place;
    } else if (given.text == "IFCLOCALPLACEMENT") {
      place = own_place(model, model.at(given.at(1))) * place;
    } else {
      return own_place(model, given) * place;
    }
    reference = given.at(0);
  }
  throw std::runtime_error("its placement goes on to more than " + std::to_string(longest) +
                           " others, or to itself: a circle of references");
}

}  // namespace nurbeam
