#!/usr/bin/python3
"""dem_twins.py TALUS FOLDER [--first N] [--last N] [--core-time S] [--parameters 2|3] [--runs N]
[--diameter MM] [--mass G] [--model-error E] [--campaigns A,B,…] [--other-plate] [--unknown] [--drawn N]: calibrates
virtual powders whose true parameters are known.

Each powder has sliding and rolling friction, with --parameters 3 surface energy (JKR), too, drawn at random in the
searched ranges. Three heaps of it, or --runs, are simulated at true grain size with seeds of their own, and so are as
many on a plate of 30 mm where a campaign wants them; their mean images and the mass that falls are the experiments.
Campaigns of the same core time:

  heap          the heap alone, at scale factors 1.4 and 1
  both          both tests
  single        the heap alone, at scale factor 1 only
  extrapolated  the heap alone at 3, 2 and 1.5, what is wanted at 1 (--diameter 0.33: ten grains across at 3)
  smallest      the heap alone at 1.5, the smallest of these
  nuisances     both tests, restitution, rolling damping and the plate pair's friction searched as nuisances
  typical       both tests, these three fixed in the middle of their ranges

One line a powder and campaign: the credible level of the truth (0.9 or less is inside the joint 90 % region), the
region's share of what is searched, the distance of the recommended set in widths of the ranges, and the alarms.

--model-error is the campaigns' posterior.model_error (1); 0 is true of these powders, as one engine made all heaps.

--drawn draws heaps by a formula (drawn_heap.py) in place of simulating them: N of them a campaign and test, at true
size, 0.1 s each with all that goes on round it. For what asks how campaigns hang together, not for grains.

--other-plate gives the real wide plate a friction of its own that the campaigns know nothing of: those with
both tests should raise an alarm, and only they run.

--unknown draws restitution, rolling damping and the friction between powder and plate at random, too, in the ranges that
the campaigns `nuisances` and `typical` know them by. With it a campaign of another name takes the usual values for them.
"""
import json
import random

import numpy

from drawn_heap import draw
from twin import EPSD, MATERIAL, RANGES, arguments, credible_level, device, drawn_engine, mean_heap, run, simulated

SURFACE_ENERGY = (2e-3, 20e-3)  # [J/m^2]: granular Bond numbers 0.2 to 2
UNKNOWN = {"restitution": (0.3, 0.95), "rolling_damping": (0.05, 0.6), "plate_pair_sliding_friction": (0.1, 0.9)}
LEVELS = {"heap": {"scale_factors": [1.4, 1]}, "both": {"scale_factors": [1.4, 1]}, "single": {"scale_factors": [1]},
          "extrapolated": {"scale_factors": [3, 2, 1.5], "target": 1}, "smallest": {"scale_factors": [1.5]},
          "nuisances": {"scale_factors": [1.4, 1]}, "typical": {"scale_factors": [1.4, 1]}}
BOTH_TESTS = ("both", "nuisances", "typical")
POWDER = {"material": MATERIAL, "sizes": {"kind": "mono"}}
MODELS = dict(EPSD)


def drawn(_, case, place):
    """As `simulated`, of a heap that is drawn."""
    material = case["powder"]["material"]
    plate = case["device"].get("plate_material", {}).get("sliding_friction", material["sliding_friction"])
    mass = float(case["powder"]["mass"].removesuffix(" g"))
    draw({"surface_energy": 0, **{k: v for k, v in material.items() if not isinstance(v, str)}, "plate_friction": plate,
          "plate_diameter": case["frame"]["width_px"] * 1e-4 / 1.2, "mass": 1e-3 * mass, "scale_factor": 1,
          "seed": case["seed"]}, place)
    return place / "heap.png", json.loads((place / "scalars.json").read_text())["mass_fallen_kg"]


def with_values(values):
    """Powder and pairs of a case or spec that have these values of parameters."""
    pair = values.get("plate_pair_sliding_friction")
    material = {k: v for k, v in values.items() if k != "plate_pair_sliding_friction"}
    return {"powder": {**POWDER, "material": {**MATERIAL, **material}},
            **({"pairs": [{"between": ["powder", "plate"], "sliding_friction": pair}]} if pair else {})}


def measure(options, folder, truth, plate_mm, seed, plate=None):
    """The mean image of so many heaps, and the mass that falls with its standard error [kg]."""
    case = {**with_values(truth), "models": MODELS}
    if plate:
        case["device"] = {**device(plate_mm), "plate_material": plate}
    return mean_heap(options.talus, folder, case, plate_mm, seed, options.runs, options.diameter,
                     drawn if options.drawn else simulated)


def calibrate(options, folder, name, experiments, seed, truth):
    spec = {"experiments": experiments, "powder": POWDER, "device": device(10), "models": MODELS,
            "coarse_graining": LEVELS[name], "seed": seed, "workers": 1,
            "parameters": {k: {"min": a, "max": b} for k, (a, b) in RANGES.items()},
            "budget": {"core_time": f"{options.core_time} s"}, "confirm": {"candidates": 0},
            "next": {"share": 0}, "posterior": {"model_error": options.model_error}}
    if name == "nuisances":
        spec["parameters"] |= {k: {"min": a, "max": b, "nuisance": True} for k, (a, b) in UNKNOWN.items()}
    if name == "typical":
        spec |= with_values({k: (a + b) / 2 for k, (a, b) in UNKNOWN.items()})
    if options.drawn:
        spec |= {"engine": drawn_engine(), "coarse_graining": {"scale_factor": 1},
                 "budget": {"simulations": options.drawn * len(experiments)}}
    (folder / f"{name}.json").write_text(json.dumps(spec))
    run(options.talus, "calibrate", folder / f"{name}.json", "--out", folder / name, "--quiet")
    result = json.loads((folder / name / "result.json").read_text())
    off = [(p["value"] - truth[p["name"]]) / (RANGES[p["name"]][1] - RANGES[p["name"]][0])
           for p in result["parameters"] if p["name"] in RANGES]
    level = credible_level(options.talus, folder / name, truth)
    volume = result["posterior"]["region_90_volume_fraction"]
    alarms = [w["experiment"] for w in result["warnings"] if w["kind"] in ("implausible", "disagree")]
    return {"level": level, "volume": volume, "distance": float(numpy.linalg.norm(off)), "alarms": alarms}


def main():
    parser = arguments(powders=20, core_time=60)
    parser.add_argument("--parameters", type=int, choices=[2, 3], default=2)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--diameter", type=float, default=0.7, metavar="MM")
    parser.add_argument("--mass", type=float, default=1.6, metavar="G")
    parser.add_argument("--model-error", type=float, default=1, metavar="E")
    parser.add_argument("--campaigns", default="heap,both")
    parser.add_argument("--other-plate", action="store_true")
    parser.add_argument("--unknown", action="store_true")
    parser.add_argument("--drawn", type=int, metavar="N")
    options = parser.parse_args()
    wanted = ["both"] if options.other_plate else options.campaigns.split(",")
    if options.parameters == 3:
        RANGES["surface_energy"] = SURFACE_ENERGY
        MODELS["adhesion"] = "jkr"
    POWDER["sizes"]["diameter"] = f"{options.diameter} mm"
    POWDER["mass"] = f"{options.mass} g"
    tallies = {}
    for twin in range(options.first, options.last + 1):
        draw = random.Random(twin)
        truth = {k: draw.uniform(a, b) for k, (a, b) in RANGES.items()}
        folder = options.folder / f"twin{twin:02}"
        hidden = {k: draw.uniform(a, b) for k, (a, b) in UNKNOWN.items()} if options.unknown else {}
        plate = {"sliding_friction": 0.15, "rolling_friction": 0.02} if options.other_plate else None
        heap, _ = measure(options, folder, truth | hidden, 10, 1000 * twin)
        experiments = [{"name": "heap", **heap}]
        if set(BOTH_TESTS) & set(wanted):
            wide, fallen = measure(options, folder, truth | hidden, 30, 1000 * twin + 500, plate)
            experiments.append({"name": "wide plate", **wide, "device": device(30), "mass_fallen": fallen})
        for name in wanted:
            tests = experiments if name in BOTH_TESTS else experiments[:1]
            done = calibrate(options, folder, name, tests, twin, truth)
            tallies.setdefault(name, []).append(done)
            print(f"twin {twin} truth " + " ".join(f"{v:.3g}" for v in truth.values()) +
                  f" {name}: level {done['level']:.3f}, volume {done['volume']:.4f}, "
                  f"distance {done['distance']:.3f}, alarms {done['alarms']}", flush=True)
    for name, all_of_them in tallies.items():
        print(f"{name}: covered {sum(d['level'] <= 0.9 for d in all_of_them)} of {len(all_of_them)}, "
              f"mean volume {numpy.mean([d['volume'] for d in all_of_them]):.4f}, "
              f"mean distance {numpy.mean([d['distance'] for d in all_of_them]):.3f}, "
              f"with an alarm {sum(bool(d['alarms']) for d in all_of_them)}")


main()
