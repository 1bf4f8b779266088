#pragma once
#include <string>

#include "cad_import/dxf/dxf_entities.h"

namespace nurbeam {

/// "#rrggbb" of AutoCAD's colour numbers that have a name; a true colour (420) goes before, 0 is that of the
/// block. "" for none.
std::string colour_of(const DxfEntity& entity, const std::string& of_block);

/// The name by which layers and blocks are found: they are one where theirs differ in the case of letters
/// only.
std::string name_key(std::string name);

bool is_in_paper_space(const DxfEntity& entity);
/// By itself, whatever its layer.
bool is_invisible(const DxfEntity& entity);
/// Whether a layer is frozen, or switched off by a negative colour.
bool is_hidden_layer(const DxfEntity& layer);

/// Whether entities of this kind are texts, points, pictures or parts of other entities.
bool draws_no_curves(std::string_view type);

}  // namespace nurbeam
