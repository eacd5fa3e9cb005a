#!/usr/bin/python3
"""optima.py TALUS FOLDER [--powder ti6al4v|al6061] [--workers N] [--scale-factors F…] [--beyond F [--make SET…]]

Predicts the heaps of published optima from coarse ones. Both powders have millions of grains; here they are simulated
4 to 16 times as large, with more seeds where they are cheaper, and what they show is carried on to true size (f = 1).

For each set: the three angles of repose, the height, the mass that stays and the area of the silhouette (NEBP), each as
the median at f = 1 with the interval that holds one heap there with 90 %. The fifth set of Ti6Al4V is no optimum.

The model: y = a + b (f^p - 1)/p + s f^q e for each number and set, p = 0 (the logarithm), 0.5, 1 or 2 and q = 0.5, 1
or 1.5 with equal weights beforehand. A heap of grains f times as large has f^-3 as many, hence the largest q. b has a normal prior about
0, its standard deviation common to the sets of a powder; s is common, too.

--other-choice   takes otherwise what was not published: dense (in place of poured), smooth (tube without friction in
                 place of one as the powder). Prints the means at the scale factors given beside those as above
--scale-factors  the heaps that the model is told of (all that it makes)
--beyond         predicts at this scale factor instead and, where heaps of it are made, says what they show
--make           makes one heap there of each of these sets first; the first set is 1

Heaps are kept in FOLDER and not made twice. All default ones: 28 core minutes for Ti6Al4V, 12 for Al6061.
"""
import argparse
import concurrent.futures
import json
import math
import pathlib
import re
import subprocess

import numpy
from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[2]
POWDERS = {
    "ti6al4v": {
        "sets": [(0.25, 0.001, 40e-5), (0.35, 0.001, 65e-5), (0.15, 0.30, 35e-5), (0.6, 0.1, 5e-5),
                 (0.35, 0.08, 15e-5)],
        "heaps": {10: 3, 8: 3, 6: 2, 5: 1, 4: 1},
    },
    "al6061": {
        "sets": [(0.6819, 0.09323, 5.843e-5), (0.2656, 0.0635, 19.16e-5), (0.5714, 0.5523, 2.101e-5),
                 (0.2331, 0.0729, 7.92e-5)],
        "heaps": {16: 3, 12: 3, 10: 2, 8: 1},
    },
}
FRAME = {"width_px": 300, "height_px": 400, "pixel_size": "50 um", "center_x_px": 150, "baseline_px": 380,
         "plate_diameter": "10 mm"}
PIXEL_AREA = 0.05**2  # [mm^2]
NUMBERS = {"angle 1": ("angle_of_repose_1_deg", 1, "°"), "angle 2": ("angle_of_repose_2_deg", 1, "°"),
           "angle 3": ("angle_of_repose_3_deg", 1, "°"), "height": ("height_m", 1e3, "mm"),
           "mass": ("mass_on_plate_kg", 1e6, "mg"), "NEBP": (None, 1, "mm²")}
POWERS = (0.0, 0.5, 1.0, 2.0)
SCATTER_POWERS = (0.5, 1.0, 1.5)
# Slopes between nothing and half of the number's spread over the sets for each unit of the growth.
SLOPE_SHARES = (0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5)
NUM_DRAWS = 20000
OTHER_CHOICES = {
    "dense": {"filling": {"kind": "dense"}},
    "smooth": {"device": {"tube_material": {"sliding_friction": 0, "rolling_friction": 0, "surface_energy": 0}}},
}


def spec(powder):
    text = (ROOT / f"examples/{powder}/campaign.json").read_text()
    return json.loads(re.sub(r"(?m)(^|\s)//.*$", "", text))


def case(powder, values, f, seed, choice):
    campaign = spec(powder)
    other = OTHER_CHOICES.get(choice, {})
    sliding, rolling, energy = values
    material = campaign["powder"]["material"] | {"sliding_friction": sliding, "rolling_friction": rolling,
                                                    "surface_energy": energy}
    return {
        "powder": campaign["powder"] | {"material": material},
        "device": campaign["device"] | other.get("device", {}),
        "models": campaign["models"],
        "filling": other.get("filling", campaign["filling"]),
        "coarse_graining": {"scale_factor": f},
        "frame": FRAME,
        "seed": seed,
    }


def heap_folder(options, powder, number, f, seed, choice=None):
    return options.folder / (f"{powder}_{choice}" if choice else powder) / f"set{number + 1}_f{f:g}_seed{seed}"


def simulate(options, powder, number, f, seed):
    folder = heap_folder(options, powder, number, f, seed, options.other_choice)
    if (folder / "result.json").exists():
        return
    folder.mkdir(parents=True, exist_ok=True)
    path = folder.with_suffix(".json")
    path.write_text(json.dumps(case(powder, POWDERS[powder]["sets"][number], f, seed, options.other_choice),
                               indent=1))
    subprocess.run([options.talus, "simulate", path, "--out", folder, "--quiet"], check=True)


def read(options, powder, number, f, seed, choice=None):
    """The numbers of one heap, not a number where one is not defined; nothing where the heap is not made."""
    folder = heap_folder(options, powder, number, f, seed, choice)
    if not (folder / "result.json").exists():
        return None
    result = json.loads((folder / "result.json").read_text())
    grey = numpy.asarray(Image.open(folder / "profile.png"), dtype=float)
    values = {name: result["observables"].get(key, math.nan) * unit
              for name, (key, unit, _) in NUMBERS.items() if key is not None}
    values["NEBP"] = (1 - grey / 255).sum() * PIXEL_AREA
    return values


def heaps(options, powder, factors):
    """(set, f, numbers) of each heap."""
    found = [(number, f, read(options, powder, number, f, seed))
             for number in range(len(POWDERS[powder]["sets"])) for f in factors
             for seed in range(1, POWDERS[powder]["heaps"].get(f, 1) + 1)]
    return [heap for heap in found if heap[2] is not None]


def predict(points, num_sets, at, chance):
    """Draws of one heap's number at scale factor `at`, sets as rows; points are (set, f, y)."""
    which, f, y = (numpy.array(column) for column in zip(*points))
    which = which.astype(int)
    center, spread = y.mean(), max(y.std(), 1e-12)
    y = (y - center) / spread
    models = [posterior(which, f, y, num_sets, at, p, q, share)
              for p in POWERS for q in SCATTER_POWERS for share in SLOPE_SHARES]
    evidence = numpy.array([m[0] for m in models])
    weights = numpy.exp(evidence - evidence.max())
    counts = chance.multinomial(NUM_DRAWS, weights / weights.sum())
    draws = []
    for (_, mean, covariance, scale, freedom), count in zip(models, counts):
        if count:
            normal = chance.multivariate_normal(numpy.zeros(num_sets), covariance, count)
            heavy = numpy.sqrt(freedom / chance.chisquare(freedom, count))[:, None]
            draws.append(mean + scale * heavy * normal)
    return center + spread * numpy.concatenate(draws).T


def growth(f, power):
    """Of the bias with the scale factor; 0 at true size."""
    return (f**power - 1) / power if power else numpy.log(f)


def posterior(which, f, y, num_sets, at, power, scatter_power, share):
    """Log evidence, and mean, covariance, scale and degrees of freedom of one heap of each set at `at`: a linear model
    with normal priors in units of s, which has the prior 1/s."""
    # A slope of `share` of the spread, where s is about a twentieth of it.
    prior = numpy.diag([400.0] * num_sets + [max((20 * share) ** 2, 1e-9)] * num_sets)
    rows = numpy.zeros((len(y), 2 * num_sets))
    rows[numpy.arange(len(y)), which] = 1
    rows[numpy.arange(len(y)), num_sets + which] = growth(f, power)
    scatter = (f / f.min()) ** (2 * scatter_power)
    total = rows @ prior @ rows.T + numpy.diag(scatter)
    solved = numpy.linalg.solve(total, numpy.column_stack([y[:, None], rows @ prior]))
    wanted = numpy.hstack([numpy.eye(num_sets), numpy.eye(num_sets) * growth(at, power)])
    square = y @ solved[:, 0]
    evidence = -0.5 * numpy.linalg.slogdet(total)[1] - 0.5 * len(y) * math.log(square)
    gain = wanted @ prior @ rows.T
    mean = gain @ solved[:, 0]
    covariance = wanted @ prior @ wanted.T - gain @ solved[:, 1:] @ wanted.T
    covariance += numpy.eye(num_sets) * (at / f.min()) ** (2 * scatter_power)
    return evidence, mean, covariance, math.sqrt(square / len(y)), len(y)


def print_head(powder, what):
    print(f"\n{powder}: {what}")
    print("| μ_t, μ_r, γ [J/m²] | " + " | ".join(f"{name} [{unit}]" for name, (_, _, unit) in NUMBERS.items()) + " |")
    print("|---" * (len(NUMBERS) + 1) + "|")


def print_row(values, cells):
    print("| {:g}, {:g}, {:.3g} | ".format(*values) + " | ".join(cells) + " |")


def table(options, powder):
    sets = POWDERS[powder]["sets"]
    made = heaps(options, powder, options.scale_factors or POWDERS[powder]["heaps"])
    chance = numpy.random.default_rng(1)
    print_head(powder, f"one heap at scale factor {options.beyond:g}, from {len(made)} at "
                       f"{', '.join(f'{f:g}' for f in sorted({f for _, f, _ in made}, reverse=True))}")
    finer = [] if options.beyond in {f for _, f, _ in made} else heaps(options, powder, [options.beyond])
    cells, inside = [[] for _ in sets], []
    for name in NUMBERS:
        points = [(number, f, values[name]) for number, f, values in made if math.isfinite(values[name])]
        draws = predict(points, len(sets), options.beyond, chance)
        for number, of_set in enumerate(draws):
            low, high = numpy.quantile(of_set, (0.05, 0.95))
            seen = [values[name] for n, _, values in finer if n == number]
            inside += [low <= value <= high for value in seen]
            cells[number].append(f"{numpy.median(of_set):.3g} ({low:.3g} … {high:.3g})"
                                 + "".join(f"; {value:.3g}" for value in seen))
    for values, row in zip(sets, cells):
        print_row(values, row)
    if inside:
        print(f"{sum(inside)} of {len(inside)} numbers of heaps made at {options.beyond:g} are inside")


def compare_choices(options, powder):
    factors = options.scale_factors or POWDERS[powder]["heaps"]
    print_head(powder, f"mean of the heaps at {', '.join(f'{f:g}' for f in factors)}, {options.other_choice} for the "
                       "example's own choice")
    for number, values in enumerate(POWDERS[powder]["sets"]):
        found = {choice: [heap for f in factors for seed in range(1, POWDERS[powder]["heaps"][f] + 1)
                          if (heap := read(options, powder, number, f, seed, choice))]
                 for choice in (options.other_choice, None)}
        means = {choice: {name: numpy.nanmean([heap[name] for heap in heaps]) for name in NUMBERS}
                 for choice, heaps in found.items()}
        print_row(values, [f"{means[options.other_choice][name]:.3g} for {means[None][name]:.3g}" for name in NUMBERS])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("talus")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--powder", choices=POWDERS, action="append")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--scale-factors", type=float, nargs="+")
    parser.add_argument("--beyond", type=float, default=1)
    parser.add_argument("--make", type=int, nargs="+", default=[])
    parser.add_argument("--other-choice", choices=OTHER_CHOICES)
    options = parser.parse_args()
    powders = options.powder or list(POWDERS)
    jobs = [(powder, number, f, seed) for powder in powders
            for f, seeds in POWDERS[powder]["heaps"].items() if not options.scale_factors or f in options.scale_factors
            for number in range(len(POWDERS[powder]["sets"])) for seed in range(1, seeds + 1)]
    jobs += [(powder, number - 1, options.beyond, 1) for powder in powders for number in options.make]
    with concurrent.futures.ThreadPoolExecutor(options.workers) as pool:
        for done in [pool.submit(simulate, options, *job) for job in jobs]:
            done.result()
    for powder in powders:
        (compare_choices if options.other_choice else table)(options, powder)


if __name__ == "__main__":
    main()
