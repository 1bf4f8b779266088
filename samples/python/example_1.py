"""Example 1 of Ding and Ouyang 2022: a clamped beam falls, and a body slides off it."""

import sys

import nurbeam as nb

model = nb.Model(gravity=[0, -9.81, 0], name="falling beam")
beam = model.add_beam([[0, 0, 0], [1, 0, 0]], section=nb.Circle(radius=0.01), elements=40, name="beam",
                      material=nb.Material(density=7200, youngs_modulus="20 MPa"), curvature="spatial")
model.add_support(beam, at="start", type="clamped")
mass = model.add_body("mass", mass=0.8)
model.add_sliding_joint(mass, beam, at=0.1, at_beam_end="leave")
results = model.run(end_time=0.75, step="0.5 ms", every=0.05,
                    integrator={"type": "generalized-alpha", "rho_infinity": 0.9})

left = next(event["time"] for event in results.report["events"] if "left" in event["kind"])
print(f"the mass leaves at {left:.4f} s; known: 0.7136 s")
assert abs(left - 0.7136) < 2e-3
if sys.argv[1:]:
    results.plot_shape().figure.savefig(sys.argv[1])
