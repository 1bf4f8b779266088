"""A bead on a wire and a force law of one's own: a spring with a damper, step by step."""

import sys

import numpy as np

import nurbeam as nb

mass, stiffness, damping, rest = 2.0, 50.0, 1.0, 2.0  # [kg], [N/m], [N s/m], [m]


def spring(t, position, velocity):
    """The force on the bead [N], and its derivatives by position and velocity."""
    force = [-stiffness * (position[0] - rest) - damping * velocity[0], 0, 0]
    return force, np.diag([-stiffness, 0, 0]), np.diag([-damping, 0, 0])


model = nb.Model(gravity=[0, 0, 0], name="bead on a spring")
wire = model.add_beam(nb.Curve.line([0, 0, 0], [4, 0, 0]), section=nb.Circle("20 mm"), elements=8,
                      material=nb.Material(density=7850, youngs_modulus="210 GPa"), name="wire")
model.add_support(wire, at="start")
model.add_support(wire, at="end")
bead = model.add_body("bead", mass=mass)
model.add_sliding_joint(bead, wire, at=1.0)
model.add_force(spring, body=bead)

simulation = model.simulate(end_time=2, step="1 ms")
for snapshot in simulation:
    if snapshot.bodies["bead"].velocity[0] < 0:  # it has turned round
        break
turned = snapshot.time
for snapshot in simulation:  # and goes on
    pass
results = simulation.results

decay = damping / (2 * mass)
omega = np.sqrt(stiffness / mass - decay**2)
t = results.times
expected = rest - np.exp(-decay * t) * (np.cos(omega * t) + decay / omega * np.sin(omega * t))
error = np.abs(results.histories["bead.x"] - expected).max()
print(f"turned at {turned:.2f} s ({np.pi / omega:.3f} s); the motion is within {error:.1e} m of the formula")
assert error < 1e-4 and 0 <= turned - np.pi / omega < 0.02

if sys.argv[1:]:
    results.plot("bead.x").figure.savefig(sys.argv[1])
