#include "cad_import/program/brep_text.h"

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Standard_Failure.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <algorithm>
#include <charconv>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "cad_import/step/local_origin.h"
#include "cad_import/step/spine.h"
#include "cad_import/step/swept_solid.h"

namespace nurbeam {
namespace {

template <class Item, class Shape>
std::string text_of_all(const std::vector<Item>& items, const Shape& shape_of) {
  try {
    const BRep_Builder builder;
    TopoDS_Compound all;
    builder.MakeCompound(all);
    for (const Item& item : items) builder.Add(all, shape_of(item));
    std::ostringstream out;
    BRepTools::Write(all, out);
    return std::move(out).str();
  } catch (const Standard_Failure& e) {
    throw std::runtime_error(std::string("OpenCASCADE cannot make a shape: ") + e.GetMessageString());
  }
}

/// The first number in the text that is none, as "1.2.3", of which OpenCASCADE would read a part, behind the
/// header, which may have any; "" where there is none.
std::string broken_number(std::string_view text) {
  constexpr std::string_view space = " \t\r\n", in_numbers = "+-.0123456789eE";
  text.remove_prefix(std::min(text.find("\nLocations"), text.size()));
  for (std::size_t at = text.find_first_not_of(space); at < text.size();
       at = text.find_first_not_of(space, at)) {
    const std::string_view token = text.substr(at, text.find_first_of(space, at) - at);
    at += token.size();
    if (token.find_first_not_of(in_numbers) != std::string_view::npos ||
        token.find_first_of("0123456789") == std::string_view::npos)
      continue;
    const std::size_t sign = token.starts_with('+') && !token.starts_with("+-") ? 1 : 0;
    double value = 0;
    const auto [end, error] = std::from_chars(token.data() + sign, token.data() + token.size(), value);
    if (end != token.data() + token.size()) return std::string(token);
  }
  return "";
}

}  // namespace

std::string brep_text(const std::vector<NamedCurve>& curves) {
  return text_of_all(
      curves,
      [](const NamedCurve& curve) {
        const Eigen::Vector3d origin = local_origin(curve.curve);
        if (origin.isZero()) return TopoDS_Shape(edge(curve));
        return moved_back(edge({curve.name, moved_to_origin(curve.curve, origin), curve.part}), origin);
      });
}

std::string brep_solid_text(const std::vector<NamedSolid>& solids) {
  return text_of_all(
      solids, [](const NamedSolid& solid) { return swept_solid(solid); });
}

TopoDS_Shape brep_shape(const std::string& content) {
  const char* const damaged =
      "OpenCASCADE reads no shape in it: the file is damaged; export or copy it again";
  if (const std::string broken = broken_number(content); !broken.empty())
    throw std::runtime_error(
        "'" + broken +
        "' stands in it in the place of a number; the file is damaged; export or copy it again");
  std::istringstream in(content);
  in.exceptions(std::ios::failbit);  // else OpenCASCADE reads beyond the end for ever
  TopoDS_Shape shape;
  try {
    BRepTools::Read(shape, in, BRep_Builder());
  } catch (const std::ios::failure&) {
    throw std::runtime_error(damaged);
  }
  if (shape.IsNull()) throw std::runtime_error(damaged);
  return shape;
}

}  // namespace nurbeam
