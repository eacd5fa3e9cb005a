"""Heaps of coarse Ti6Al4V, made with the same seeds with and without a change: do they differ?

A variant is a function that changes a case; heaps are kept in the folder
and not made twice.
"""
import argparse
import concurrent.futures
import json
import math
import pathlib
import subprocess

import numpy
from PIL import Image

import optima

SCALE_FACTOR = 12  # 12 grains across the plate
MASS = "1.10 g"  # 1000 grains: a bed of two thirds of a diameter
NUM_EXCHANGES = 1000
DIAMETER = SCALE_FACTOR * 71.9e-6  # D50 of the grains [m]


def energy_of_bond(bond):
    """gamma [J/m^2] at true size at which F_po is so many weights of a grain of diameter DIAMETER (physics.md, A1, C1)."""
    weight = 4386 * 9.81 * math.pi / 6 * DIAMETER**3
    return bond * weight / (2 * math.pi * DIAMETER) / SCALE_FACTOR


# mu_t, mu_r, gamma.
POWDERS = {
    "cohesionless": (0.6, 0.1, 0),
    "rolling-dominated": (0.27, 0.6, 0),
    "Bond 1": (0.35, 0.08, energy_of_bond(1)),
    "Bond 10": (0.35, 0.08, energy_of_bond(10)),
}


def case(powder, variant, seed):
    made = optima.case("ti6al4v", POWDERS[powder], SCALE_FACTOR, seed, None)
    if POWDERS[powder][2] == 0:
        made["models"] = made["models"] | {"adhesion": "none"}
    made["powder"]["mass"] = MASS
    variant(made)
    return made


def folder_of(options, powder, name, seed):
    return options.folder / powder.replace(" ", "_") / name.replace(" ", "_").replace("/", "_") / f"seed{seed}"


def simulate(options, powder, name, variant, seed):
    folder = folder_of(options, powder, name, seed)
    if (folder / "result.json").exists():
        return
    folder.mkdir(parents=True, exist_ok=True)
    path = folder.with_suffix(".json")
    path.write_text(json.dumps(case(powder, variant, seed), indent=1))
    subprocess.run([options.talus, "simulate", path, "--out", folder, "--quiet"], check=True)


class Heaps:
    """Of one variant: images as rows (seeds) of shares of powder, and numbers."""

    def __init__(self, options, powder, name):
        folders = [folder_of(options, powder, name, seed) for seed in options.seeds]
        results = [json.loads((f / "result.json").read_text()) for f in folders]
        grey = [numpy.asarray(Image.open(f / "profile.png"), dtype=float).ravel() for f in folders]
        self.images = 1 - numpy.array(grey) / 255
        self.nebp = self.images.sum(axis=1) * optima.PIXEL_AREA
        self.mass = numpy.array([1e6 * r["observables"]["mass_on_plate_kg"] for r in results])
        self.height = numpy.array([1e3 * r["observables"]["height_m"] for r in results])
        self.cpu = numpy.mean([r["timing"]["cpu_time_s"] for r in results])
        self.steps = numpy.mean([r["num_steps"] for r in results])
        self.grain_steps = numpy.mean([r["timing"]["particle_steps"] for r in results])
        self.bed = numpy.array([r["bed"]["solid_fraction"] for r in results])


def mean_and_error(values):
    return values.mean(), values.std(ddof=1) / math.sqrt(len(values))


def exchange(first, second):
    """SAD between the mean images, the mean of it by chance, and the share p of chances that are as large: each exchanges
    the two within each seed at random."""
    difference = first.images - second.images
    difference = difference[:, numpy.any(difference != 0, axis=0)]
    signs = numpy.random.default_rng(1).choice((-1.0, 1.0), (NUM_EXCHANGES, len(difference)))
    by_chance = numpy.abs(signs @ difference).sum(axis=1) / len(difference) * optima.PIXEL_AREA
    sad = numpy.abs(difference.mean(axis=0)).sum() * optima.PIXEL_AREA
    return sad, by_chance.mean(), (by_chance >= sad).mean()


def row(powder, name, heaps, first):
    values = [mean_and_error(v) for v in (heaps.mass, heaps.height, heaps.nebp)]
    cells = [powder if heaps is first else "", name, *(f"{m:.4g} ± {e:.2g}" for m, e in values)]
    if heaps is first:
        cells += ["–", "–", "–"]
    else:
        mean, error = mean_and_error(100 * (heaps.mass - first.mass) / first.mass.mean())
        sad, by_chance, p = exchange(heaps, first)
        cells += [f"{mean:+.1f} ± {error:.1f}", f"{sad:.2f} / {by_chance:.2f}", f"{p:.2g}"]
    cells += [f"{heaps.bed.mean():.3f}", f"{heaps.steps:.3g}", f"{heaps.grain_steps / first.grain_steps:.2f}",
              f"{heaps.cpu:.2f}"]
    print("| " + " | ".join(cells) + " |", flush=True)


def main(description, variants, powders=POWDERS):
    """`variants(powder)` are named; the others are compared with the first."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("talus")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--powder", choices=powders, action="append")
    parser.add_argument("--variant", action="append", help="only these, beside the first")
    parser.add_argument("--first-seed", type=int, default=1)
    parser.add_argument("--last-seed", type=int, default=30)
    parser.add_argument("--workers", type=int, default=1)
    options = parser.parse_args()
    options.seeds = range(options.first_seed, options.last_seed + 1)
    print(f"| powder | variant | mass [mg] | height [mm] | NEBP [mm²] | mass [%] | SAD / by chance [mm²] | p | bed φ "
          f"| steps | grain steps | CPU [s] |\n{'|---' * 12}|")
    for powder in options.powder or powders:
        named = dict(variants(powder))
        names = [n for k, n in enumerate(named) if k == 0 or not options.variant or n in options.variant]
        with concurrent.futures.ThreadPoolExecutor(options.workers) as pool:
            jobs = [pool.submit(simulate, options, powder, n, named[n], seed) for n in names for seed in options.seeds]
            for job in jobs:
                job.result()
        first = Heaps(options, powder, names[0])
        row(powder, names[0], first, first)
        for name in names[1:]:
            row(powder, name, Heaps(options, powder, name), first)
