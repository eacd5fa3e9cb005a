#!/usr/bin/env python3
"""foreign_engine_test.py TALUS SOURCE_DIR NAME: the campaign of examples/NAME with its own decks and
command, made cheap: fewer, larger and softer grains and a faster lift, so that a heap takes a second.
It is killed in between and resumed. Skipped (77) where the example's program is not installed."""
import csv
import json
import math
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from commented_json import read_json

talus, source, name = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), sys.argv[3]
example = source / "examples" / name
NUM_TRIALS = 7  # 6 of the search and 1 confirmation
PLATE_MM = 10


def cheap(folder):
    spec = read_json(example / "campaign.json")
    spec["engine"]["templates"] = str(example / spec["engine"]["templates"])
    spec["experiment"]["photos"] = str(source / "examples/photos/powder_a")
    spec["experiment"] |= {"pattern": "run01_view{view}.jpg", "pixel_size": "100 um"}
    # 254 grains. LIGGGHTS refuses a modulus below 5 MPa; the step grows by the root of 26.25 / 5.
    spec["coarse_graining"]["scale_factor"] = 2.5
    spec["powder"]["material"]["youngs_modulus"] = "5 MPa"
    spec["device"]["lift_velocity"] = "200 mm/s"
    spec["rules"] = {"settling": {"max_time": "0.05 s"}, "heap": {"max_time": "0.1 s"}}
    # In this half of the ranges so few, large grains stay on the plate as a heap.
    spec["parameters"]["sliding_friction"]["min"] = 0.5
    spec["parameters"]["rolling_friction"]["min"] = 0.2
    spec["strategy"] = {"kind": "sobol", "num_points": 8}
    spec["budget"]["simulations"] = 6
    spec["noise"]["replicates"] = 2
    spec["confirm"] = {"candidates": 1, "replicates": 1, "ends": False}
    spec["workers"] = 2
    path = folder / "campaign.json"
    path.write_text(json.dumps(spec))
    return path, spec


def run(*arguments):
    done = subprocess.run([talus, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, (arguments, done.stdout[-2000:], done.stderr[-2000:])
    return done.stdout


def run_until_killed(path, out):
    """SIGKILL while the third trial or a later one runs, and after one has been recorded."""
    process = subprocess.Popen([talus, "calibrate", path, "--out", out], stdout=subprocess.DEVNULL)
    while process.poll() is None and not (out / "trials/0003/log.txt").exists():
        time.sleep(0.02)
    assert process.poll() is None, "it ended before it could be killed"
    process.send_signal(signal.SIGKILL)
    process.wait()


def table(out):
    run("export", out, "--out", out / "tables")
    with open(out / "tables/trials.csv", newline="") as file:
        return list(csv.DictReader(file))


def check(trial, out, spec):
    """What holds for any heap of this powder on this plate."""
    assert trial["status"] == "ok", trial
    folder = out / "trials" / f"{int(trial['trial']):04}"
    result = read_json(folder / "result.json")
    counts = result["counts"]
    on_heap = counts["on_heap"]
    # The dump holds all grains that have not left the box, and some of those lie on the plate.
    assert 20 < on_heap <= counts["in_file"] <= 254, counts
    assert (folder / "heap.vtp").exists() and (folder / spec["engine"]["result"]).exists()
    # A heap, not a layer of single grains and not the filled tube: spheres below 1 in friction do not
    # stand at 60 degrees. The angles of repose of so few grains are often not defined.
    nebp, angle = float(trial["nebp_mm2"]), float(trial["triangle_angle_deg"])
    assert 20 < angle < 60, trial
    assert 0.3 < nebp / (math.tan(math.radians(angle)) * (PLATE_MM / 2) ** 2) < 1.5, trial
    # The experiment's heap has 18.2 mm²; no difference is larger than both areas together.
    assert abs(nebp - 18.2) - 0.5 < float(trial["sad_mm2"]) < nebp + 18.2, trial
    return on_heap


def check_ranks(trial):
    """One trial of the campaign again as two MPI ranks: LAMMPS says how many it has."""
    case = read_json(trial / "case.json")
    case["engine"]["ranks"] = 2
    path = trial.parent / "ranks.json"
    path.write_text(json.dumps(case))
    # Containers, where tests often run, have no other user than root and may have one core.
    os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                      OMPI_MCA_rmaps_base_oversubscribe="1")
    run("simulate", path, "--out", trial.parent / "ranks")
    log = (trial.parent / "ranks/log.txt").read_text()
    grid = re.search(r"(\d+) by (\d+) by (\d+) MPI processor grid", log)
    assert grid and math.prod(map(int, grid.groups())) == 2, log[-2000:]
    counts = read_json(trial.parent / "ranks/result.json")["counts"]
    assert 20 < counts["on_heap"], counts


def main(root):
    path, spec = cheap(root)
    program = spec["engine"]["command"][0]
    if shutil.which(program) is None:
        print(f"{program} is not installed (Debian: apt-get install {name}): skipped")
        return 77
    run("validate", path)
    out = root / "out"
    run_until_killed(path, out)
    run("resume", out)
    trials = table(out)
    assert [int(trial["trial"]) for trial in trials] == list(range(1, NUM_TRIALS + 1)), trials
    grains = [check(trial, out, spec) for trial in trials]
    assert len({trial["seed"] for trial in trials}) == NUM_TRIALS
    # More friction keeps more on the plate: the parameters reach the engine. LIGGGHTS keeps 51 and 82
    # grains, LAMMPS 30 and 54; two packings of one set differ by 1 to 7.
    weak, strong = trials[3], trials[4]
    assert all(float(weak[key]) + 0.09 < float(strong[key])
               for key in ("sliding_friction", "rolling_friction")), trials
    assert grains[3] < grains[4], grains
    # Two packings of one set differ: the seed reaches the engine.
    assert trials[0]["sad_mm2"] != trials[1]["sad_mm2"], trials
    if name == "lammps" and shutil.which("mpirun"):
        check_ranks(out / "trials/0001")
    text = run("compare", out)
    assert "SAD" in text and "μₜ" in text, text
    run("report", out)
    page = out / "report/report.html"
    assert page.exists() and page.stat().st_size > 50_000, page
    # A finished campaign has nothing left to do, and goes on where it is asked to.
    run("resume", out)
    assert table(out) == trials
    run("resume", out, "--add-simulations", 1)
    longer = table(out)
    assert len(longer) > NUM_TRIALS and all(trial["status"] == "ok" for trial in longer), len(longer)
    return 0


with tempfile.TemporaryDirectory(prefix=f"talus_{name}_") as folder:
    sys.exit(main(pathlib.Path(folder)))
