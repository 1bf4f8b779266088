#pragma once
#include <string>
#include <unordered_map>

class Standard_Transient;
class XSControl_WorkSession;

namespace nurbeam {

/// How a file shows an entity.
struct Appearance {
  std::string layer;   ///< STEP: name of its presentation layer; IGES: its level number; "" for none
  std::string colour;  ///< "#rrggbb"; "" for none
  bool hidden = false;
};

// Only ever looked up, so that no order depends on addresses.
using Appearances = std::unordered_map<const Standard_Transient*, Appearance>;

/// The entities of a loaded file that have a layer or a colour of their own. STEP: items of
/// PRESENTATION_LAYER_ASSIGNMENT and STYLED_ITEM (the colour of its curve style, else of its surface style).
/// IGES: fields 5 and 13 of the directory entry, with colour definitions (entity 314). Hidden are items of a
/// STEP INVISIBILITY, or of a layer in one, and IGES entities that are blanked.
Appearances appearances_of(XSControl_WorkSession& session);

}  // namespace nurbeam
