"""A material card where there is none yet."""

STEEL = {"Name": "Steel", "Density": "7850 kg/m^3", "YoungsModulus": "210000 MPa", "PoissonRatio": "0.30",
         "ThermalExpansionCoefficient": "0.000012 m/m/K"}  # fmt: skip


def first_material(document):
    """The first material card of a document; steel, which is made, where there is none."""
    for obj in document.Objects:
        if isinstance(getattr(obj, "Material", None), dict):
            return obj
    return steel(document)


def steel(document):
    """A card as FEM makes it, so that its own panel opens; a plain one where FEM is not there."""
    try:
        import ObjectsFem

        card = ObjectsFem.makeMaterialSolid(document, "Steel")
    except ImportError:
        card = document.addObject("App::MaterialObjectPython", "Steel")
    card.Material = dict(STEEL)
    card.Label = "Steel"
    return card
