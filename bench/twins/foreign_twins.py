#!/usr/bin/python3
"""foreign_twins.py TALUS FOLDER [--first N] [--last N] [--core-time S]: do predictions hold of powders that obey another
law?

True powders that no set of the campaigns' law can be, by turns:

  constant  constant rolling torque
  epsd2     EPSD2: the tangential spring's stiffness, no dashpot
  sizes     EPSD, grains of log-normal sizes, a standard deviation of a quarter, of the same mean volume

Each has sliding and rolling friction drawn at random in the searched ranges. Three heaps on a plate of 10 mm, and three on
one of 30 mm, are the experiments: the mean image, the mass that falls and the angle of repose (the triangle of equal area),
with the standard errors of three runs. Campaigns with both, of EPSD spheres of one size, at scale factors 1.4 and 1:

  fixed     the model error as it stands by default
  learnt    of the same trials, a model error that is learnt; its half-normal prior has the default for its scale
  vague     the same, with a scale of 3

Then each test is held out, and the other one predicts its two numbers. One line a powder and campaign: each number
predicted (90 %) and as it was measured; then the share of predictions that hold it.
"""
import json
import math
import random

import numpy

from twin import EPSD, MATERIAL, RANGES, arguments, device, mean_heap, run, simulated

DIAMETER = 0.7  # [mm]
MASS = "1.6 g"
SIGMA = 0.25  # of ln d
LAWS = ["constant", "epsd2", "sizes"]
PLATES = {"heap": 10, "wide plate": 30}  # [mm]
ANGLE = "angle_of_repose_triangle"
POSTERIORS = {"fixed": {}, "learnt": {"learn_model_error": True}, "vague": {"model_error": 3, "learn_model_error": True}}


def true_powder(law, truth):
    sizes = {"kind": "mono", "diameter": f"{DIAMETER} mm"}
    if law == "sizes":  # the mean of d³ is median³ exp(4.5 σ²)
        sizes = {"kind": "log_normal", "median": f"{DIAMETER * math.exp(-1.5 * SIGMA**2)} mm", "sigma": SIGMA}
    return {"material": {**MATERIAL, **truth}, "sizes": sizes, "mass": MASS}


def measure(options, folder, name, law, truth, seed):
    """An experiment: mean image, mass fallen and angle of repose of three runs."""
    models = {**EPSD, "rolling": law} if law != "sizes" else EPSD
    case = {"powder": true_powder(law, truth), "models": models}
    angles = []

    def with_angle(talus, one, place):
        told = simulated(talus, one, place)
        angles.append(json.loads((place / "result.json").read_text())["observables"][f"{ANGLE}_deg"])
        return told

    image, mass = mean_heap(options.talus, folder, case, PLATES[name], seed, 3, DIAMETER, with_angle)
    angle = {"value": f"{numpy.mean(angles)} deg", "sd": f"{max(numpy.std(angles, ddof=1), 0.5) / 3**0.5} deg"}
    return {"name": name, **image, "device": device(PLATES[name]), "mass_fallen": mass, ANGLE: angle}


def calibrate(options, folder, name, experiments, seed):
    spec = {"experiments": experiments, "device": device(10), "models": EPSD, "seed": seed, "workers": 1,
            "powder": {"material": MATERIAL, "sizes": {"kind": "mono", "diameter": f"{DIAMETER} mm"}, "mass": MASS},
            "coarse_graining": {"scale_factors": [1.4, 1]}, "posterior": POSTERIORS[name],
            "parameters": {k: {"min": a, "max": b} for k, (a, b) in RANGES.items()},
            "budget": {"core_time": f"{options.core_time} s"} if name == "fixed" else {"simulations": 1},
            "confirm": {"candidates": 0}, "next": {"share": 0}}
    (folder / f"{name}.json").write_text(json.dumps(spec))
    reuse = [] if name == "fixed" else ["--reuse", folder / "fixed"]
    run(options.talus, "calibrate", folder / f"{name}.json", *reuse, "--out", folder / name, "--quiet")
    return folder / name


def predictions(options, campaign):
    """Test, number, its 90 % range and what was measured, of each number of each test held out."""
    for test in PLATES:
        told = json.loads(run(options.talus, "consider", campaign, "--hold-out", test, "--json"))
        for n in told["numbers"]:
            yield test, n["name"], n["predicted_low"], n["predicted_high"], n["measured"]


def main():
    options = arguments(powders=21, core_time=60).parse_args()
    held = {name: [] for name in POSTERIORS}
    for twin in range(options.first, options.last + 1):
        draw = random.Random(twin)
        truth = {k: draw.uniform(a, b) for k, (a, b) in RANGES.items()}
        law = LAWS[twin % len(LAWS)]
        folder = options.folder / f"twin{twin:02}"
        experiments = [measure(options, folder, name, law, truth, 1000 * twin + 500 * i) for i, name in enumerate(PLATES)]
        for name in POSTERIORS:
            told = list(predictions(options, calibrate(options, folder, name, experiments, twin)))
            held[name] += [low <= measured <= high for *_, low, high, measured in told]
            print(f"twin {twin} {law} {name}: " + "; ".join(
                f"{test} {number} {low:.3g} … {high:.3g}, measured {measured:.3g}{'' if low <= measured <= high else ' (out)'}"
                for test, number, low, high, measured in told), flush=True)
    for name, inside in held.items():
        print(f"{name}: {sum(inside)} of {len(inside)} predictions hold what was measured")


main()
