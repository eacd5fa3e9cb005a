#!/usr/bin/python3
"""sensitivity_formulas.py TALUS FOLDER [--first N] [--last N]: is `talus sensitivity` right where a set fits, whatever is moved?

Virtual powders often have none: with another restitution no set of frictions meets all that was measured. Here two formulas stand
in for simulations, each an angle that depends on both frictions and on the restitution, with a noise of 0.6°. Powders are
drawn at random among those that some set fits with a restitution of 0.6 as well as with 0.9. A campaign with 0.9 is asked what 0.6 would move
its answer to; a campaign with 0.6 finds its own.

One line a powder: each parameter as the first campaign has it, as foretold, as found and as the formulas have it. The last line
has how many powders are foretold within a factor of 1.5 of what the second campaign finds, by the shifts in half ranges (both below a quarter
count), how many answers lie in the ranges foretold, and the mean distance of foretold from found and from the truth. 10 s of a core a powder.
"""
import argparse
import json
import math
import pathlib
import random
import subprocess

DECK = """import json, math, random
sliding, rolling, restitution = {{ sliding_friction }}, {{ rolling_friction }}, {{ restitution }}
kind = "{{ rig_kind }}"  # the formulas need no {{ mass }}
ANGLES
angle = (tilting if kind == "tilting_box" else draw_down)(sliding, rolling, restitution)
json.dump({"angle_deg": angle + random.Random({{ seed }}).gauss(0, 0.6)}, open("scalars.json", "w"))
"""
ANGLES = """
def tilting(sliding, rolling, restitution):
    return 38 * (1 - math.exp(-sliding / 0.25)) * (0.5 + 0.5 * (1 - math.exp(-rolling / 0.12))) - 8 * (restitution - 0.5)

def draw_down(sliding, rolling, restitution):
    return 15 + 20 * sliding / (sliding + 0.3) + 22 * rolling / (rolling + 0.15) + 10 * (restitution - 0.5) * sliding
"""
exec(ANGLES)
RANGES = {"sliding_friction": (0.05, 0.9), "rolling_friction": (0.005, 0.6)}
BEFORE, MOVED = 0.9, 0.6
FACTOR, SMALL = 1.5, 0.25


def solved(angles, restitution):
    """The frictions whose angles these are: bisection over rolling friction of the sliding one that the first angle leaves."""
    def sliding_at(rolling):
        low, high = 0.01, 1.2
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if tilting(middle, rolling, restitution) < angles[0] else (low, middle)
        return low
    low, high = 0.006, 0.6
    for _ in range(60):
        middle = (low + high) / 2
        misses = draw_down(sliding_at(middle), middle, restitution) < angles[1]
        low, high = (middle, high) if misses else (low, middle)
    return sliding_at(low), low


def powder(seed):
    """Two angles, and the frictions that they are of with either restitution."""
    draw = random.Random(seed)
    while True:
        before = draw.uniform(0.15, 0.7), draw.uniform(0.05, 0.45)
        angles = tilting(*before, BEFORE), draw_down(*before, BEFORE)
        then = solved(angles, MOVED)
        meets = abs(draw_down(*then, MOVED) - angles[1]) < 1e-6 and abs(tilting(*then, MOVED) - angles[0]) < 1e-6
        if meets and 0.06 < then[0] < 0.88 and 0.01 < then[1] < 0.58:
            return angles, then


def calibrated(talus, folder, angles, restitution, seed):
    """The campaign's parameters by name."""
    (folder / "deck").mkdir(parents=True)
    (folder / "deck/run.py").write_text(DECK.replace("ANGLES", ANGLES))
    spec = {
        "experiments": [
            {"name": "tilting box", "rig": {"kind": "tilting_box"}, "angle": {"value": f"{angles[0]} deg", "sd": "0.3 deg"}},
            {"name": "draw down", "rig": {"kind": "draw_down"}, "mass": "15 g", "angle": {"value": f"{angles[1]} deg", "sd": "0.3 deg"}}],
        "powder": {"mass": "5 g", "sizes": {"kind": "mono", "diameter": "0.5 mm"},
                   "material": {"density": 2500, "youngs_modulus": "10 MPa", "restitution": restitution}},
        "engine": {"kind": "command", "templates": "deck", "command": ["python3", "run.py"]},
        "parameters": {name: {"min": low, "max": high} for name, (low, high) in RANGES.items()},
        "budget": {"simulations": 60}, "confirm": {"candidates": 1, "replicates": 1}, "next": {"share": 0}, "seed": seed}
    (folder / "spec.json").write_text(json.dumps(spec))
    run(talus, "calibrate", folder / "spec.json", "--out", folder / "out", "--quiet")
    return {p["name"]: p for p in json.loads((folder / "out/result.json").read_text())["parameters"]}


def run(*command):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{' '.join(map(str, command))}: {done.stderr}")
    return done.stdout


def is_right(foretold, found):
    if max(abs(foretold), abs(found)) < SMALL:
        return True
    return foretold * found > 0 and 1 / FACTOR <= foretold / found <= FACTOR


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split(":")[0])
    parser.add_argument("talus", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--last", type=int, default=10)
    options = parser.parse_args()
    talus = options.talus.resolve()
    right, inside, from_found, from_truth = [], [], [], []
    for seed in range(options.first, options.last + 1):
        angles, then = powder(seed)
        root = options.folder / f"powder_{seed}"
        first = calibrated(talus, root / "before", angles, BEFORE, seed)
        second = calibrated(talus, root / "moved", angles, MOVED, seed)
        told = json.loads(run(talus, "sensitivity", root / "before/out", f"restitution={MOVED}", "--json"))["moves"][0]
        powder_is_right, texts = True, []
        for answer, truth in zip(told["answer"], then):
            name = answer["parameter"]
            half = (first[name]["credible_90_high"] - first[name]["credible_90_low"]) / 2
            found = second[name]["value"]
            powder_is_right &= is_right((answer["to"] - answer["from"]) / half, (found - answer["from"]) / half)
            inside.append(answer["credible_90_low"] <= found <= answer["credible_90_high"])
            from_found.append(abs(answer["to"] - found) / half)
            from_truth.append(abs(answer["to"] - truth) / half)
            texts.append(f"{name} {answer['from']:.3f}, foretold {answer['to']:.3f}, found {found:.3f}, truth {truth:.3f}")
        right.append(powder_is_right)
        print(f"powder {seed}: {'; '.join(texts)}{'' if powder_is_right else '; apart'}", flush=True)
    print(f"{sum(right)} of {len(right)} within a factor of {FACTOR}; {sum(inside)} of {len(inside)} found in the range foretold; mean distance of "
          f"foretold from found {math.fsum(from_found) / len(from_found):.2f} half ranges, from the truth {math.fsum(from_truth) / len(from_truth):.2f}")


main()
