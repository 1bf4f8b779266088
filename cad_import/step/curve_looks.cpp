#include "cad_import/step/curve_looks.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include "cad_import/step/encoded_text.h"
#include "cad_import/step/step_instances.h"

namespace nurbeam {
namespace {

std::string reference(int number) { return "#" + std::to_string(number); }

std::string list_of(const std::vector<int>& numbers) {
  std::string list;
  for (const int number : numbers) list += (list.empty() ? "" : ",") + reference(number);
  return "(" + list + ")";
}

/// The instances of each text, in the order in which these come first.
std::map<std::string, std::vector<int>> grouped(const std::vector<int>& instances,
                                                const std::vector<NamedCurve>& curves,
                                                std::string NamedCurve::*text) {
  std::map<std::string, std::vector<int>> groups;
  for (std::size_t i = 0; i < curves.size(); ++i)
    if (!(curves[i].*text).empty()) groups[curves[i].*text].push_back(instances[i]);
  return groups;
}

/// The style of curves of a colour.
int add_style(StepInstances& file, const std::string& colour) {
  constexpr double brightest = 255;
  std::string parts;
  for (const int part : parts_of_colour(colour)) parts += "," + std::to_string(part / brightest);
  const int rgb = file.add("COLOUR_RGB(''" + parts + ")");
  const int font = file.add("DRAUGHTING_PRE_DEFINED_CURVE_FONT('continuous')");
  const int curve =
      file.add("CURVE_STYLE(''," + reference(font) + ",POSITIVE_LENGTH_MEASURE(0.1)," + reference(rgb) + ")");
  return file.add("PRESENTATION_STYLE_ASSIGNMENT((" + reference(curve) + "))");
}

/// The context of the representation that holds an instance, by way of what refers to it; 0 where none does.
int context_of(const StepInstances& file, int instance) {
  constexpr int most_steps = 10;
  for (int i = 0; i < most_steps && instance != 0; ++i) {
    if (file.keyword(instance).ends_with("REPRESENTATION")) return file.references(instance).back();
    const std::vector<int>& users = file.users(instance);
    instance = users.empty() ? 0 : users.front();
  }
  return 0;
}

void add_colours(StepInstances& file, const std::vector<int>& instances,
                 const std::vector<NamedCurve>& curves) {
  std::map<int, std::vector<int>> styled;  // by context
  for (const auto& [colour, coloured] : grouped(instances, curves, &NamedCurve::colour)) {
    if (!is_colour(colour)) continue;
    const int style = add_style(file, colour);
    for (const int instance : coloured) {
      const int context = context_of(file, instance);
      styled[context].push_back(
          file.add("STYLED_ITEM('color',(" + reference(style) + ")," + reference(instance) + ")"));
    }
  }
  for (const auto& [context, items] : styled)
    if (context != 0)
      file.add("MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION(''," + list_of(items) + "," +
               reference(context) + ")");
}

}  // namespace

std::string with_looks(std::string text, const std::vector<int>& instances,
                       const std::vector<NamedCurve>& curves) {
  const bool plain = std::all_of(curves.begin(), curves.end(), [](const NamedCurve& curve) {
    return curve.layer.empty() && curve.colour.empty();
  });
  if (plain) return text;
  StepInstances file(std::move(text));
  for (const auto& [layer, held] : grouped(instances, curves, &NamedCurve::layer))
    file.add("PRESENTATION_LAYER_ASSIGNMENT('" + step_string(layer) + "',''," + list_of(held) + ")");
  add_colours(file, instances, curves);
  return file.text();
}

}  // namespace nurbeam
