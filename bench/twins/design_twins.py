#!/usr/bin/python3
"""design_twins.py TALUS FOLDER [--first N] [--last N] [--one-plan | --suppose]: do campaigns leave the ranges that `talus
design` expects before any test is made?

FOLDER is that of dem_twins.py. For each of its powders a plan with both tests, as long as nothing is measured, says what
they are expected to leave together; the campaign with both tests tells what they left. What a plan expects is the mean
over all sets that are searched, the same for every powder but for its seed, and what one of them leaves may be far from
it: the last lines compare the means over all powders, too, and count the ranges between what the plan says of the tenths of
the sets that leave least and most. --one-plan makes the plan of the first powder only, and holds all of them against it. --suppose asks that plan what it
expects of a powder like each of them: the true parameters are supposed (`talus design SPEC NAME=VALUE …`).
"""
import json
import math

from twin import arguments, finished, run, truth_of

WITHIN = 1.5
KEYS = ("powder", "device", "models", "coarse_graining", "parameters", "posterior", "engine", "seed")


def candidate(experiment):
    test = {"name": experiment["name"], "runs": experiment["map_heaps"], "frame": experiment["frame"]}
    if "device" in experiment:
        test["device"] = experiment["device"]
    if "mass_fallen" in experiment:
        test["mass_fallen"] = {"sd": experiment["mass_fallen"]["sd"]}
    return test


def expected(options, twin, supposed):
    """Widths of the joint 90 % ranges after both tests of this powder's plan, in shares of the searched: mean, low and
    high. Of all sets, or of one that is supposed."""
    spec = json.loads((twin / "both.json").read_text())
    plan = {k: spec[k] for k in KEYS if k in spec}
    plan["candidates"] = [candidate(e) for e in spec["experiments"]]
    (twin / "plan.json").write_text(json.dumps(plan))
    told = json.loads(run(options.talus, "design", twin / "plan.json", "--out", twin / "plan", "--json",
                         *(f"{k}={v}" for k, v in supposed.items())))
    both = next(c for c in told["choices"] if len(c["tests"]) == len(plan["candidates"]))
    return both["width_90"], both["width_90_low"], both["width_90_high"]


def realised(twin):
    spec = json.loads((twin / "both.json").read_text())["parameters"]
    return {p["name"]: (p["credible_90_high"] - p["credible_90_low"]) / (spec[p["name"]]["max"] - spec[p["name"]]["min"])
            for p in json.loads((twin / "both" / "result.json").read_text())["parameters"]}


def main():
    parser = arguments(powders=math.inf)
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--one-plan", action="store_true")
    which.add_argument("--suppose", action="store_true")
    options = parser.parse_args()
    rows = []
    then = None
    between = 0
    twins = finished(options.folder, options.first, options.last)
    for twin in twins:
        if options.suppose:
            then, low, high = expected(options, twins[0], truth_of(twin)[1])
        elif not (then and options.one_plan):
            then, low, high = expected(options, twin, {})
        now = realised(twin)
        ratio = math.prod(now[k] / then[k] for k in then) ** (1 / len(then))
        rows.append((then, now, ratio))
        between += sum(low[k] <= now[k] <= high[k] for k in then)
        print(f"{twin.name}: expected " + ", ".join(f"{k} {v:.3f}" for k, v in then.items()) + "; left "
              + ", ".join(f"{k} {now[k]:.3f}" for k in then) + f"; ratio {ratio:.2f}", flush=True)
    print(f"{between} of {sum(len(t) for t, _, _ in rows)} ranges lie between the tenths")
    within = sum(1 / WITHIN <= ratio <= WITHIN for _, _, ratio in rows)
    print(f"{len(rows)} powders: within a factor {WITHIN} in {within}; means left over means expected "
          + ", ".join(f"{k} {sum(n[k] for _, n, _ in rows) / sum(t[k] for t, _, _ in rows):.2f}" for k in rows[0][0]))


main()
