#!/usr/bin/python3
"""reuse_twins.py TALUS FOLDER [--first N] [--last N] [--core-time S] [--runs N] [--shift D] [--workers N] [--demo]: the next
batch of a virtual powder, told what was simulated for the first one.

Each powder has sliding and rolling friction drawn at random. Of the first batch --runs heaps on a plate of 10 mm and as
many on one of 30 mm are simulated at true grain size and photographed from eight sides; a campaign with scale factors
1.4 and 1 and --core-time answers. The second batch is measured anew, with fresh seeds; for every other powder, the
even ones, its sliding friction is --shift (0.1) higher. A campaign with `--reuse` answers it, with one simulation of its own.

--demo: the powder of examples/demo, at its scale factors; one first batch, made by the first powder of the range, for all.

One line a powder: seconds to the first answer, the joint 90 % region over that of the first batch, whether each holds its
own truth, and what `talus compare` says of the two. The last lines count the differences found where there is one, and claimed
where there is none.
"""
import csv
import json
import math
import random
import subprocess
import sys
import time

from PIL import Image, ImageDraw

from twin import arguments, credible_level, device, frame, run

SEARCHED = {"sliding_friction": (0.1, 0.9), "rolling_friction": (0.02, 0.6)}
DRAWN = {"sliding_friction": (0.15, 0.75), "rolling_friction": (0.05, 0.5)}
MATERIAL = {"density": 4386, "youngs_modulus": "26.25 MPa", "poisson_ratio": 0.342, "restitution": 0.9,
            "rolling_damping": 0.3}
POWDER = {"material": MATERIAL, "sizes": {"kind": "mono", "diameter": "0.7 mm"}, "mass": "1.6 g"}
SCALE_FACTORS = [1.4, 1]
DEMO = {"sliding_friction": 0.45, "rolling_friction": 0.15}
DEMO_DIAMETER = "0.4 mm"
DEMO_SCALE_FACTORS = [2, 1.5, 1]
MODELS = {"adhesion": "none", "rolling": "epsd", "full_mobilisation_damping": 0}
TESTS = {"heap": 10, "wide plate": 30}  # plates [mm]
PIXEL = 1e-4  # [m]
VIEWS = 8
FINER = 4  # sub-pixels of a pixel's side


def photograph(grains, plate_mm, angle, path):
    """A silhouette of grains and plate, dark on light."""
    at = frame(plate_mm, height=130)
    scale = FINER / PIXEL
    size = (at["width_px"] * FINER, at["height_px"] * FINER)
    picture = Image.new("L", size, 230)
    pen = ImageDraw.Draw(picture)
    middle, base = at["center_x_px"] * FINER, at["baseline_px"] * FINER
    half = 0.5e-3 * plate_mm * scale
    pen.rectangle((middle - half, base, middle + half, size[1]), fill=25)
    for x, y, z, diameter in grains:
        u = middle + (x * math.cos(angle) + y * math.sin(angle)) * scale
        v, r = base - z * scale, 0.5 * diameter * scale
        pen.ellipse((u - r, v - r, u + r, v + r), fill=25)
    picture.resize((at["width_px"], at["height_px"]), Image.BOX).save(path)


def measure(options, folder, truth, name, seed):
    """The entry of `experiments`: photographs of so many runs, and the mass that falls with its standard error."""
    plate_mm, masses = TESTS[name], []
    photos = (folder / name.replace(" ", "_")).resolve()
    for i in range(options.runs):
        place = photos / f"simulated{i + 1}"
        place.mkdir(parents=True, exist_ok=True)
        case = {"powder": {**POWDER, "material": {**MATERIAL, **truth}}, "device": device(plate_mm), "models": MODELS,
                "seed": seed + i, "outputs": {"csv": True}}
        (photos / f"case{i + 1}.json").write_text(json.dumps(case))
        run(options.talus, "simulate", photos / f"case{i + 1}.json", "--out", place)
        with open(place / "heap.csv", newline="") as table:
            grains = [[float(row[k]) for k in ("x_m", "y_m", "z_m", "diameter_m")] for row in csv.DictReader(table)]
        for view in range(VIEWS):
            photograph(grains, plate_mm, math.pi * view / VIEWS, photos / f"run{i + 1}_view{view}.png")
        masses.append(json.loads((place / "result.json").read_text())["observables"]["mass_fallen_kg"])
    mean = sum(masses) / len(masses)
    spread = math.sqrt(sum((m - mean) ** 2 for m in masses) / (len(masses) - 1))
    diameter = 1e-3 * float(POWDER["sizes"]["diameter"].removesuffix(" mm"))
    grain = MATERIAL["density"] * math.pi / 6 * diameter ** 3
    return {"name": name, "photos": str(photos), "pattern": "run{run}_view{view}.png", "frame": frame(plate_mm, height=130),
            "plate_diameter": f"{plate_mm} mm", "device": device(plate_mm),
            "mass_fallen": {"value": mean, "sd": max(spread, grain) / len(masses) ** 0.5}}


def calibrate(options, folder, experiments, seed, budget, *more):
    """The result, and the seconds to what the first line says of an answer."""
    spec = {"experiments": experiments, "powder": POWDER, "device": device(10), "models": MODELS,
            "coarse_graining": {"scale_factors": SCALE_FACTORS}, "seed": seed, "workers": options.workers, "budget": budget,
            "parameters": {k: {"min": a, "max": b} for k, (a, b) in SEARCHED.items()},
            "confirm": {"candidates": 0}, "next": {"share": 0}}
    folder.with_suffix(".json").write_text(json.dumps(spec))
    begun, first = time.monotonic(), None
    command = [options.talus, "calibrate", folder.with_suffix(".json"), "--out", folder, "--json", *more]
    with subprocess.Popen([str(c) for c in command], stdout=subprocess.PIPE, text=True) as process:
        for line in process.stdout:
            if "first answer" in line and first is None:
                first = time.monotonic() - begun
    if process.returncode != 0:
        sys.exit(f"{folder}: calibrate ended with status {process.returncode}")
    return json.loads((folder / "result.json").read_text()), first


def holds(options, folder, truth):
    return credible_level(options.talus, folder, truth) <= 0.9


def batch(options, folder, truth, seed):
    return [measure(options, folder, truth, name, seed + 100 * t) for t, name in enumerate(TESTS)]


def first_batch(options, folder, truth, twin):
    """The result of the first batch's campaign; one that has ended is not made again."""
    if not (folder / "first" / "result.json").exists():
        calibrate(options, folder / "first", batch(options, folder / "batch1", truth, 10000 * twin + 1000), twin,
                  {"core_time": f"{options.core_time} s"})
    return json.loads((folder / "first" / "result.json").read_text())


def main():
    parser = arguments(powders=20, core_time=120)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--shift", type=float, default=0.1)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--demo", action="store_true")
    options = parser.parse_args()
    if options.demo:
        POWDER["sizes"]["diameter"] = DEMO_DIAMETER
        SCALE_FACTORS[:] = DEMO_SCALE_FACTORS
    said = {True: [], False: []}  # by whether there is a difference
    for twin in range(options.first, options.last + 1):
        draw = random.Random(twin)
        truth = DEMO if options.demo else {k: draw.uniform(a, b) for k, (a, b) in DRAWN.items()}
        is_shifted = twin % 2 == 0
        later = {**truth, "sliding_friction": truth["sliding_friction"] + (options.shift if is_shifted else 0)}
        folder = options.folder / f"batches{twin:02}"
        before = options.folder / "demo" if options.demo else folder
        first = first_batch(options, before, truth, twin)
        tests = batch(options, folder / "batch2", later, 10000 * twin + 2000)
        second, seconds = calibrate(options, folder / "second", tests, twin, {"simulations": 1}, "--reuse",
                                    before / "first")
        run(options.talus, "compare", before / "first", folder / "second", "--out", folder / "compare")
        compared = json.loads((folder / "compare" / "batches.json").read_text())
        verdict, together = compared["verdicts"][0], compared["together"][0]
        ratio = (second["posterior"]["region_90_volume_fraction"] / first["posterior"]["region_90_volume_fraction"])
        said[is_shifted].append(verdict["is_found"])
        print(f"twin {twin} truth " + " ".join(f"{v:.3g}" for v in truth.values()) +
              f"{', shifted' if is_shifted else ''}: first answer after {seconds:.1f} s, region x {ratio:.2f}, "
              f"holds its truth {holds(options, before / 'first', truth)}, "
              f"{holds(options, folder / 'second', later)}; no difference at level {together['credible_level_of_none']:.2f}, "
              f"measured so by chance {verdict['measured_by_chance']:.2g}; {verdict['text']}", flush=True)
    print(f"found in {sum(said[True])} of {len(said[True])} shifted pairs, "
          f"claimed in {sum(said[False])} of {len(said[False])} equal ones")


main()
