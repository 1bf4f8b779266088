"""Material cards: objects of Arch or FEM whose texts a beam reads, and the cards that FreeCAD brings."""

import functools
import glob
import os

import FreeCAD

NEEDED = ("Density", "YoungsModulus")
STEEL = {"Name": "Steel", "Density": "7850 kg/m^3", "YoungsModulus": "210000 MPa", "PoissonRatio": "0.30",
         "ThermalExpansionCoefficient": "0.000012 m/m/K"}  # fmt: skip


def cards_of(document):
    """The cards of a document."""
    return [obj for obj in document.Objects if isinstance(getattr(obj, "Material", None), dict)]


@functools.lru_cache(maxsize=1)
def standard_cards():
    """{name: texts} of the cards that FreeCAD brings, and of the user's own, with all that a beam needs."""
    import importFCMat

    material = os.path.join(FreeCAD.getResourceDir(), "Mod", "Material")
    folders = (os.path.join(material, "StandardMaterial"), os.path.join(material, "Resources", "Materials", "Standard"),
               os.path.join(FreeCAD.getUserAppDataDir(), "Material"))  # fmt: skip
    cards = {}
    for folder in folders:
        for file in sorted(glob.glob(os.path.join(glob.escape(folder), "**", "*.FCMat"), recursive=True)):
            try:
                card = importFCMat.read(file)
                is_whole = all(card[entry].strip() and FreeCAD.Units.Quantity(card[entry]).Value > 0 for entry in NEEDED)
            except Exception:  # one that lacks a number, or a broken file of the user's own, must not hide the others
                continue
            if is_whole:
                cards[os.path.splitext(os.path.basename(file))[0]] = card
    return cards


def make_card(document, texts, label):
    """A card as FEM makes it, so that its own panel opens; a plain one where FEM is not there."""
    try:
        import ObjectsFem

        card = ObjectsFem.makeMaterialSolid(document, "Material")
    except ImportError:
        card = document.addObject("App::MaterialObjectPython", "Material")
    card.Material = dict(texts)
    card.Label = label
    return card


def first_card(document):
    """The first card of a document; steel, which is made, where there is none."""
    cards = cards_of(document)
    return cards[0] if cards else make_card(document, STEEL, "Steel")
