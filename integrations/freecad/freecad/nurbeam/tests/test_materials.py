"""Material cards: those that FreeCAD brings, and their numbers."""

from .. import objects
from ..case.sections import material_of
from ..objects.material_card import cards_of, first_card, make_card, standard_cards
from .support import DocumentTest


class Materials(DocumentTest):
    def test_cards_that_freecad_brings_are_read(self):
        cards = standard_cards()
        self.assertGreater(len(cards), 100)
        beam = objects.make(objects.Beam, self.document)
        beam.Material = make_card(self.document, cards["Steel-Generic"], "Steel-Generic")
        expected = {"density": 7900, "youngs_modulus": 2e11, "poissons_ratio": 0.3, "thermal_expansion": 1.2e-5}
        self.assertEqual(material_of(beam), expected)
        for name, card in cards.items():
            with self.subTest(card=name):
                beam.Material.Material = card
                self.assertGreater(material_of(beam)["youngs_modulus"], 0)

    def test_a_document_without_a_card_gets_steel_once(self):
        steel = first_card(self.document)
        self.assertIs(first_card(self.document), steel)
        self.assertEqual(cards_of(self.document), [steel])
        self.assertEqual(steel.Material["Density"], "7850 kg/m^3")

    def test_a_card_without_a_number_is_told(self):
        beam = objects.make(objects.Beam, self.document)
        beam.Material = make_card(self.document, {"Name": "Air", "Density": "1 kg/m^3"}, "Air")
        with self.assertRaisesRegex(ValueError, "Air has no YoungsModulus; give it in the material card"):
            material_of(beam)
