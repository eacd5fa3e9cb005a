#!/usr/bin/python3
"""sensitivity_twins.py TALUS FOLDER [--first N] [--last N] [--campaign both] [--scale-factor F]
[--replicates N]: does a campaign with another fixed value find the answer that `talus sensitivity` foretells?

FOLDER is that of dem_twins.py. Each of its campaigns is asked what a restitution of 0.6 in place of 0.9, and a
friction between powder and plate of 0.8 of what its answer has, would move the answer to. Then a campaign with that
value, the same data, seed and core time finds its own answer. A friction of the pair that is 0.8 of what the *set* makes
it cannot be fixed: the second campaign has the number that the first one's answer makes of it, and so has the move.

One line a powder and move: the shifts foretold and found of each parameter in half ranges, and whether the two are
within a factor of 1.5, or both below a quarter of the half range, which no campaign tells from its noise. Where no set
fits with the moved value the second campaign's answer is one of many that are as bad: the line says so, and what was
foretold of it. The last lines have how often the alarm (a parameter moves by more than half of its range) is right, how
many of the answers found lie in the ranges foretold, too, and the mean distance of the two, of all moves and of those with
which a set fits.
"""
import json
import math

from twin import arguments, finished, run

FACTOR = 1.5
SMALL = 0.25  # half ranges
IMPLAUSIBLE = 3  # standard deviations
ALARM = 1  # half ranges: a shift beyond is an alarm of the result


def parameters(folder):
    return {p["name"]: p for p in json.loads((folder / "result.json").read_text())["parameters"]}


def foretold(options, folder, name, value):
    extra = ["--replicates", options.replicates]
    if options.scale_factor:
        extra += ["--scale-factor", options.scale_factor]
    return json.loads(run(options.talus, "sensitivity", folder, f"{name}={value}", *extra, "--json"))["moves"][0]


def found(options, twin, name, value, now):
    """The same of a campaign with this value."""
    spec = json.loads((twin / f"{options.campaign}.json").read_text())
    if name == "restitution":
        spec["powder"]["material"]["restitution"] = value
    else:
        spec["pairs"] = [{"between": ["powder", "plate"], "sliding_friction": value}]
    place = twin / f"{options.campaign}_{name}"
    place.with_suffix(".json").write_text(json.dumps(spec))
    if not (place / "result.json").exists():
        run(options.talus, "calibrate", place.with_suffix(".json"), "--out", place, "--quiet")
    then = parameters(place)
    return {k: (then[k]["value"], (then[k]["value"] - p["value"]) / ((p["credible_90_high"] - p["credible_90_low"]) / 2))
            for k, p in now.items()}


def fits(place):
    warnings = json.loads((place / "result.json").read_text())["warnings"]
    return not {"implausible", "disagree", "misses"} & {w["kind"] for w in warnings}


def is_right(a, b):
    return max(abs(a), abs(b)) < SMALL or (a * b > 0 and 1 / FACTOR <= a / b <= FACTOR)


def is_alarm(shifts):
    return max(map(abs, shifts)) > ALARM


def main():
    parser = arguments(powders=math.inf)
    parser.add_argument("--campaign", default="both")
    parser.add_argument("--scale-factor", type=float)
    parser.add_argument("--replicates", type=int, default=16)
    options = parser.parse_args()
    rows = []
    for twin in finished(options.folder, options.first, options.last):
        first = twin / options.campaign
        now = parameters(first)
        moves = {"restitution": 0.6,
                 "plate_pair_sliding_friction": round(0.8 * now["sliding_friction"]["value"], 6)}
        for name, value in moves.items():
            told = foretold(options, first, name, value)
            answer = {a["parameter"]: a for a in told["answer"]}
            is_found = found(options, twin, name, value, now)
            shift = {k: answer[k]["shift_in_half_ranges"] for k in now}
            rows.append({"right": all(is_right(shift[k], is_found[k][1]) for k in now),
                         "inside": [answer[k]["credible_90_low"] <= is_found[k][0] <= answer[k]["credible_90_high"] for k in now],
                         "alarm": is_alarm(shift.values()) == is_alarm(there for _, there in is_found.values()),
                         "distance": [abs(shift[k] - is_found[k][1]) for k in now],
                         "fits": fits(twin / f"{options.campaign}_{name}"),
                         "told_to_fit": told["implausibility_sd"] <= IMPLAUSIBLE})
            row = rows[-1]
            print(f"{twin.name} {name} {value:.4g}: " + "; ".join(
                f"{k} foretold {shift[k]:+.2f} ± {answer[k]['shift_error_in_half_ranges']:.2f}, "
                f"found {is_found[k][1]:+.2f}" for k in now) + f" half ranges{'' if row['right'] else ', apart'}"
                + ("" if row["fits"] else ", nothing fits with it") + ("" if row["told_to_fit"] else ", as foretold"), flush=True)
    summary("all", rows)
    summary("with a set that fits", [row for row in rows if row["fits"]])


def summary(which, rows):
    inside = [one for row in rows for one in row["inside"]]
    distances = [one for row in rows for one in row["distance"]]
    if rows:
        print(f"{which}: {sum(row['right'] for row in rows)} of {len(rows)} within a factor of {FACTOR}, or both below "
              f"{SMALL} of the half range; {sum(row['alarm'] for row in rows)} with an alarm where one is due, and only "
              f"there; {sum(inside)} of {len(inside)} found in the range foretold; mean distance "
              f"{sum(distances) / len(distances):.2f} half ranges")


main()
