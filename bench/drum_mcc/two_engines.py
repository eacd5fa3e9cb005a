#!/usr/bin/python3
"""two_engines.py TALUS LIGGGHTS OUT [--rpm 15] [--modulus 5e5]: the drum of single_drums.py's set "best" (ACCES' best friction, a softer
powder) in this program and in LIGGGHTS, from the same settled grains, with the same walls, law and pictures: by how much the two mean
silhouettes differ inside √0.6 of the drum's radius, cut at half, and how much powder lies on either side of the axis. 2 and 20 min of a core.

What is finished in OUT is not run again. LIGGGHTS: constant torque ("cdt"), meshes that turn with the drum, front and back, too.
"""
import argparse
import json
import math
import pathlib
import subprocess

import drum_pictures
import numpy
import single_drums
from drum_pictures import array, counted

RADIUS, HALF_WIDTH = 1e-3 * drum_pictures.RADIUS, 0.01  # of the drum [m]
FACETS = 240  # the chord lies 4 um within the circle
SIDE = 406  # of a picture [px]
PIXEL = 2 * RADIUS / SIDE  # [m]
DECK = """\
atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
soft_particles yes
read_data packing.data
neighbor 0.15e-3 bin
neigh_modify delay 0
fix m1 all property/global youngsModulus peratomtype {youngs_modulus}
fix m2 all property/global poissonsRatio peratomtype {poisson_ratio}
fix m3 all property/global coefficientRestitution peratomtypepair 1 {restitution}
fix m4 all property/global coefficientFriction peratomtypepair 1 {sliding_friction}
fix m5 all property/global coefficientRollingFriction peratomtypepair 1 {rolling_friction}
pair_style gran model hertz tangential history rolling_friction cdt
pair_coeff * *
fix drum all mesh/surface file drum.stl type 1
fix front all mesh/surface file front.stl type 1
fix back all mesh/surface file back.stl type 1
fix walls all wall/gran model hertz tangential history rolling_friction cdt mesh n_meshes 3 meshes drum front back
fix weight all gravity 9.81 vector 0 0 -1
fix motion all nve/sphere
fix t1 all move/mesh mesh drum rotate origin 0. 0. 0. axis 0. 1. 0. period {period}
fix t2 all move/mesh mesh front rotate origin 0. 0. 0. axis 0. 1. 0. period {period}
fix t3 all move/mesh mesh back rotate origin 0. 0. 0. axis 0. 1. 0. period {period}
thermo_style custom step atoms ke cpu
thermo_modify lost ignore norm no flush yes
thermo 5000
timestep {time_step}
run {start}
dump s all custom {every} state_*.dump x y z radius
run {pictures}
"""


def read_state(path):
    """Places from the drum's middle, diameters, velocities and spins of the grains [m, s]."""
    text = path.read_text()
    place = array(text, "Points").reshape(-1, 3).astype(float) - [0, 0, RADIUS]
    velocity, spin = (array(text, name).reshape(-1, 3) for name in ("velocity_m_per_s", "angular_velocity_rad_per_s"))
    return place, array(text, "diameter_m"), numpy.hstack([velocity, spin])


def write_mesh(path, triangles):
    text = "solid wall\n"
    for triangle in triangles:
        corners = "".join("vertex %.9g %.9g %.9g\n" % corner for corner in triangle)
        text += "facet normal 0 0 0\nouter loop\n" + corners + "endloop\nendfacet\n"
    path.write_text(text + "endsolid\n")


def write_walls(out):
    rim = [(RADIUS * math.cos(a), RADIUS * math.sin(a)) for a in numpy.arange(FACETS + 1) * 2 * math.pi / FACETS]
    shell = []
    for (x, z), (u, w) in zip(rim, rim[1:]):
        a, b, c, d = (x, -HALF_WIDTH, z), (u, -HALF_WIDTH, w), (u, HALF_WIDTH, w), (x, HALF_WIDTH, z)
        shell += [(a, b, c), (a, c, d)]
    write_mesh(out / "drum.stl", shell)
    far = [(1.02 * x, 1.02 * z) for x, z in rim[::4]]
    for name, y in (("front", -HALF_WIDTH), ("back", HALF_WIDTH)):
        write_mesh(out / f"{name}.stl", [((0, y, 0), (x, y, z), (u, y, w)) for (x, z), (u, w) in zip(far, far[1:])])


def write_packing(out, state):
    place, diameters, movement = read_state(state)
    box = "-0.045 0.045 xlo xhi\n-0.0115 0.0115 ylo yhi\n-0.045 0.045 zlo zhi\n"
    lines = [f"settled grains\n\n{len(place)} atoms\n1 atom types\n\n{box}\nAtoms\n"]
    for i, (p, diameter) in enumerate(zip(place, diameters), 1):
        lines.append("%d 1 %.9g 1580 %.9g %.9g %.9g" % (i, diameter, *p))
    lines.append("\nVelocities\n")
    for i, m in enumerate(movement, 1):
        lines.append("%d %.9g %.9g %.9g %.9g %.9g %.9g" % (i, *m))
    (out / "packing.data").write_text("\n".join(lines) + "\n")


def run_liggghts(program, out, case, times):
    """From the first of the times on; pictures at the others."""
    result = json.loads((out / "talus/result.json").read_text())
    step = 0.9 * result["conditions"]["time_step_s"]
    steps = [round((time - times[0]) / step) for time in times]
    write_walls(out)
    write_packing(out, out / "talus/state_0000.vtp")
    (out / "in.drum").write_text(DECK.format(
        **case["powder"]["material"] | {"youngs_modulus": result["conditions"]["youngs_modulus_Pa"]}, time_step=step,
        period=60 / float(case["rig"]["speed"].split()[0]), start=steps[1], pictures=steps[-1] - steps[1],
        every=round((steps[-1] - steps[1]) / (len(times) - 2))))
    with open(out / "liggghts.log", "w") as log:
        subprocess.run([program, "-in", "in.drum"], cwd=out, check=True, stdout=log)


def silhouette(place, radius):
    """Powder of one state, seen along the drum's axis; rows from the top."""
    seen = numpy.zeros((SIDE, SIDE), bool)
    for x, z, r in zip(place[:, 0] / PIXEL + SIDE / 2, SIDE / 2 - place[:, 2] / PIXEL, radius / PIXEL):
        left, right = max(0, int(x - r)), min(SIDE, int(x + r) + 1)
        top, bottom = max(0, int(z - r)), min(SIDE, int(z + r) + 1)
        columns = numpy.arange(left, right) + 0.5 - x
        rows = numpy.arange(top, bottom) + 0.5 - z
        seen[top:bottom, left:right] |= columns[None] ** 2 + rows[:, None] ** 2 <= r * r
    return seen


def dumped(path):
    rows = numpy.loadtxt(path, skiprows=9)
    return silhouette(rows[:, :3], rows[:, 3])


def stated(path):
    place, diameters, _ = read_state(path)
    return silhouette(place, diameters / 2)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("talus")
    parser.add_argument("liggghts")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--rpm", type=float, default=15)
    parser.add_argument("--modulus", default="5e5")
    arguments = parser.parse_args()
    out = arguments.out
    out.mkdir(parents=True, exist_ok=True)
    values = list(single_drums.SETS["best"])
    values[4] = f"{arguments.modulus} Pa"
    start = values[-1][0]
    case = single_drums.case(values, arguments.rpm, start)
    times = [0.1] + [start + 0.01 * k for k in range(21)]  # 0.1 s to settle
    case["outputs"]["times"] = [f"{time:.2f} s" for time in times]
    if not (out / "talus/result.json").exists():
        (out / "case.json").write_text(json.dumps(case, indent=1))
        subprocess.run([arguments.talus, "simulate", out / "case.json", "--out", out / "talus", "--quiet"], check=True)
    if len(list(out.glob("state_*.dump"))) < len(times) - 2:  # LIGGGHTS writes at multiples of so many steps
        run_liggghts(arguments.liggghts, out, case, times)
    ours = [stated(path) for path in sorted((out / "talus").glob("state_*.vtp"))[1:]]
    theirs = [dumped(path) for path in sorted(out.glob("state_*.dump"), key=lambda p: int(p.stem[6:]))]
    compare(ours, theirs)


def compare(ours, theirs):
    counts, mm2 = counted(SIDE), drum_pictures.pixel_area(SIDE)
    for name, cut in (("at half of the mean", lambda seen: numpy.mean(seen, axis=0) > 0.5),
                      ("in any picture", lambda seen: numpy.any(seen, axis=0))):
        a, b = cut(ours) & counts, cut(theirs) & counts
        print(f"powder {name}: {mm2 * a.sum():.1f} mm^2 here, {mm2 * b.sum():.1f} in LIGGGHTS; here alone {mm2 * (a & ~b).sum():.1f}, "
              f"there alone {mm2 * (b & ~a).sum():.1f}")
    for name, columns in (("left", slice(0, SIDE // 2)), ("right", slice(SIDE // 2, None))):
        here, there = ([mm2 * (picture & counts)[:, columns].sum() for picture in side] for side in (ours, theirs))
        print(f"{name} of the axis: {numpy.mean(here):.1f} ± {numpy.std(here):.1f} mm^2 a picture here, "
              f"{numpy.mean(there):.1f} ± {numpy.std(there):.1f} in LIGGGHTS")


if __name__ == "__main__":
    main()
