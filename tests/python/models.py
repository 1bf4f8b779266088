"""Small models with known answers."""

import numpy as np

import nurbeam as nb

STEEL = nb.Material(density=7850, youngs_modulus="210 GPa")


def straight_cantilever(length=1.0, elements=8, tip=None, **model):
    """Along x, clamped at the start, without gravity; `tip` is a force at its end [N]."""
    built = nb.Model(gravity=[0, 0, 0], **model)
    beam = built.add_beam(nb.Curve.line([0, 0, 0], [length, 0, 0]), section=nb.Circle(radius=0.005), material=STEEL,
                          elements=elements, name="rod")
    built.add_support(beam, at="start", type="clamped")
    if tip is not None:
        built.add_load(beam, at="end", force=tip)
    return built


def bending_stiffness(radius=0.005, youngs_modulus=210e9):
    return youngs_modulus * np.pi / 4 * radius**4


def bead_on_a_wire(mass=2.0, **joint):
    """A body on a stiff straight wire along x that is held at both ends, without gravity: it slides freely."""
    built = nb.Model(gravity=[0, 0, 0], name="bead")
    wire = built.add_beam(nb.Curve.line([0, 0, 0], [4, 0, 0]), section=nb.Circle(radius=0.02), material=STEEL,
                          elements=8, name="wire")
    built.add_support(wire, at="start", type="pinned")
    built.add_support(wire, at="end", type="pinned")
    bead = built.add_body("bead", mass=mass)
    built.add_sliding_joint(bead, wire, **{"at": 1.0, **joint})
    return built
