"""nurbeam inside FreeCAD: flexible beams along curves of a document, with bodies that slide on them."""
