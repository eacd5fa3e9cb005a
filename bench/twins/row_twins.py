#!/usr/bin/python3
"""row_twins.py TALUS FOLDER [--first N] [--last N]: do two campaigns in a row find what one campaign of both tests
finds?

FOLDER is that of dem_twins.py. For each of its powders from --first to --last, or all, the campaign with the heap alone
comes first; the second has the wide plate alone, with the first one's posterior as prior and the rest of the joint
campaign's budget. It is compared with the campaign of both tests. The yardstick is the joint campaign once more, of the
same measurements with another seed: no campaign in a row can be nearer than that. One line a powder: the distance of
the two recommended sets in half ranges of the joint campaign, the larger one of the parameters, the volume of the joint
90 % region over the joint campaign's, and the credible level of the truth; of the second campaign, then of the joint
one once more.
"""
import json
import math

from twin import arguments, credible_level, finished, run, truth_of

NEAR = 1  # half ranges: half of a range
FACTOR = 1.5
OTHER_SEED = 1_000_000


def calibrate(options, twin, name, spec):
    (twin / f"{name}.json").write_text(json.dumps(spec))
    if not (twin / name / "result.json").exists():
        run(options.talus, "calibrate", twin / f"{name}.json", "--out", twin / name, "--quiet")
    return json.loads((twin / name / "result.json").read_text())


def second(options, twin):
    """The wide plate alone, after the heap."""
    spec = json.loads((twin / "both.json").read_text())
    first = json.loads((twin / "heap.json").read_text())
    spec["experiments"] = spec["experiments"][1:]
    spec["parameters"]["prior"] = {"from": "heap"}
    if "simulations" in spec["budget"]:
        spec["budget"]["simulations"] -= first["budget"]["simulations"]
    return calibrate(options, twin, "second", spec)


def again(options, twin):
    """Both tests with another seed."""
    spec = json.loads((twin / "both.json").read_text())
    spec["seed"] += OTHER_SEED
    return calibrate(options, twin, "again", spec)


def compare(there, joint):
    """Half ranges between the recommended sets, and the volume over the joint one."""
    apart = max(abs(p["value"] - q["value"]) / ((q["credible_90_high"] - q["credible_90_low"]) / 2)
                for p, q in zip(there["parameters"], joint["parameters"]))
    return apart, there["posterior"]["region_90_volume_fraction"] / joint["posterior"]["region_90_volume_fraction"]


def summary(name, rows):
    near = sum(apart <= NEAR for apart, _, _ in rows)
    alike = sum(1 / FACTOR <= volume <= FACTOR for _, volume, _ in rows)
    mean = math.exp(sum(math.log(volume) for _, volume, _ in rows) / len(rows))
    print(f"{name}, {len(rows)} powders: within half of a range in {near}, volume within a factor {FACTOR} in {alike}, "
          f"its geometric mean {mean:.2f}, truth inside in {sum(level <= 0.9 for _, _, level in rows)}")


def main():
    options = arguments(powders=math.inf).parse_args()
    rows = {"second": [], "again": []}
    for twin in finished(options.folder, options.first, options.last):
        _, truth = truth_of(twin)
        joint = json.loads((twin / "both" / "result.json").read_text())
        for campaign in (second, again):
            apart, volume = compare(campaign(options, twin), joint)
            level = credible_level(options.talus, twin / campaign.__name__, truth)
            rows[campaign.__name__].append((apart, volume, level))
            print(f"{twin.name} {campaign.__name__}: {apart:.2f} half ranges apart, volume {volume:.2f} of the joint one, "
                  f"truth at {level:.3f}", flush=True)
    summary("In a row", rows["second"])
    summary("The joint campaign once more", rows["again"])


main()
