#!/usr/bin/python3
"""next_twins.py TALUS FOLDER: does a further test leave the ranges that `talus next` expects of it?

FOLDER is that of dem_twins.py. For each of its powders the campaign with the heap alone is asked what the
wide plate would teach, and the campaign with both tests, which spent the same core time, tells what it taught.
One line a powder: whether the wide plate ranks above more runs of the heap, the expected and the realised
widths of the joint 90 % ranges, in shares of the searched ones, and the realised over the expected width, as
the geometric mean of both parameters. What is expected is the mean over the sets that the posterior holds, and what
one of them leaves may be far from it: the last line compares the sums over all powders.
"""
import json
import math
import subprocess
import sys

from twin import arguments, finished

WITHIN = 1.5


def expected(talus, twin):
    """Widths that the wide plate is expected to leave, and whether it ranks above more runs."""
    tests = json.loads((twin / "both.json").read_text())["experiments"]
    wide = tests[1]
    ask = {"name": wide["name"], "device": wide["device"], "runs": wide["map_heaps"],
           "mass_fallen": {"sd": wide["mass_fallen"]["sd"]}}
    (twin / "candidates.json").write_text(json.dumps({"candidates": [ask]}))
    done = subprocess.run([talus, "next", str(twin / "heap"), str(twin / "candidates.json"), "--simulate", "--json"],
                          capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{twin}: {done.stderr}")
    table = json.loads(done.stdout)["candidates"]
    order = [c["name"] if c["kind"] == "test" else c["kind"] for c in table if c["bits"] is not None]
    width = next(c["width_90"] for c in table if c["name"] == wide["name"])
    return width, order.index(wide["name"]) < order.index("more_runs")


def realised(twin):
    spec = json.loads((twin / "both.json").read_text())["parameters"]
    widths = {}
    for p in json.loads((twin / "both" / "result.json").read_text())["parameters"]:
        searched = spec[p["name"]]["max"] - spec[p["name"]]["min"]
        widths[p["name"]] = (p["credible_90_high"] - p["credible_90_low"]) / searched
    return widths


def main():
    options = arguments().parse_args()
    ratios, first, sums = [], 0, {}
    for twin in finished(options.folder):
        after, above = expected(options.talus, twin)
        is_now = realised(twin)
        ratio = math.prod(is_now[k] / after[k] for k in after) ** (1 / len(after))
        ratios.append(ratio)
        for k in after:
            sums.setdefault(k, [0, 0])
            sums[k][0] += after[k]
            sums[k][1] += is_now[k]
        first += above
        print(f"{twin.name}: {'above' if above else 'below'} more runs; expected "
              + ", ".join(f"{k} {v:.3f}" for k, v in after.items()) + "; realised "
              + ", ".join(f"{k} {is_now[k]:.3f}" for k in after) + f"; ratio {ratio:.2f}", flush=True)
    within = sum(1 / WITHIN <= r <= WITHIN for r in ratios)
    mean = math.exp(sum(map(math.log, ratios)) / len(ratios))
    print(f"{len(ratios)} powders: above more runs in {first}, within a factor {WITHIN} in {within}, "
          f"geometric mean of the ratios {mean:.2f}; realised over expected, sums over all powders: "
          + ", ".join(f"{k} {now / then:.2f}" for k, (then, now) in sums.items()))


main()
