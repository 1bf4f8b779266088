#include "cad_import/ifc/read_ifc.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "cad_import/files/told_share.h"
#include "cad_import/ifc/ifc_curve.h"
#include "cad_import/ifc/ifc_model.h"
#include "cad_import/ifc/ifc_pipe.h"
#include "cad_import/occt/placed_curve.h"
#include "cad_import/report/length_unit.h"
#include "nurbs/arc_length.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

constexpr int most_warnings = 20;
constexpr std::size_t deepest_item = 50;
constexpr std::size_t most_ifc_curves = 500'000;
constexpr int most_items = 2'000'000;  // those that are placed again and again counted as often

/// A product, and where the items of its shape stand.
struct Product {
  std::string name, layer = {};
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
};

class IfcReader {
 public:
  IfcReader(const std::string& content, double tolerance) : model_(content) {
    report_.unit_in_metres = model_.length_unit() > 0 ? model_.length_unit() : 1;
    tolerance_ = tolerance / report_.unit_in_metres;
  }

  ImportReport report() {
    tell_unit();
    read_layers();
    read_products();
    if (report_.curves.empty()) read_loose_curves();
    tell_others();
    return std::move(report_);
  }

 private:
  void say(Severity severity, const std::string& where, const std::string& message) {
    report_.diagnostics.push_back({severity, where, message});
  }

  void warn(int instance, const std::string& message) {
    if (++warnings_ <= most_warnings) say(Severity::warning, model_.label(instance), message);
  }

  /// Does it; what it throws is a warning of the instance.
  template <class Work>
  void attempt(int instance, const Work& work) {
    try {
      work();
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& e) {
      warn(instance, std::string("not read: ") + e.what());
    }
  }

  void tell_unit() {
    const NamedUnit unit = named_unit(report_.unit_in_metres);
    report_.unit = unit.name;
    if (model_.length_unit() == 0)
      say(Severity::warning, "", "the file declares no length unit; metres are assumed");
    for (const int context : model_.with_prefix("IFCGEOMETRICREPRESENTATIONCONTEXT"))
      attempt(context, [&] {
        const IfcValue precision = model_.instance(context).at(3);
        if (precision.kind == IfcValue::Kind::number && precision.number > 0)
          report_.resolution = precision.number * report_.unit_in_metres;
      });
  }

  void read_layers() {
    for (const int layer : model_.with_prefix("IFCPRESENTATIONLAYER"))
      attempt(
          layer,
          [&] {
            const IfcValue assignment = model_.instance(layer);
            for (const IfcValue& item : assignment.at(2).items)
              layers_[item.reference] = assignment.at(0).text;
          });
  }

  void read_products() {
    std::set<int> shapes;
    for (const int shape : model_.with_keyword("IFCPRODUCTDEFINITIONSHAPE")) shapes.insert(shape);
    constexpr PartOfWork after_text{0.1, 1};
    std::size_t done = 0;
    const std::vector<int> numbers = model_.numbers();
    for (const int number : numbers) {
      tell_share_of(after_text, done++, numbers.size());
      const std::string_view keyword = model_.keyword(number);
      const bool is_alignment = keyword == "IFCALIGNMENT";
      if (keyword == "IFCALIGNMENTSEGMENT" || is_geometry(keyword)) continue;
      attempt(number, [&] {
        const IfcValue given = model_.instance(number);
        const bool has_shape = given.at(6).is_reference() && shapes.contains(given.at(6).reference);
        if (given.at(6).is_reference() && !has_shape && is_placement(given.at(5)))
          throw std::runtime_error("its shape, #" + std::to_string(given.at(6).reference) + ", is none");
        if (!has_shape && !is_alignment) return;
        Product product{.name = given.at(2).text, .place = ifc_placement(model_, given.at(5))};
        const std::size_t before = report_.curves.size();
        if (has_shape) read_shape(given.at(6).reference, product);
        if (is_alignment && report_.curves.size() == before)
          add_alignment(number, in_world(main_context(), product));
      });
    }
  }

  bool is_placement(const IfcValue& value) const {
    return value.is_reference() && model_.keyword(value.reference) == "IFCLOCALPLACEMENT";
  }

  /// One without a representation.
  void add_alignment(int alignment, const Product& product) {
    std::vector<ImportedCurve> curves = ifc_alignment(model_, alignment, tolerance_);
    if (curves.empty()) throw std::runtime_error("it has neither a representation with curves nor segments");
    add(std::move(curves), alignment, product);
  }

  /// What a representation holds.
  static const std::vector<IfcValue>& items_of(const IfcValue& representation) {
    if (!representation.text.ends_with("REPRESENTATION"))
      throw std::runtime_error("it is represented by " + representation.text +
                               ", which is no representation");
    return representation.at(3).items;
  }

  /// The context of the model, where a shape names none; 0: there is none.
  int main_context() const {
    const std::vector<int> contexts = model_.with_keyword("IFCGEOMETRICREPRESENTATIONCONTEXT");
    return contexts.empty() ? 0 : contexts.front();
  }

  /// Under the world coordinate system of its context, which a note tells where it moves anything.
  Product in_world(int context, Product product) {
    constexpr int deepest_context = 10;
    for (int i = 0; i < deepest_context; ++i) {
      const std::string_view kind = model_.keyword(context);
      if (!kind.starts_with("IFCGEOMETRICREPRESENTATION")) return product;
      const IfcValue given = model_.instance(context);
      if (kind == "IFCGEOMETRICREPRESENTATIONSUBCONTEXT") {
        context = given.at(6).reference;
        continue;
      }
      const Eigen::Affine3d world = ifc_placement(model_, given.at(4));
      if (!world.matrix().isIdentity(0) && moved_contexts_.insert(context).second)
        say(Severity::note, model_.label(context),
            "its WorldCoordinateSystem moves all that is drawn in it to " +
                text_of(Eigen::Vector3d(report_.unit_in_metres * world.translation())) +
                (world.linear().isIdentity(0) ? "" : " and turns it"));
      product.place = world * product.place;
      return product;
    }
    return product;
  }

  /// Those that are many, and no products.
  static bool is_geometry(std::string_view keyword) {
    for (const std::string_view prefix :
         {"IFCCARTESIANPOINT", "IFCDIRECTION", "IFCPOLYLOOP", "IFCFACE", "IFCAXIS2", "IFCPROPERTY", "IFCREL",
          "IFCSTYLED", "IFCPRESENTATION", "IFCSHAPE", "IFCQUANTITY"})
      if (keyword.starts_with(prefix)) return true;
    return false;
  }

  void read_shape(int shape, Product product) {
    std::vector<IfcValue> representations;
    bool has_axis = false;
    for (const IfcValue& reference : model_.instance(shape).at(2).items) {
      representations.push_back(model_.at(reference));
      has_axis |= representations.back().at(1).text == "Axis";
    }
    const std::vector<IfcValue> references = model_.instance(shape).at(2).items;
    for (std::size_t i = 0; i < representations.size(); ++i) {
      const std::string& identifier = representations[i].at(1).text;
      if (identifier == "Box" || (identifier == "FootPrint" && has_axis)) continue;
      const auto layer = layers_.find(references[i].reference);
      product.layer = layer == layers_.end() ? "" : layer->second;
      const Product placed = in_world(representations[i].at(0).reference, product);
      for (const IfcValue& item : items_of(representations[i])) read_item(item.reference, placed);
    }
  }

  void read_item(int item, const Product& product) {
    if (++visited_ > most_items) return;
    const std::size_t depth = within_.size();
    attempt(item, [&] {
      if (std::find(within_.begin(), within_.end(), item) != within_.end() || depth > deepest_item)
        throw std::runtime_error("it is made of itself: a circle of references");
      within_.push_back(item);
      const std::string_view keyword = model_.keyword(item);
      if (keyword.empty()) throw std::runtime_error("a shape refers to it, and the file does not have it");
      if (keyword == "IFCMAPPEDITEM") return read_mapped(model_.instance(item), product);
      if (keyword == "IFCGEOMETRICSET" || keyword == "IFCGEOMETRICCURVESET")
        for (const IfcValue& element : model_.instance(item).at(0).items)
          read_item(element.reference, product);
      else if (std::optional<IfcPipe> pipe = ifc_pipe(model_, item, tolerance_))
        add_pipe(std::move(*pipe), item, product);
      else if (is_ifc_curve(keyword))
        add(ifc_curves(model_, item, tolerance_), item, product);
      else
        ++others_[std::string(keyword)];
    });
    within_.resize(depth);
  }

  void read_mapped(const IfcValue& mapped, const Product& product) {
    const IfcValue source = model_.at(mapped.at(0));
    Product moved = product;
    moved.place =
        product.place * ifc_placement(model_, mapped.at(1)) * ifc_placement(model_, source.at(0)).inverse();
    const IfcValue representation = model_.at(source.at(1));
    for (const IfcValue& item : items_of(representation)) read_item(item.reference, moved);
  }

  void add_pipe(IfcPipe pipe, int item, const Product& product) {
    if (!pipe.remark.empty()) warn(item, pipe.remark);
    if (!(pipe.radius > 0))
      throw std::runtime_error("its radius is " + text_of(pipe.radius) + "; it must be positive");
    for (ImportedCurve& curve : pipe.centre) {
      curve.entity = "centre line";
      curve.free = false;
      curve.pipe_radius = pipe.radius;
      curve.bore_radius = pipe.bore > 0 && pipe.bore < pipe.radius ? pipe.bore : 0;
    }
    add(std::move(pipe.centre), item, product);
  }

  /// In metres, where the product stands.
  void add(std::vector<ImportedCurve> curves, int item, const Product& product) {
    const double unit = report_.unit_in_metres;
    const double scale = unit * std::cbrt(std::abs(product.place.linear().determinant()));
    const Eigen::Affine3d to_world = Eigen::Scaling(unit) * product.place;
    const auto layer = layers_.find(item);
    for (ImportedCurve& curve : curves) {
      if (report_.curves.size() >= most_ifc_curves)
        throw std::length_error("the file has more than " + std::to_string(most_ifc_curves) + " curves");
      curve.curve = placed(curve.curve, to_world);
      check_size(curve.curve);
      curve.name = product.name;
      curve.layer = layer == layers_.end() ? product.layer : layer->second;
      for (double* size : {&curve.deviation, &curve.pipe_radius, &curve.bore_radius}) *size *= scale;
      report_.curves.push_back(std::move(curve));
    }
  }

  static void check_size(const NurbsCurve& curve) {
    constexpr double largest = 1e15;
    if (!curve.control_points().allFinite()) throw std::runtime_error("a coordinate of it is no number");
    if (!(curve.control_points().cwiseAbs().maxCoeff() <= largest))
      throw std::runtime_error("it has a coordinate above " + text_of(largest) + " m");
    if (!(curve.control_points().row(3).minCoeff() > 0))
      throw std::runtime_error("its weights must be positive");
    if (const double size = length(curve); !(std::isfinite(size) && size > 0))
      throw std::runtime_error("its length is " + text_of(size) + " m; it must be finite and positive");
  }

  /// Curves that nothing refers to.
  void read_loose_curves() {
    std::set<int> used;
    std::vector<int> curves;
    for (const int number : model_.numbers())
      attempt(
          number,
          [&] {
            if (is_ifc_curve(model_.keyword(number))) curves.push_back(number);
            const IfcValue given = model_.instance(number);
            add_references(given, used);
          });
    std::erase_if(curves, [&](int number) { return used.contains(number); });
    for (const int number : curves)
      attempt(number, [&] { add(ifc_curves(model_, number, tolerance_), number, {}); });
    if (!report_.curves.empty())
      say(Severity::warning, model_.label(curves.front()),
          "no product of the file holds it, and it is read in its own coordinates; so are " +
              std::to_string(report_.curves.size()) + " curve(s) in all");
  }

  static void add_references(const IfcValue& value, std::set<int>& used) {
    if (value.is_reference()) used.insert(value.reference);
    for (const IfcValue& item : value.items) add_references(item, used);
  }

  void tell_others() {
    if (report_.curves.size() >= most_ifc_curves || visited_ > most_items)
      say(Severity::warning, "", "the file repeats its items too often, and the rest of them is not read");
    if (!model_.damaged().empty())
      say(Severity::warning, "",
          "statements are no instances, or have the number of another, and are not read: '" +
              model_.damaged().front() + "' and " + std::to_string(model_.damaged().size() - 1) +
              " more; the file is damaged");
    if (warnings_ > most_warnings)
      say(Severity::warning, "", std::to_string(warnings_ - most_warnings) + " more items were not read");
    if (others_.empty()) return;
    int count = 0;
    std::string kinds;
    for (const auto& [kind, number] : others_) {
      count += number;
      kinds += (kinds.empty() ? "" : ", ") + kind + " " + std::to_string(number);
    }
    say(Severity::note, "",
        std::to_string(count) +
            " items of shapes are no curves, swept disks or circles extruded or revolved, and are not read: " +
            kinds);
  }

  IfcModel model_;
  double tolerance_ = 0;
  ImportReport report_;
  std::map<int, std::string> layers_;  // by item or representation
  std::map<std::string, int> others_;  // by kind
  std::set<int> moved_contexts_;
  std::vector<int> within_;  // the item that is read, and those that hold it
  int warnings_ = 0, visited_ = 0;
};

}  // namespace

ImportReport read_ifc(const std::string& content, double tolerance) {
  return IfcReader(content, tolerance).report();
}

}  // namespace nurbeam
