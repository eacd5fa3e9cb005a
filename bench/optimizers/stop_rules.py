#!/usr/bin/python3
"""stop_rules.py TRACE.csv… [--rule NAME] [--below X]: what rules that end a search would have lost.

TRACE.csv is what search_trace printed. Each rule ends a run at the first look at which its
statistic is below a threshold. Without --below the threshold is the lowest of those in the trace
with a median end of at most 84 evaluations, which is a choice on these very runs: judge it on
others with --rule NAME --below X. The loss is that of the score of README.md against the last
look; its standard error is over the runs."""
import argparse
import csv
import math
import statistics
import sys

MOST = 84

RULES = {
    "bounds": lambda look: look["bounds"],
    "gain_1": lambda look: look["gain_1"],
    "gain_4": lambda look: look["gain_4"],
    "gain_16": lambda look: look["gain_16"],
    "past_4": lambda look: look["past_4"],
    "past_8": lambda look: look["past_8"],
    "past_16": lambda look: look["past_16"],
    "gain_4/left": lambda look: look["gain_4"] / max(look["left"], 1e-9),
    "past_8/left": lambda look: look["past_8"] / max(look["left"], 1e-9),
    "both/left": lambda look: max(look["gain_4"], look["past_8"] / 3) / max(look["left"], 1e-9)
    if look["past_8"] == look["past_8"] else math.nan,
}


def score(regret: float) -> float:
    return sum(regret <= 10 ** (-0.5 * i) for i in range(1, 9)) / 8


def runs_of(paths: list[str]) -> list[list[dict]]:
    runs: dict[tuple, list[dict]] = {}
    for path in paths:
        with open(path, newline="") as file:
            for row in csv.DictReader(file):
                key = (row.pop("problem"), row.pop("instance"))
                runs.setdefault(key, []).append({k: float(v) for k, v in row.items()})
    last = max(run[-1]["evaluations"] for run in runs.values())
    return [run for run in runs.values() if run[-1]["evaluations"] == last]


def ends_by(runs: list[list[dict]], rule, threshold: float) -> list[dict]:
    return [next((look for look in run if rule(look) < threshold), run[-1]) for run in runs]


def report(name: str, threshold: float, runs: list[list[dict]], ends: list[dict]) -> None:
    lost = [score(run[-1]["regret"]) - score(end["regret"]) for run, end in zip(runs, ends)]
    counts = [end["evaluations"] for end in ends]
    error = statistics.stdev(lost) / len(lost) ** 0.5
    print(f"{name:12} below {threshold:<9.3g} median end {statistics.median(counts):3g}, "
          f"mean {statistics.mean(counts):.0f}, loses {statistics.mean(lost):+.4f} "
          f"± {error:.4f}")


def main() -> None:
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("traces", nargs="+")
    parser.add_argument("--rule", choices=RULES)
    parser.add_argument("--below", type=float)
    asked = parser.parse_args()
    runs = runs_of(asked.traces)
    final = statistics.mean(score(run[-1]["regret"]) for run in runs)
    print(f"{len(runs)} runs, score {final:.3f} at the end")
    for name, rule in RULES.items():
        if asked.rule not in (None, name):
            continue
        thresholds = [asked.below] if asked.below is not None else sorted(
            value for value in {rule(look) for run in runs for look in run} if value == value)
        for threshold in thresholds:
            ends = ends_by(runs, rule, threshold)
            if asked.below is not None or statistics.median(e["evaluations"] for e in ends) <= MOST:
                report(name, threshold, runs, ends)
                break
    if min(run[-1]["evaluations"] for run in runs) < MOST:
        sys.exit(f"the traces must be of at least {MOST} evaluations")
    everyone = [next(look for look in run if look["evaluations"] == MOST) for run in runs]
    report("everyone", MOST, runs, everyone)


if __name__ == "__main__":
    main()
