#!/usr/bin/python3
"""Two cases of Dosta and others 2024 (Computer Physics Communications 296, 109066) beside LIGGGHTS on the same input:

penetration   a steel sphere of 20 mm falls at 5 m/s, from a height of 60 mm, into 25 000 spheres of 2 mm in a box; its
              height over time, from 0.1 mm above the bed on, where its fall has brought it
drum          30 000 spheres of 2 mm and 8000 of 4 mm in a drum of 200 mm that turns at 2 rad/s; how many of each are in
              the quadrants x, z > 0 and x, z < 0 over time. LIGGGHTS takes 6 core minutes for the first 0.1 s

The spheres' places are input data of MercuryDPM (BSD-3), not part of this repository (docs/verification.md). Hertz,
Mindlin, no rolling resistance, two or three materials whose pairs state their restitution and friction. Needs the Debian
package liggghts. Exit status 0 where ours and theirs are within 2 % of the depth, or of each kind's number.
"""
import argparse
import collections
import csv
import gzip
import json
import math
import os
import pathlib
import subprocess
import sys

Material = collections.namedtuple("Material", "youngs_modulus density")
Sphere = collections.namedtuple("Sphere", "material radius x y z")

POISSON_RATIO = 0.2
MATERIALS = {"M1": Material(1e9, 2500), "M2": Material(0.5e9, 2000), "steel": Material(210e9, 7200)}
PAIRS = {("M1", "M1"): (0.5, 0.3), ("M1", "M2"): (0.45, 0.2), ("M2", "M2"): (0.4, 0.4), ("M1", "steel"): (0.4, 0.2),
         ("M2", "steel"): (0.4, 0.2), ("steel", "steel"): (0.6, 0.5)}  # restitution, sliding friction
NAMES = list(MATERIALS)
FILES = {"penetration": "Penetration_25KParticles.txt.gz", "drum": "Drum_PartCoordinates.txt.gz"}
MOST_OFF = 0.02

# The box that the given spheres touch: 98 by 60 mm.
BOX_X, BOX_Y, BOX_FLOOR = 0.0490, 0.0300, -0.0902435  # [m]
INTRUDER, HEIGHT, SPEED, ABOVE = 0.010, 0.060, 5.0, 1e-4  # radius [m], [m], [m/s], [m]
DRUM_RADIUS, DRUM_WIDTH, DRUM_SPEED = 0.100, 0.060, 2.0  # [m], [m], [rad/s]

TIME = {"penetration": 0.006, "drum": 0.1}  # [s]; theirs 0.1 and 5
EVERY = {"penetration": 0.001, "drum": 0.01}  # [s]
STEP = {"penetration": 1e-6, "drum": 2.5e-6}  # [s], 0.12 and 0.30 of the smallest Rayleigh time; theirs 5e-7 and 8e-7


def read_spheres(case, folder):
    """M1 are those of 1 mm radius, M2 those of 2 mm."""
    with gzip.open(folder / FILES[case], "rt") as file:
        rows = [line.split() for line in file]
    rows = [[float(cell) for cell in row] for row in rows if len(row) == 4 and row[0][0].isdigit()]
    return [Sphere("M1" if row[0] < 0.0015 else "M2", *row) for row in rows]


def bed_top(spheres):
    return max(s.z + s.radius for s in spheres)


def intruder_start(spheres):
    """Height [m] and speed [m/s] after the free fall."""
    height = bed_top(spheres) + INTRUDER + ABOVE
    return height, math.sqrt(SPEED**2 + 2 * 9.81 * (HEIGHT - height))


def talus_spheres(spheres, folder):
    """A CSV for each material."""
    files = []
    for name in sorted({s.material for s in spheres}):
        with open(folder / f"{name}.csv", "w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["radius_m", "x_m", "y_m", "z_m"])
            writer.writerows(s[1:] for s in spheres if s.material == name)
        files.append({"file": f"{name}.csv", "material": name})
    return files


def talus_walls(case):
    if case == "penetration":
        return [{"shape": "plane", "material": "steel", "position": place, "direction": normal} for place, normal in (
            ([0, 0, BOX_FLOOR], [0, 0, 1]), ([-BOX_X, 0, 0], [1, 0, 0]), ([BOX_X, 0, 0], [-1, 0, 0]),
            ([0, -BOX_Y, 0], [0, 1, 0]), ([0, BOX_Y, 0], [0, -1, 0]))]
    turning = [{"time": 0, "angular_velocity": [0, DRUM_SPEED, 0]}]
    base = [0, -DRUM_WIDTH / 2, 0]
    covers = [{"shape": "disc", "position": [0, y, 0], "direction": [0, 1, 0], "diameter": 2 * DRUM_RADIUS}
              for y in (-DRUM_WIDTH / 2, DRUM_WIDTH / 2)]
    shell = {"shape": "open_cylinder", "position": base, "direction": [0, 1, 0], "diameter": 2 * DRUM_RADIUS,
             "length": DRUM_WIDTH}
    return [{**wall, "material": "steel", "motion": turning} for wall in (shell, *covers)]


def touch(case, pair):
    """A scene takes no pair that never meets: all walls are of steel, and the intruder is alone."""
    return "M2" not in pair and pair != ("steel", "steel") if case == "penetration" else pair != ("steel", "steel")


def run_talus(case, spheres, options, folder):
    """The states, and the core time [s]."""
    used = sorted({s.material for s in spheres} | {"steel"}, key=NAMES.index)
    times = times_of(case, options)
    scene = {
        "materials": [{"name": name, "density": MATERIALS[name].density, "poisson_ratio": POISSON_RATIO,
                       "youngs_modulus": MATERIALS[name].youngs_modulus} for name in used],
        "pairs": [{"between": pair, "restitution": e, "sliding_friction": mu} for pair, (e, mu) in PAIRS.items()
                  if touch(case, pair)],
        "models": {"rolling": "none"},
        "sphere_files": talus_spheres(spheres, folder),
        "walls": talus_walls(case),
        "time_step": options.step or STEP[case],
        "stop": {"time": times[-1]},
        "outputs": {"vtp": False, "times": times[:-1]},
    }
    if case == "penetration":
        height, speed = intruder_start(spheres)
        scene["spheres"] = [{"material": "steel", "diameter": 2 * INTRUDER, "position": [0, 0, height],
                             "velocity": [0, 0, -speed]}]
    (folder / "scene.in.json").write_text(json.dumps(scene))
    subprocess.run([options.talus, "simulate", folder / "scene.in.json", "--out", folder / "run", "--quiet"], check=True)
    result = json.loads((folder / "run/result.json").read_text())
    paths = [*sorted((folder / "run").glob("state_*.csv")), folder / "run/final.csv"]
    return [read_talus(path) for path in paths], result["timing"]["cpu_time_s"]


def read_talus(path):
    with open(path, newline="") as file:
        return [(float(row["diameter_m"]) / 2, float(row["x_m"]), float(row["z_m"])) for row in csv.DictReader(file)]


def times_of(case, options):
    last = options.time or TIME[case]
    count = round(last / EVERY[case])
    return [k * EVERY[case] for k in range(1, count + 1)]


def matrix(column):
    values = [PAIRS.get((a, b)) or PAIRS[b, a] for a in NAMES for b in NAMES]
    return " ".join(str(value[column]) for value in values)


def liggghts_walls(case):
    law = "all wall/gran model hertz tangential history primitive type 3"
    if case == "penetration":
        places = (("zplane", BOX_FLOOR), ("xplane", -BOX_X), ("xplane", BOX_X), ("yplane", -BOX_Y), ("yplane", BOX_Y))
        return [f"fix wall{k} {law} {shape} {place}" for k, (shape, place) in enumerate(places)]
    # "shear x" of a cylinder along z is its angular velocity; along y, LIGGGHTS 3.8 moves it along its normal.
    return [f"fix shell {law} zcylinder {DRUM_RADIUS} 0. 0. shear x {DRUM_SPEED}",
            "fix caps all mesh/surface file covers.stl type 3",
            "fix covers all wall/gran model hertz tangential history mesh n_meshes 1 meshes caps",
            f"fix turn all move/mesh mesh caps rotate origin 0. 0. 0. axis 0. 0. 1. period {2 * math.pi / DRUM_SPEED}"]


def liggghts_axes(case, x, y, z):
    """The drum's axis is y here and z there."""
    return (z, x, y) if case == "drum" else (x, y, z)


def write_covers(path):
    """Two squares wider than the drum."""
    half, far = DRUM_WIDTH / 2, 1.5 * DRUM_RADIUS
    corners = [(-far, -far), (far, -far), (far, far), (-far, far)]
    lines = ["solid covers"]
    for z in (-half, half):
        for triangle in ((0, 1, 2), (0, 2, 3)):
            lines += ["facet normal 0 0 1", "outer loop",
                      *(f"vertex {corners[k][0]} {corners[k][1]} {z}" for k in triangle), "endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid covers"]) + "\n")


def run_liggghts(case, spheres, options, folder):
    """The states, and the core time [s]."""
    folder.mkdir(exist_ok=True)
    rows = [(NAMES.index(s.material) + 1, 2 * s.radius, MATERIALS[s.material].density,
             *liggghts_axes(case, s.x, s.y, s.z)) for s in spheres]
    down = " ".join(map(str, liggghts_axes(case, 0, 0, -1)))
    if case == "penetration":
        height, speed = intruder_start(spheres)
        rows.append((3, 2 * INTRUDER, MATERIALS["steel"].density, 0, 0, height))
    side = 0.16
    data = ["spheres", "", f"{len(rows)} atoms", "3 atom types", "",
            *(f"{-side} {side} {axis}lo {axis}hi" for axis in "xyz"), "", "Atoms", "",
            *(f"{k} " + " ".join(f"{value:.12g}" for value in row) for k, row in enumerate(rows, 1))]
    (folder / "spheres.data").write_text("\n".join(data) + "\n")
    write_covers(folder / "covers.stl")
    step = options.step or STEP[case]
    every, count = round(EVERY[case] / step), len(times_of(case, options))
    deck = ["atom_style granular", "atom_modify map array", "boundary f f f", "newton off",
            "communicate single vel yes", "units si", "hard_particles yes", "read_data spheres.data", "neighbor 0.0004 bin",
            "neigh_modify delay 0",
            "fix m1 all property/global youngsModulus peratomtype " +
            " ".join(str(MATERIALS[name].youngs_modulus) for name in NAMES),
            f"fix m2 all property/global poissonsRatio peratomtype {POISSON_RATIO} {POISSON_RATIO} {POISSON_RATIO}",
            f"fix m3 all property/global coefficientRestitution peratomtypepair 3 {matrix(0)}",
            f"fix m4 all property/global coefficientFriction peratomtypepair 3 {matrix(1)}",
            "pair_style gran model hertz tangential history", "pair_coeff * *", *liggghts_walls(case),
            f"fix g all gravity 9.81 vector {down}", "fix i all nve/sphere",
            *(["group intruder type 3", f"velocity intruder set 0 0 {-speed}"] if case == "penetration" else []),
            f"timestep {step}", "thermo_style custom step atoms ke cpu", f"thermo {every}",
            "thermo_modify lost ignore norm no",
            f"dump d all custom {every} state_*.dump radius {'y x' if case == 'drum' else 'x z'}", f"run {every * count}"]
    (folder / "in.case").write_text("\n".join(deck) + "\n")
    before = os.times().children_user
    subprocess.run(["liggghts", "-in", "in.case"], cwd=folder, stdout=subprocess.DEVNULL, check=True)
    used = os.times().children_user - before
    return [read_dump(folder / f"state_{every * k}.dump") for k in range(1, count + 1)], used


def read_dump(path):
    lines = path.read_text().splitlines()
    start = next(k for k, text in enumerate(lines) if text.startswith("ITEM: ATOMS"))
    return [tuple(float(cell) for cell in text.split()[:3]) for text in lines[start + 1:]]


def intruder_height(state):
    return next(z for radius, _, z in state if radius > 0.005)


def quadrants(state):
    """M1 and M2 in the quadrant x, z > 0, then in x, z < 0."""
    return [sum((radius > 0.0015) == large and x * sign > 0 and z * sign > 0 for radius, x, z in state)
            for sign in (1, -1) for large in (False, True)]


def report(case, times, ours, theirs, spheres):
    """Prints a line a time; the largest difference, of the depth or of each kind's number."""
    largest = 0
    if case == "penetration":
        top = bed_top(spheres)
        print("time [ms]  height theirs [mm]  ours [mm]")
        heights = [(intruder_height(a), intruder_height(b)) for a, b in zip(ours, theirs)]
        deepest = max(top - (b - INTRUDER) for _, b in heights)
        for t, (a, b) in zip(times, heights):
            print(f"{1e3 * t:9.1f}  {1e3 * b:18.3f}  {1e3 * a:9.3f}")
            largest = max(largest, abs(a - b) / deepest)
        print(f"deepest {1e3 * deepest:.1f} mm below the bed's top")
        return largest
    kinds = [sum(s.material == name for s in spheres) for name in ("M1", "M2")] * 2
    print("time [s]  M1, M2 in x, z > 0 and M1, M2 in x, z < 0: theirs, ours")
    for t, a, b in zip(times, map(quadrants, ours), map(quadrants, theirs)):
        print(f"{t:8.2f}  {b}  {a}")
        largest = max(largest, *(abs(p - q) / kind for p, q, kind in zip(a, b, kinds)))
    return largest


def compare(case, options):
    """(largest difference, ours and theirs in core seconds)."""
    spheres = read_spheres(case, options.folder)
    folder = options.out / case
    folder.mkdir(parents=True, exist_ok=True)
    ours, our_time = run_talus(case, spheres, options, folder)
    theirs, their_time = run_liggghts(case, spheres, options, folder / "liggghts")
    return report(case, times_of(case, options), ours, theirs, spheres), our_time, their_time


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", choices=list(FILES))
    parser.add_argument("folder", type=pathlib.Path, help="of the input data")
    parser.add_argument("--talus", default="build/release/talus")
    parser.add_argument("--time", type=float, help=f"simulated [s]; {TIME} unless given")
    parser.add_argument("--step", type=float, help=f"[s]; {STEP} unless given")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("published/dosta"))
    options = parser.parse_args()
    largest, ours, theirs = compare(options.case, options)
    print(f"{options.case}: largest difference {100 * largest:.2f} %; {ours:.0f} s of a core, LIGGGHTS {theirs:.0f} s")
    return 0 if largest <= MOST_OFF else 1


if __name__ == "__main__":
    sys.exit(main())
