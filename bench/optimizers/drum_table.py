#!/usr/bin/python3
"""drum_table.py TALUS FOLDER [--speeds 30] [--within 1.15] [--truths 24]: how many evaluations
`talus optimize` takes to find a set in a table of simulated drums, by their images.

FOLDER holds parameters.csv and images_NNrpm.u8 (50 x 50 pixels a row of the table, a byte is 0 to
16). Each truth is a row of the table, even over it; its image is the target, the other rows are the
candidates. Counted are the evaluations up to the first whose value is within the factor of the
best candidate's. Several speeds are one image below the other. Called with `evaluate` in place of
TALUS it is the command that talus runs."""
import argparse
import csv
import json
import pathlib
import signal
import statistics
import subprocess
import sys
import tempfile

SIDE = 50
PIXELS = SIDE * SIDE
LEVELS = 16
BUDGET = 80


def image(folder: pathlib.Path, speeds: list[str], row: int) -> bytes:
    parts = []
    for speed in speeds:
        with open(folder / f"images_{speed}rpm.u8", "rb") as file:
            file.seek(row * PIXELS)
            parts.append(file.read(PIXELS))
    return b"".join(parts)


def rows_of(pixels: bytes) -> list[list[float]]:
    return [[level / LEVELS for level in pixels[i:i + SIDE]] for i in range(0, len(pixels), SIDE)]


def table_of(folder: pathlib.Path) -> list[dict]:
    with open(folder / "parameters.csv", newline="") as file:
        return list(csv.DictReader(file))


def evaluate(folder: pathlib.Path, speeds: list[str]) -> None:
    asked = json.load(sys.stdin)

    def off(row: dict) -> float:
        return sum(abs(float(row[k]) - asked[k]) / (abs(asked[k]) + 1e-9) for k in row if k != "row")

    nearest = min(table_of(folder), key=off)
    if off(nearest) > 1e-6:
        sys.exit("not a row of the table")
    print(json.dumps({"field": rows_of(image(folder, speeds, int(nearest["row"])))}))


def problem_of(table: list[dict], truth: int, target: bytes, work: pathlib.Path) -> pathlib.Path:
    names = [name for name in table[0] if name != "row"]
    with open(work / "candidates.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, names, extrasaction="ignore")
        writer.writeheader()
        writer.writerows(row for row in table if int(row["row"]) != truth)
    values = {name: [float(row[name]) for row in table] for name in names}
    problem = {
        "parameters": [{"name": n, "low": min(values[n]), "high": max(values[n])} for n in names],
        "candidates": "candidates.csv",
        "target": {"field": rows_of(target)},
        "strategy": {"exact": True, "stop_multiple": 0},
        "evaluations": BUDGET,
        "seed": truth + 1,
    }
    path = work / "problem.json"
    path.write_text(json.dumps(problem))
    return path


def evaluations_to(good: float, command: list[str]) -> int | None:
    """The number of the first evaluation with a value of at most `good`."""
    with subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL,
                          text=True) as talus:
        for line in talus.stderr:
            if not line.startswith("{"):
                print(line, end="", file=sys.stderr)
                continue
            told = json.loads(line)
            if told.get("value", float("inf")) <= good:
                talus.send_signal(signal.SIGKILL)
                return told["evaluation"]
    return None


def main() -> None:
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("talus")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--speeds", default="30")
    parser.add_argument("--within", type=float, default=1.15)
    parser.add_argument("--truths", type=int, default=24)
    asked = parser.parse_args()
    speeds = asked.speeds.split(",")
    if asked.talus == "evaluate":
        evaluate(asked.folder, speeds)
        return
    table = table_of(asked.folder)
    images = [image(asked.folder, speeds, int(row["row"])) for row in table]
    step = len(table) // asked.truths
    taken = []
    for truth in range(step // 3, len(table), step)[:asked.truths]:
        target = images[truth]
        sad = [sum(abs(a - b) for a, b in zip(other, target)) for other in images]
        best = min(sad[:truth] + sad[truth + 1:]) * 100 / LEVELS / len(target)
        with tempfile.TemporaryDirectory() as work:
            problem = problem_of(table, truth, target, pathlib.Path(work))
            count = evaluations_to(asked.within * best + 1e-9, [
                asked.talus, "optimize", str(problem), "--", sys.executable, __file__, "evaluate",
                str(asked.folder), "--speeds", asked.speeds])
        taken.append(count if count is not None else BUDGET + 1)
        print(f"row {truth}: best candidate {best:.3f} %, within {asked.within} after "
              f"{count or 'more than ' + str(BUDGET)}", flush=True)
    print(f"median {statistics.median(taken)} of {len(taken)}, "
          f"{sum(t > BUDGET for t in taken)} failed")


if __name__ == "__main__":
    main()
