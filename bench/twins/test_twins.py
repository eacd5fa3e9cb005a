#!/usr/bin/python3
"""test_twins.py TALUS FOLDER [--first N] [--last N] [--core-time S] [--next-time S] [--runs N] [--diameter MM]
[--mass G] [--tests A,B,…]: which test beside the heap narrows what, of virtual powders whose true parameters are known.

Each powder is poured, with DMT adhesion; μ_t and μ_r are drawn at random in the searched ranges, γ over two decades. --runs
runs of each test at true grain size, with seeds of their own, are its experiment: images of heaps, the tests' usual
numbers with the standard error of the runs, or that of a careful laboratory where it is larger. Campaigns of the same core
time: the heap alone, and the heap with one of

  bulk density   the same heap's, weighed in the tube
  wide plate     image of the heap on 30 mm and the mass fallen
  orifice        rate through an orifice of seven grains, or that nothing flows
  shear cell     angle of internal friction and cohesion at 1, 2 and 4 kPa
  drum           angle of a drum of 20 mm at 20 rpm

One line a powder and campaign: the credible level of the truth (0.9 or less is inside the joint 90 % region), the widths of the
joint 90 % ranges in shares of the searched ones, what `talus next` expected of the test after the heap alone, and the
realised over the expected width, as the geometric mean of the parameters. Then the means over all powders. What is in
FOLDER is not made twice.
"""
import json
import math
import random

import numpy
from PIL import Image

from twin import arguments, credible_level, device, frame, run

RANGES = {"sliding_friction": (0.1, 0.9), "rolling_friction": (0.02, 0.5), "surface_energy": (2e-4, 2e-2)}
MATERIAL = {"density": 4386, "youngs_modulus": "26.25 MPa", "poisson_ratio": 0.342, "restitution": 0.7,
            "rolling_damping": 0.3}
MODELS = {"adhesion": "dmt", "rolling": "epsd", "full_mobilisation_damping": 0}
LEVELS = [1.4, 1]


def tests_of(options):
    """Keys of each test's experiment, its frame, and its numbers: key, ending in results, usual error (share, absolute)."""
    d = options.diameter
    grain = MATERIAL["density"] * math.pi / 6 * (1e-3 * d) ** 3  # [kg]: no balance of a few grains knows less
    pour = {"kind": "pour"}
    heap = {"device": device(10), "filling": pour}
    return {
        "heap": (heap, 10, []),
        "bulk density": (heap, 10, [("bulk_density", "_kg_per_m3", 0.01, 0)]),
        "wide plate": ({"device": device(30), "filling": pour}, 30, [("mass_fallen", "_kg", 0.02, grain)]),
        "orifice": ({"rig": {"kind": "orifice_flow", "diameter": f"{20 * d} mm", "orifice": f"{7 * d} mm"},
                     "filling": pour}, None, [("discharge_rate", "_kg_per_s", 0.02, 1e-5)]),
        "shear cell": ({"rig": {"kind": "shear_cell", "diameter": f"{18 * d} mm", "speed": "30 mm/s", "travel": f"{18 * d} mm"},
                        "filling": {"kind": "dense"}, "mass": f"{cell_mass(d)} g"},
                       None, [("internal_friction_angle", "_deg", 0, 1), ("cohesion", "_pa", 0, 50)]),
        "drum": ({"rig": {"kind": "drum", "diameter": "20 mm", "width": f"{10 * d} mm", "speed": "20 rpm", "fill": 0.4},
                  "filling": {"kind": "dense"}}, None, [("angle", "_deg", 0, 1)]),
    }


def cell_mass(d):
    """[g] of a bed 18 grains across and 10.5 high: seven at the coarser level."""
    return round(0.55 * MATERIAL["density"] * math.pi / 4 * (18 * d) ** 2 * 10.5 * d * 1e-6, 4)


def powder(options, truth=None):
    return {"material": {**MATERIAL, **(truth or {})}, "sizes": {"kind": "mono", "diameter": f"{options.diameter} mm"},
            "mass": f"{options.mass} g"}


def simulate(options, folder, name, keys, plate_mm, truth, seed):
    case = {"powder": powder(options, truth), "models": MODELS, "seed": seed,
            **{k: v for k, v in keys.items() if k != "mass"}}
    if "mass" in keys:
        case["powder"]["mass"] = keys["mass"]
    if "fill" in keys.get("rig", {}):
        del case["powder"]["mass"]
    if plate_mm:
        case["frame"] = frame(plate_mm)
    place = folder / name
    place.parent.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.json").write_text(json.dumps(case))
    if not (place / "result.json").exists():
        run(options.talus, "simulate", folder / f"{name}.json", "--out", place)
    return place


def measure(options, folder, name, test, truth, seed):
    """The experiment: the mean image of the runs, their numbers with errors."""
    keys, plate_mm, numbers = test
    word = "heap" if plate_mm == 10 else name.replace(" ", "_")
    places = [simulate(options, folder, f"{word}_run{i + 1}", keys, plate_mm, truth, seed + i)
              for i in range(options.runs)]
    entry = {"name": name, **keys}
    if plate_mm:
        images = [numpy.asarray(Image.open(p / "profile.png"), dtype=float) for p in places]
        Image.fromarray(numpy.rint(numpy.mean(images, axis=0)).astype("uint8")).save(folder / f"{word}.png")
        entry |= {"map": f"{word}.png", "map_heaps": options.runs, "plate_diameter": f"{plate_mm} mm",
                  "frame": frame(plate_mm)}
    results = [json.loads((p / "result.json").read_text())["observables"] for p in places]
    for key, ending, share, least in numbers:
        values = [r[key + ending] for r in results if key + ending in r]
        if not values:
            continue
        mean = float(numpy.mean(values))
        if mean < 0:
            continue  # a lump that slides has no angle of its own
        scatter = numpy.std(values, ddof=1) / len(values) ** 0.5 if len(values) > 1 else 0
        degrees = math.pi / 180 if ending == "_deg" else 1  # a bare number is in SI
        entry[key] = {"value": degrees * mean, "sd": degrees * max(float(scatter), share * abs(mean), least)}
    return entry


def is_measured(experiment, numbers):
    return "map" in experiment or any(key in experiment for key, *_ in numbers)


def calibrate(options, folder, name, experiments, seed, truth):
    """Widths of the joint 90 % ranges in shares of the searched, and the level of the truth; None, None where the time
    bought too few trials of true grains for a posterior."""
    spec = {"experiments": experiments, "powder": powder(options), "device": device(10), "models": MODELS,
            "coarse_graining": {"scale_factors": LEVELS}, "seed": seed, "workers": 1,
            "parameters": {k: {"min": a, "max": b, **({"scale": "log"} if k == "surface_energy" else {})}
                           for k, (a, b) in RANGES.items()},
            "budget": {"core_time": f"{options.core_time} s"}, "confirm": {"candidates": 0}, "next": {"share": 0}}
    out = folder / name.replace(" ", "_")
    (folder / f"{out.name}.json").write_text(json.dumps(spec))
    if not (out / "result.json").exists():
        run(options.talus, "calibrate", folder / f"{out.name}.json", "--out", out, "--quiet")
    level = credible_level(options.talus, out, truth)
    if level is None:
        return None, None
    widths = {}
    for p in json.loads((out / "result.json").read_text())["parameters"]:
        low, high = RANGES[p["name"]]
        far = math.log(high / low) if p["name"] == "surface_energy" else high - low
        ends = (p["credible_90_low"], p["credible_90_high"])
        widths[p["name"]] = (math.log(ends[1] / ends[0]) if p["name"] == "surface_energy" else ends[1] - ends[0]) / far
    return widths, level


def expected(options, folder, tests):
    """What the heap alone expects each test to leave."""
    asks = []
    for name, (experiment, numbers) in tests.items():
        ask = {k: v for k, v in experiment.items() if k in ("name", "rig", "device", "filling")}
        ask |= {key: {"sd": experiment[key]["sd"]} for key, *_ in numbers if key in experiment}
        if "map" in experiment:
            ask |= {"runs": experiment["map_heaps"]}
        asks.append(ask)
    (folder / "candidates.json").write_text(json.dumps({"candidates": asks}))
    table = folder / "heap" / "next" / "next.json"
    if not table.exists():
        run(options.talus, "next", folder / "heap", folder / "candidates.json", "--simulate", "--budget",
            f"{options.next_time} s")
    return {c["name"]: c["width_90"] for c in json.loads(table.read_text())["candidates"] if c["bits"] is not None}


def line(widths):
    return ", ".join(f"{k} {v:.3f}" for k, v in widths.items())


def told(widths, level):
    return "no posterior" if level is None else f"level {level:.3f}; {line(widths)}"


def main():
    parser = arguments(powders=10, core_time=240)
    parser.add_argument("--next-time", type=float, default=600)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--diameter", type=float, default=0.7, metavar="MM")
    parser.add_argument("--mass", type=float, default=1.6, metavar="G")
    parser.add_argument("--tests", default="bulk density,wide plate,orifice,shear cell,drum")
    options = parser.parse_args()
    known = tests_of(options)
    tallies = {}
    for twin in range(options.first, options.last + 1):
        draw = random.Random(twin)
        truth = {k: draw.uniform(a, b) if k != "surface_energy" else a * (b / a) ** draw.random()
                 for k, (a, b) in RANGES.items()}
        folder = options.folder / f"twin{twin:02}"
        wanted = options.tests.split(",")
        seeds = {name: 1000 * twin + 100 * i for i, name in enumerate(["heap", *wanted])}
        seeds["bulk density"] = seeds["heap"]  # the same runs
        measured = {name: measure(options, folder, name, known[name], truth, seeds[name])
                    for name in ["heap", *wanted]}
        print(f"twin {twin} truth " + ", ".join(f"{k} {v:.4g}" for k, v in truth.items()), flush=True)
        widths, level = calibrate(options, folder, "heap", [measured["heap"]], twin, truth)
        tallies.setdefault("heap", []).append((widths, level, None))
        print(f"  heap alone: {told(widths, level)}", flush=True)
        # The heap's own bulk density is a number of the heap, which `next` does not simulate anew.
        asked = {name: (measured[name], known[name][2]) for name in wanted if name != "bulk density"}
        foreseen = expected(options, folder, asked) if asked else {}
        for name in wanted:
            if not is_measured(measured[name], known[name][2]):
                print(f"  with {name}: nothing to be measured", flush=True)
                continue
            own = name == "bulk density"
            experiments = [{**measured[name], "name": "heap"}] if own else [measured["heap"], measured[name]]
            widths, level = calibrate(options, folder, f"with {name}", experiments, twin, truth)
            after = foreseen.get(name) if widths else None
            ratio = math.prod(widths[k] / after[k] for k in after) ** (1 / len(after)) if after else None
            tallies.setdefault(name, []).append((widths, level, ratio))
            print(f"  with {name}: {told(widths, level)}"
                  + (f"; expected {line(after)}; ratio {ratio:.2f}" if after else ""), flush=True)
    for name, campaigns in tallies.items():
        all_of_them = [c for c in campaigns if c[1] is not None]
        if not all_of_them:
            print(f"{name}: no posterior in {len(campaigns)}")
            continue
        means = {k: float(numpy.mean([w[k] for w, *_ in all_of_them])) for k in RANGES}
        ratios = [r for *_, r in all_of_them if r]
        print(f"{name}: covered {sum(level <= 0.9 for _, level, _ in all_of_them)} of {len(all_of_them)}; mean widths {line(means)}"
              + (f"; within a factor 1.5 of the expected in {sum(1 / 1.5 <= r <= 1.5 for r in ratios)} of {len(ratios)}"
                 if ratios else ""))


main()
