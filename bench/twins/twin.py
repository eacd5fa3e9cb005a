"""What the benches on virtual powders have in common: their arguments, the device of their heaps, the frame of their
images, the program, and the powders that dem_twins.py has finished."""
import argparse
import json
import math
import pathlib
import random
import subprocess
import sys

import numpy
from PIL import Image

RANGES = {"sliding_friction": (0.1, 0.9), "rolling_friction": (0.02, 0.6)}  # searched, and drawn from
MATERIAL = {"density": 4386, "youngs_modulus": "26.25 MPa", "poisson_ratio": 0.342, "restitution": 0.9,
            "rolling_damping": 0.3}
EPSD = {"adhesion": "none", "rolling": "epsd", "full_mobilisation_damping": 0}


def arguments(powders=None, core_time=None):
    """A parser of TALUS FOLDER; of --first and --last, the latter `powders` by default (infinite: all); of --core-time in
    seconds."""
    parser = argparse.ArgumentParser()
    parser.add_argument("talus")
    parser.add_argument("folder", type=pathlib.Path)
    if powders:
        parser.add_argument("--first", type=int, default=1)
        parser.add_argument("--last", type=int, default=powders)
    if core_time:
        parser.add_argument("--core-time", type=float, default=core_time)
    return parser


def finished(folder, first=0, last=math.inf):
    """The powders of dem_twins.py from `first` to `last` whose campaign of both tests has a result."""
    return [twin for twin in sorted(folder.glob("twin??*")) if first <= number_of(twin) <= last
            and (twin / "both" / "result.json").exists()]


def number_of(twin):
    return int(twin.name.removeprefix("twin"))


def truth_of(twin):
    """Number and true parameters of a finished powder, as dem_twins.py draws them."""
    draw = random.Random(number_of(twin))
    ranges = json.loads((twin / "both.json").read_text())["parameters"]
    return number_of(twin), {k: draw.uniform(r["min"], r["max"]) for k, r in ranges.items()}


def device(plate_mm):
    return {"tube_inner_diameter": "10 mm", "plate_diameter": f"{plate_mm} mm", "plate": "disc",
            "lift_velocity": "50 mm/s"}


def frame(plate_mm, height=120):
    width = 12 * plate_mm
    return {"width_px": width, "height_px": height, "pixel_size": "0.1 mm", "center_x_px": width / 2,
            "baseline_px": 110, "plate_diameter": f"{plate_mm} mm"}


def drawn_engine():
    """The spec's engine where heaps are drawn, not simulated (drawn_heap.py)."""
    here = pathlib.Path(__file__).resolve().parent
    return {"kind": "command", "templates": str(here / "deck"), "result": "heap.png",
            "command": ["/usr/bin/python3", str(here / "drawn_heap.py")]}


def run(*command):
    """What it prints; ends the bench with its message where it fails."""
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: {done.stderr}")
    return done.stdout


def credible_level(talus, campaign, truth):
    """Of the smallest joint region that holds the truth: 0.9 or less is inside the 90 % region."""
    told = run(talus, "consider", campaign, "--json", *(f"{k}={v}" for k, v in truth.items()))
    return json.loads(told)["credible_level"]


def simulated(talus, case, place):
    """The image of one heap, and the mass that falls [kg]."""
    place.with_suffix(".json").write_text(json.dumps(case))
    run(talus, "simulate", place.with_suffix(".json"), "--out", place)
    return place / "profile.png", json.loads((place / "result.json").read_text())["observables"]["mass_fallen_kg"]


def mean_heap(talus, folder, case, plate_mm, seed, runs, diameter, heap=simulated):
    """A heap's entry of `experiments`, its mean image, and the mass that falls with its standard error [kg]. `case`
    has powder and contact models; one grain of this diameter [mm] is the least error of a mass. `heap` makes one
    (`simulated`)."""
    images, masses = [], []
    for i in range(runs):
        place = folder / f"plate{plate_mm}_run{i + 1}"
        place.mkdir(parents=True, exist_ok=True)
        image, mass = heap(
            talus, {"device": device(plate_mm), **case, "frame": frame(plate_mm), "seed": seed + i}, place)
        images.append(numpy.asarray(Image.open(image), dtype=float))
        masses.append(mass)
    name = f"plate{plate_mm}.png"
    Image.fromarray(numpy.rint(numpy.mean(images, axis=0)).astype("uint8")).save(folder / name)
    grain = case["powder"]["material"]["density"] * math.pi / 6 * (1e-3 * diameter) ** 3
    error = max(numpy.std(masses, ddof=1), grain) / runs**0.5
    entry = {"map": name, "map_heaps": runs, "plate_diameter": f"{plate_mm} mm", "frame": frame(plate_mm)}
    return entry, {"value": f"{numpy.mean(masses)} kg", "sd": f"{error} kg"}
