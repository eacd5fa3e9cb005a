"""What the tests on wheat have in common: spheres of 3.4, 3.7 and 4.0 mm, hertz, history, rolling epsd2, that others
have simulated with LIGGGHTS 3.8 at 0.073 of the Rayleigh time (docs/verification.md).

A test is a module with COLUMN and COLUMN_SD, its columns in the published table, UNIT, AIM in words, `scene(row, law, step,
seed)`, `measure(folder)` and `report(theirs, ours)`, which returns the line that sums up and whether AIM is met.
"""
import argparse
import collections
import csv
import json
import math
import pathlib
import random
import statistics
import subprocess

SIZES = ((3.4e-3, 0.25), (3.7e-3, 0.50), (4.0e-3, 0.25))  # diameter [m], share of the mass
START_SPEED = 0.3  # downwards [m/s]

Grain = collections.namedtuple("Grain", "x y z r")
# An upright cylinder or one along y, in which grains are placed [m].
Region = collections.namedtuple("Region", "radius low high along_y", defaults=(False,))


def diameters(num_grains, seed):
    """By number, in random order."""
    weights = [share / d**3 for d, share in SIZES]
    counts = [round(num_grains * w / sum(weights)) for w in weights]
    counts[-1] += num_grains - sum(counts)
    values = [d for (d, _), count in zip(SIZES, counts) for _ in range(count)]
    random.Random(seed).shuffle(values)
    return values


def place(num_grains, region, seed):
    """Grains at random where they touch nothing: 29 % of the volume, which single tries still find."""
    chance = random.Random(seed + 1_000_000)
    cell = SIZES[-1][0]
    cells = collections.defaultdict(list)
    grains = []
    for d in diameters(num_grains, seed):
        while True:
            r, turn = (region.radius - d / 2) * math.sqrt(chance.random()), 2 * math.pi * chance.random()
            along = chance.uniform(region.low + d / 2, region.high - d / 2)
            a, b = r * math.cos(turn), r * math.sin(turn)
            grain = Grain(a, along, b, d / 2) if region.along_y else Grain(a, b, along, d / 2)
            key = tuple(math.floor(c / cell) for c in grain[:3])
            near = (g for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)
                    for g in cells[key[0] + i, key[1] + j, key[2] + k])
            if all(math.dist(g[:3], grain[:3]) > g.r + grain.r for g in near):
                break
        cells[key].append(grain)
        grains.append(grain)
    return grains


def spheres(grains):
    return [{"diameter": 2 * g.r, "position": g[:3], "velocity": [0, 0, -START_SPEED]} for g in grains]


def material(row, name="wheat"):
    return {"name": name, "density": 1400, "youngs_modulus": 1e7, "poisson_ratio": 0.25,
            "restitution": row["restitution"], "sliding_friction": row["sliding_friction"],
            "rolling_friction": row["rolling_friction"]}


def read_grains(path, fastest=math.inf):
    """Those that move at no more than `fastest` [m/s]."""
    return [Grain(r["x_m"], r["y_m"], r["z_m"], r["diameter_m"] / 2) for r in read_table(path)
            if math.hypot(r["vx_m_per_s"], r["vy_m_per_s"], r["vz_m_per_s"]) <= fastest]


def read_table(path):
    with open(path, newline="") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def median_diameter(grains):
    return 2 * statistics.median(g.r for g in grains)


def surface(points, diameter, start=0.0):
    """(middle, height) of each bin one diameter wide, from `start` on, that holds four grains or more; points are (place,
    top). The height is the highest top with three more within 1.5 diameters below it."""
    members = collections.defaultdict(list)
    for at, top in points:
        members[int((at - start) / diameter)].append(top)
    return [(start + (k + 0.5) * diameter, supported_top(tops, diameter)) for k, tops in sorted(members.items())
            if len(tops) >= 4]


def supported_top(tops, diameter):
    needed = min(3, len(tops) - 1)
    for top in sorted(tops, reverse=True):
        if sum(top - 1.5 * diameter < t <= top for t in tops) > needed:
            return top
    return statistics.median(tops)


def line(points):
    """(slope, height at 0) by least squares."""
    fit = statistics.linear_regression(*zip(*points))
    return fit.slope, fit.intercept


def height_at(fit, at):
    return fit[0] * at + fit[1]


def trimmed_line(points):
    """Without those beyond 2.5 sd in a second pass."""
    fit = line(points)
    off = [z - height_at(fit, at) for at, z in points]
    sd = statistics.pstdev(off)
    kept = [p for p, d in zip(points, off) if abs(d) <= 2.5 * sd]
    return line(kept) if 2 <= len(kept) < len(points) else fit


def shell_line(fit, points, diameter, within):
    """Three times a line through all tops within 0.75 diameters of the last one where `within(fit, place)` holds."""
    for _ in range(3):
        shell = [(at, top) for at, top in points
                 if abs(top - height_at(fit, at)) <= 0.75 * diameter and within(fit, at)]
        if len(shell) < 10:
            break
        fit = line(shell)
    return fit


def angle(fit):
    """[deg]"""
    return math.degrees(math.atan(abs(fit[0])))


def simulate(test, options, row, law, seed, folder):
    """What the test measures, and what the run took [s]."""
    folder.mkdir(parents=True, exist_ok=True)
    case = folder / "scene.in.json"
    case.write_text(json.dumps(test.scene(row, law, options.step, seed)))
    subprocess.run([options.talus, "simulate", case, "--out", folder / "run", "--quiet"], check=True)
    result = json.loads((folder / "run/result.json").read_text())
    return test.measure(folder / "run"), result["timing"]["cpu_time_s"]


def compare(test, options):
    """Runs the sets of a published table and prints a line for each; for each law what `test.report` says."""
    sets = read_table(options.csv)
    chosen = options.sets if options.sets is not None else range(len(sets))
    values = {law: [] for law in options.laws}
    print("set  mu_t    mu_r    e       theirs         " + "  ".join(f"{law:>6}" for law in options.laws) + "  core time")
    for k in chosen:
        row, seconds = sets[k], 0
        for law in options.laws:
            runs = [simulate(test, options, row, law, seed, options.out / f"{k:02}_{law}_{options.step:g}_{seed}")
                    for seed in range(options.seed, options.seed + options.seeds)]
            values[law].append(statistics.fmean(value for value, _ in runs))
            seconds += sum(used for _, used in runs)
        print(f"{k:3}  {row['sliding_friction']:.4f}  {row['rolling_friction']:.4f}  {row['restitution']:.4f}"
              f"  {row[test.COLUMN]:5.2f} ± {row[test.COLUMN_SD]:4.2f}  "
              + "  ".join(f"{values[law][-1]:6.2f}" for law in options.laws) + f"  {seconds:5.0f} s", flush=True)
    theirs = [sets[k][test.COLUMN] for k in chosen]
    return {law: test.report(theirs, values[law]) for law in options.laws}


def arguments(test, laws=("epsd2",), seeds=1):
    parser = argparse.ArgumentParser(description=test.__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("csv", type=pathlib.Path)
    parser.add_argument("--talus", default="build/release/talus")
    parser.add_argument("--laws", nargs="+", default=list(laws))
    parser.add_argument("--step", type=float, default=0.25, help="of the Rayleigh time; theirs was 0.073")
    parser.add_argument("--sets", nargs="+", type=int, help="lines of the file, from 0; default: all")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seeds", type=int, default=seeds, help="whose mean counts")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("published"))
    return parser


def main(test, **defaults):
    """Exit status 1 where the first law is not as close as it should be."""
    options = arguments(test, **defaults).parse_args()
    results = compare(test, options)
    for law, (text, _) in results.items():
        print(f"{law}: {text}")
    return 0 if results[options.laws[0]][1] else 1


def rms_report(theirs, ours, most_rms, unit):
    off = [a - b for a, b in zip(ours, theirs)]
    rms = math.sqrt(statistics.fmean(d * d for d in off))
    return (f"rms {rms:.2f} {unit}, mean {statistics.fmean(off):+.2f} {unit}, largest {max(off, key=abs):+.2f} {unit}"
            f" over {len(off)} sets", rms <= most_rms)
