#!/usr/bin/python3
"""goal_twins.py TALUS FOLDER CASE OBSERVABLE [--first N] [--last N] [--campaigns N] [--heap-alone]: is a prediction
narrowed as `talus next --for` expects, and what does a campaign save that ends by it?

FOLDER is that of dem_twins.py, CASE a bulk test whose OBSERVABLE is to be predicted (examples/rigs/spreading.json
packing_fraction). For each powder from --first to --last the campaign with the heap alone is
asked what the wide plate would leave of it, and in what core time; the campaign with both tests goes on for as long (`enough`)
and tells what it left. One line a powder: half-widths of the goal now, expected and realised.
Two of them are means over few draws, so the last line compares the sums over all powders, too.

--campaigns: of the first N powders the campaign with both tests runs again with this goal, to be known to 1.2 times what the
first one left, and a line says its core time over that one's, and why it ended.

--heap-alone: only that, with the campaigns of the heap alone: of a process that goes alike along the heap's valley the goal does
not need all parameters.
"""
import json
import math
import pathlib
import shutil

from twin import arguments, finished, run

WITHIN = 1.5
SLACK = 1.2


def table(options, folder, *more):
    return json.loads(run(options.talus, "next", folder, *more, "--for", options.case, "--observable",
                          options.observable, "--json"))


def expected(options, twin):
    """The goal's half-width now, the one that the wide plate is expected to leave, and in what core time [s]."""
    wide = json.loads((twin / "both.json").read_text())["experiments"][1]
    ask = {"name": wide["name"], "device": wide["device"], "runs": wide["map_heaps"],
           "mass_fallen": {"sd": wide["mass_fallen"]["sd"]}}
    (twin / "candidates.json").write_text(json.dumps({"candidates": [ask]}))
    answer = table(options, twin / "heap", twin / "candidates.json", "--simulate")
    after = next(c for c in answer["candidates"] if c["name"] == wide["name"])
    return answer["goal"]["half_width_90"], after["goal_half_width_90"], after["core_time_s"]


def seconds(time):
    return float(time.removesuffix(" s"))


def go_on(options, twin, core_time):
    """The campaign with both tests and so much more core time [s]."""
    spec = json.loads((twin / "both.json").read_text())
    spec["budget"]["core_time"] = f"{seconds(spec['budget']['core_time']) + core_time} s"
    (twin / "enough.json").write_text(json.dumps(spec))
    shutil.rmtree(twin / "enough", ignore_errors=True)
    shutil.copytree(twin / "both", twin / "enough", ignore=shutil.ignore_patterns("predict"))
    run(options.talus, "resume", twin / "enough", "--spec", twin / "enough.json", "--quiet")


def core_hours(folder):
    return json.loads((folder / "result.json").read_text())["cost"]["core_hours"]


def with_goal(options, twin, campaign, half_width):
    """Core time of a campaign that ends by its goal, over that of the one without, and why it ended."""
    spec = json.loads((twin / f"{campaign}.json").read_text())
    spec["goal"] = {"case": str(options.case.resolve()), "observable": options.observable,
                    "half_width": f"{half_width} {options.unit}".strip()}
    place = twin / f"{campaign}_goal_{options.case.stem}"
    place.with_suffix(".json").write_text(json.dumps(spec))
    shutil.rmtree(place, ignore_errors=True)
    run(options.talus, "calibrate", place.with_suffix(".json"), "--out", place, "--quiet")
    stop = json.loads((place / "result.json").read_text())["stop"]["text"]
    share = core_hours(place) / core_hours(twin / campaign)
    print(f"{twin.name}: with the goal {share:.2f} of the core time: {stop}", flush=True)
    return share


def of_heap_alone(options):
    shares = []
    for twin in finished(options.folder, options.first, options.last):
        left = table(options, twin / "heap")["goal"]["half_width_90"]
        shares.append(with_goal(options, twin, "heap", SLACK * left))
    print(f"{len(shares)} powders: at most half of the core time in {sum(s <= 0.5 for s in shares)}, "
          f"mean {sum(shares) / len(shares):.2f}")


def main():
    parser = arguments(powders=math.inf)
    parser.add_argument("case", type=pathlib.Path)
    parser.add_argument("observable")
    parser.add_argument("--unit", default="", help="of the observable in results, such as deg")
    parser.add_argument("--campaigns", type=int, default=0, metavar="N")
    parser.add_argument("--heap-alone", action="store_true")
    options = parser.parse_args()
    if options.heap_alone:
        return of_heap_alone(options)
    rows = []
    for twin in finished(options.folder, options.first, options.last):
        now, then, core_time = expected(options, twin)
        go_on(options, twin, core_time)
        left = table(options, twin / "enough")["goal"]["half_width_90"]
        rows.append((now, then, left))
        print(f"{twin.name}: now ± {now:.3g}, expected ± {then:.3g}, realised ± {left:.3g}; ratio {left / then:.2f}",
              flush=True)
        if len(rows) <= options.campaigns:
            with_goal(options, twin, "enough", SLACK * left)
    ratios = [left / then for _, then, left in rows]
    within = sum(1 / WITHIN <= r <= WITHIN for r in ratios)
    print(f"{len(rows)} powders: within a factor {WITHIN} in {within}, geometric mean of the ratios "
          f"{math.exp(sum(map(math.log, ratios)) / len(ratios)):.2f}; sums realised over expected "
          f"{sum(r[2] for r in rows) / sum(r[1] for r in rows):.2f}")


main()
