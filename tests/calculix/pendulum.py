#!/usr/bin/env python3
"""The curved pendulum of the subdivision paper by CalculiX (Debian: calculix-ccx), whose beams are expanded to
solids and so flexible in shear, as B31 is: the numbers of pendulum_by_calculix in
pipelines/verification/references.h.

    pendulum.py FOLDER [--type B32R] [--elements 16] [--step 5e-4] [--thinner 1]

prints t, |AB| and y_B(t) - y_B(0) at every 0.01 s. The section is the rectangle with the area and the second
moment of the circle of radius 0.02 m; with --thinner n it is n times less high, with the same bending stiffness and
mass: what shear and the turning of sections do then falls by n squared. Poisson's ratio is 0: the paper has none, and solids then carry St.
Venant and Kirchhoff's law, which is E times Green's strain along the beam.
"""
import argparse
import math
import pathlib
import subprocess

RADIUS, ANGLE, SECTION, DENSITY, E = 0.5, math.pi / 3, 0.02, 6000.0, 2e6
HEIGHT, WIDTH = math.sqrt(3) * SECTION, math.pi * SECTION / math.sqrt(3)


def deck(kind, elements, step, thinner):
    per = 2 if kind.startswith("B32") else 1
    count = per * elements + 1
    places = [ANGLE * i / (count - 1) for i in range(count)]
    nodes = "".join(f"{i + 1},{RADIUS * math.sin(a):.15g},{RADIUS * (1 - math.cos(a)):.15g},0.\n"
                    for i, a in enumerate(places))
    lines = "".join(f"{i + 1}," + ",".join(str(per * i + 1 + k) for k in range(per + 1)) + "\n"
                    for i in range(elements))
    increments = round(1 / step)
    return f"""*NODE,NSET=NALL
{nodes}*ELEMENT,TYPE={kind},ELSET=EALL
{lines}*NSET,NSET=A
1
*NSET,NSET=B
{count}
*MATERIAL,NAME=M
*ELASTIC
{E * thinner**3},0.
*DENSITY
{DENSITY * thinner}
*BEAM SECTION,ELSET=EALL,MATERIAL=M,SECTION=RECT
{WIDTH:.15g},{HEIGHT / thinner:.15g}
0.,0.,1.
*BOUNDARY
A,1,5
NALL,3,3
*STEP,NLGEOM,INC={2 * increments}
*DYNAMIC,DIRECT,ALPHA=0.
{step},1.
*DLOAD
EALL,GRAV,9.81,0.,-1.,0.
*NODE PRINT,NSET=B,FREQUENCY={round(0.01 / step)}
U
*END STEP
"""


def results(file):
    """(t, u_x, u_y) of B from CalculiX's table."""
    t = None
    for line in file.read_text().splitlines():
        words = line.split()
        if "time" in words:
            t = float(words[-1])
        elif len(words) == 4 and t is not None:
            yield t, float(words[1]), float(words[2])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--type", default="B32R")
    parser.add_argument("--elements", type=int, default=16)
    parser.add_argument("--step", type=float, default=5e-4)
    parser.add_argument("--thinner", type=float, default=1)
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    (options.folder / "pendulum.inp").write_text(
        deck(options.type, options.elements, options.step, options.thinner))
    with open(options.folder / "log", "w") as log:
        subprocess.run(["ccx", "pendulum"], cwd=options.folder, check=True, stdout=log)
    x, y = RADIUS * math.sin(ANGLE), RADIUS * (1 - math.cos(ANGLE))
    for t, ux, uy in results(options.folder / "pendulum.dat"):
        print(f"{t:.4f} {math.hypot(x + ux, y + uy):.6f} {uy:.6f}")


if __name__ == "__main__":
    main()
