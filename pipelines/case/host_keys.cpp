#include "pipelines/case/host_keys.h"

namespace nurbeam {

namespace {

const Shape& item_shape(const Shape& shape, const char* array) {
  return find_key(shape, array)->shape.items[0];
}

Shape law_shape() {
  const Shape name = find_key(item_shape(case_keys(), "bodies"), "name")->shape,
              place = find_key(item_shape(case_keys(), "supports"), "at")->shape,
              yes_or_no{.kind = Shape::Kind::boolean};
  const Shape point{.kind = Shape::Kind::object,
                    .keys = {{"body", name, "the body that the force acts on"},
                             {"beam", name, "the beam that it acts on"},
                             {"at", place, "where on the beam", false, "beam"}},
                    .alternatives = {{{"body", "beam"}, true}, {{"body", "at"}, true}}};
  const Shape points{.kind = Shape::Kind::array, .items = {point}, .min_items = 1};
  return {.kind = Shape::Kind::object,
          .keys = {{"points", points, "where the law acts", true},
                   {"spatial", yes_or_no, "it may act in every direction; false when omitted"}}};
}

}  // namespace

const Shape& host_keys() {
  static const Shape shape = [] {
    Shape keys = case_keys();
    for (Key& key : keys.keys) {
      if (key.name != "supports" && key.name != "sliding_joints") continue;
      Shape& item = key.shape.items[0];
      item = key.name == "supports" ? support_fields().shape(true) : sliding_joint_fields().shape(true);
      item.alternatives.push_back({{"motion", "motion_law"}, false});
    }
    keys.keys.push_back({"laws", Shape{.kind = Shape::Kind::array, .items = {law_shape()}},
                         "forces by functions of the program"});
    return keys;
  }();
  return shape;
}

std::vector<CaseLaw> read_laws(const Json& json) {
  std::vector<CaseLaw> laws;
  for_each_item(json, "laws", "", [&](const Json& item, const std::string& path) {
    CaseLaw law{.path = path, .points = {}, .spatial = flag(item, "spatial")};
    for_each_item(item, "points", path, [&](const Json& point, const std::string& point_path) {
      CaseLawPoint acts{point_path, text(point, "body"), text(point, "beam"), {}};
      if (has(point, "at")) take(point["at"], acts.at);
      law.points.push_back(std::move(acts));
    });
    laws.push_back(std::move(law));
  });
  return laws;
}

}  // namespace nurbeam
