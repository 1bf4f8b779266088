#include "cad_import/occt/appearance.h"

#include <IGESData_IGESEntity.hxx>
#include <IGESData_LevelListEntity.hxx>
#include <IGESGraph_Color.hxx>
#include <Interface_InterfaceModel.hxx>
#include <STEPConstruct_Styles.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <StepVisual_ColourRgb.hxx>
#include <StepVisual_Invisibility.hxx>
#include <StepVisual_LayeredItem.hxx>
#include <StepVisual_PreDefinedColour.hxx>
#include <StepVisual_PreDefinedItem.hxx>
#include <StepVisual_PresentationLayerAssignment.hxx>
#include <StepVisual_StyledItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace nurbeam {
namespace {

// The parts in [0, 1].
std::string hexadecimal(double red, double green, double blue) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text = "#";
  for (double part : {red, green, blue}) {
    if (!std::isfinite(part)) return "";
    const auto byte = static_cast<unsigned>(std::lround(255 * std::clamp(part, 0.0, 1.0)));
    text += {digits[byte / 16], digits[byte % 16]};
  }
  return text;
}

// -------------------------------------------------------------------------------------------------------
// STEP

// ISO 10303-46: the draughting pre-defined colours.
constexpr std::array<std::pair<std::string_view, std::string_view>, 8> step_colours{{{"red", "#ff0000"},
                                                                                     {"green", "#00ff00"},
                                                                                     {"blue", "#0000ff"},
                                                                                     {"yellow", "#ffff00"},
                                                                                     {"magenta", "#ff00ff"},
                                                                                     {"cyan", "#00ffff"},
                                                                                     {"black", "#000000"},
                                                                                     {"white", "#ffffff"}}};

std::string step_colour(const Handle(StepVisual_Colour) & colour) {
  if (const auto rgb = Handle(StepVisual_ColourRgb)::DownCast(colour))
    return hexadecimal(rgb->Red(), rgb->Green(), rgb->Blue());
  const auto named = Handle(StepVisual_PreDefinedColour)::DownCast(colour);
  if (named.IsNull() || named->GetPreDefinedItem().IsNull() || named->GetPreDefinedItem()->Name().IsNull())
    return "";
  const std::string_view name = named->GetPreDefinedItem()->Name()->ToCString();
  for (const auto& [known, value] : step_colours)
    if (name == known) return std::string(value);
  return "";
}

void add_style(const STEPConstruct_Styles& styles, const Handle(StepVisual_StyledItem) & styled,
               Appearances& appearances) {
  if (styled->Item().IsNull() || styled->Styles().IsNull()) return;
  Handle(StepVisual_Colour) surface, boundary, curve, rendered;
  double transparency = 0;
  bool is_component = false;
  if (!styles.GetColors(styled, surface, boundary, curve, rendered, transparency, is_component)) return;
  for (const Handle(StepVisual_Colour) & colour : {curve, surface, boundary, rendered}) {
    std::string& known = appearances[styled->Item().get()].colour;
    if (known.empty() && !colour.IsNull()) known = step_colour(colour);
  }
}

void add_layer(const StepVisual_PresentationLayerAssignment& layer, Appearances& appearances) {
  if (layer.AssignedItems().IsNull() || layer.Name().IsNull()) return;
  for (int i = 1; i <= layer.NbAssignedItems(); ++i) {
    Handle(Standard_Transient) item = layer.AssignedItemsValue(i).Value();
    if (const auto styled = Handle(StepVisual_StyledItem)::DownCast(item)) item = styled->Item();
    if (!item.IsNull()) appearances[item.get()].layer = layer.Name()->ToCString();
  }
}

void hide(const Handle(Standard_Transient) & item, Appearances& appearances) {
  if (const auto styled = Handle(StepVisual_StyledItem)::DownCast(item))
    return hide(styled->Item(), appearances);
  if (const auto layer = Handle(StepVisual_PresentationLayerAssignment)::DownCast(item)) {
    for (int i = 1; !layer->AssignedItems().IsNull() && i <= layer->NbAssignedItems(); ++i)
      hide(layer->AssignedItemsValue(i).Value(), appearances);
    return;
  }
  if (!item.IsNull()) appearances[item.get()].hidden = true;
}

void add_invisibility(const StepVisual_Invisibility& invisibility, Appearances& appearances) {
  for (int i = 1; !invisibility.InvisibleItems().IsNull() && i <= invisibility.NbInvisibleItems(); ++i)
    hide(invisibility.InvisibleItemsValue(i).Value(), appearances);
}

// -------------------------------------------------------------------------------------------------------
// IGES

// IGES 5.3, 2.2.4.4.13: the colour numbers of the directory entry.
constexpr std::array<std::string_view, 9> iges_colours{"",        "#000000", "#ff0000", "#00ff00", "#0000ff",
                                                       "#ffff00", "#ff00ff", "#00ffff", "#ffffff"};

std::string iges_colour(const IGESData_IGESEntity& entity) {
  if (const auto defined = Handle(IGESGraph_Color)::DownCast(entity.Color())) {
    double red = 0, green = 0, blue = 0;  // [percent]
    defined->RGBIntensity(red, green, blue);
    return hexadecimal(red / 100, green / 100, blue / 100);
  }
  const int number = entity.RankColor();
  const bool known = number >= 0 && number < static_cast<int>(iges_colours.size());
  return known ? std::string(iges_colours[static_cast<std::size_t>(number)]) : "";
}

// The first level of an entity on several.
int iges_level(const IGESData_IGESEntity& entity) {
  const Handle(IGESData_LevelListEntity) list = entity.LevelList();
  if (!list.IsNull()) return list->NbLevelNumbers() > 0 ? list->LevelNumber(1) : 0;
  return entity.Level();
}

void add_iges(const IGESData_IGESEntity& entity, Appearances& appearances) {
  const int level = iges_level(entity);
  const Appearance own{level > 0 ? std::to_string(level) : "", iges_colour(entity),
                       entity.BlankStatus() != 0 && entity.SubordinateStatus() == 0};
  if (!own.layer.empty() || !own.colour.empty() || own.hidden) appearances[&entity] = own;
}

}  // namespace

Appearances appearances_of(XSControl_WorkSession& session) {
  Appearances appearances;
  const STEPConstruct_Styles styles(&session);
  const Handle(Interface_InterfaceModel) model = session.Model();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Handle(Standard_Transient) entity = model->Value(i);
    if (const auto iges = Handle(IGESData_IGESEntity)::DownCast(entity)) add_iges(*iges, appearances);
    if (const auto styled = Handle(StepVisual_StyledItem)::DownCast(entity))
      add_style(styles, styled, appearances);
    if (const auto layer = Handle(StepVisual_PresentationLayerAssignment)::DownCast(entity))
      add_layer(*layer, appearances);
    if (const auto invisibility = Handle(StepVisual_Invisibility)::DownCast(entity))
      add_invisibility(*invisibility, appearances);
  }
  return appearances;
}

}  // namespace nurbeam
