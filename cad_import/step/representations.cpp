#include "cad_import/step/representations.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace nurbeam {
namespace {

bool is_representation(const StepInstances& step, int number) {
  const std::string keyword = step.keyword(number);
  if (keyword.empty())  // a complex instance
    return step.value(number).find("SHAPE_REPRESENTATION(") != std::string::npos;
  return (keyword.ends_with("SHAPE_REPRESENTATION") && !keyword.starts_with("CONTEXT_DEPENDENT")) ||
         keyword == "CONSTRUCTIVE_GEOMETRY_REPRESENTATION";
}

bool is_curve_set(const StepInstances& step, int number) {
  const std::string keyword = step.keyword(number);
  return keyword == "GEOMETRIC_CURVE_SET" || keyword == "GEOMETRIC_SET";
}

bool defines_product(int representation, const StepInstances& step) {
  const std::vector<int>& users = step.users(representation);
  return std::any_of(users.begin(), users.end(),
                     [&](int user) { return step.keyword(user) == "SHAPE_DEFINITION_REPRESENTATION"; });
}

/// The representations that are said to be of the same shape as this one.
std::vector<int> related_to(int representation, const StepInstances& step) {
  std::vector<int> related;
  for (const int user : step.users(representation)) {
    const std::string keyword = step.keyword(user);
    if (keyword != "SHAPE_REPRESENTATION_RELATIONSHIP" &&
        keyword != "CONSTRUCTIVE_GEOMETRY_REPRESENTATION_RELATIONSHIP")
      continue;
    for (const int other : step.references(user))
      if (other != representation && is_representation(step, other)) related.push_back(other);
  }
  return related;
}

}  // namespace

int representation_of(int instance, const StepInstances& step) {
  std::set<int> seen;
  std::vector<int> open{instance};
  while (!open.empty()) {
    const int number = open.back();
    open.pop_back();
    if (is_representation(step, number)) return number;
    if (!seen.insert(number).second) continue;
    for (const int user : step.users(number)) open.push_back(user);
  }
  throw std::runtime_error("no shape representation holds #" + std::to_string(instance));
}

int of_product(int representation, const StepInstances& step) {
  if (defines_product(representation, step)) return representation;
  for (const int other : related_to(representation, step))
    if (defines_product(other, step)) return other;
  return representation;
}

int context_of(int representation, const StepInstances& step) {
  return step.references(representation).back();
}

std::optional<int> set_holding(int instance, const StepInstances& step) {
  for (const int user : step.users(instance))
    if (is_curve_set(step, user)) return user;
  return std::nullopt;
}

std::optional<int> curve_set_of(int representation, const StepInstances& step) {
  const int product = of_product(representation, step);
  std::vector<int> candidates{representation, product};
  for (const int other : related_to(product, step)) candidates.push_back(other);
  for (const int candidate : candidates) {
    if (context_of(candidate, step) != context_of(representation, step)) continue;
    for (const int item : step.references(candidate))
      if (is_curve_set(step, item)) return item;
  }
  return std::nullopt;
}

std::optional<int> topmost_representation(const StepInstances& step) {
  std::set<int> components;
  for (const int used : step.with_keyword("NEXT_ASSEMBLY_USAGE_OCCURRENCE"))
    if (const std::vector<int> products = step.references(used); products.size() > 1)
      components.insert(products[1]);
  for (const int definition : step.with_keyword("SHAPE_DEFINITION_REPRESENTATION")) {
    const std::vector<int> shape = step.references(definition);  // of the product, and its representation
    if (shape.size() != 2 || step.keyword(shape[0]) != "PRODUCT_DEFINITION_SHAPE") continue;
    const std::vector<int> product = step.references(shape[0]);
    const bool is_product = !product.empty() && step.keyword(product[0]).starts_with("PRODUCT_DEFINITION") &&
                            step.keyword(product[0]) != "PRODUCT_DEFINITION_SHAPE";
    if (is_product && !components.contains(product[0])) return shape[1];
  }
  return std::nullopt;
}

}  // namespace nurbeam
