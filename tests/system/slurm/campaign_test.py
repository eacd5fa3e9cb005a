#!/usr/bin/env python3
"""campaign_test.py TALUS SOURCE_DIR: a campaign of 24 trials on a one-node Slurm ends with the trial
table of the local runner with one worker, also when its process is killed five times in between."""
import csv
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

talus, source = sys.argv[1], pathlib.Path(sys.argv[2])
cluster = source / "tests/system/slurm/one_node_cluster"
# A cone of spheres whose height follows the parameters: an engine that takes a few milliseconds.
DECK = """awk -v mu={{ sliding_friction }} -v mr={{ rolling_friction }} -v seed={{ seed }} 'BEGIN {
  print "x,y,z,r"
  for (x = -4; x <= 4; ++x) for (y = -4; y <= 4; ++y) if (x * x + y * y <= 16)
    for (z = 0.5; z <= 1 + (4 - sqrt(x * x + y * y)) * (0.4 + mu + 0.3 * mr); ++z)
      print x * 1e-3 "," y * 1e-3 "," z * 1e-3 "," (5.1 + seed % 7 / 100) * 1e-4
}' >heap.csv
echo run >>runs
"""
SAME = ("trial", "kind", "status", "seed", "sliding_friction", "rolling_friction", "sad_mm2")


def spec(folder, runner):
    (folder / "deck").mkdir(parents=True)
    (folder / "deck/run.sh").write_text(DECK)
    text = {
        "engine": {"kind": "command", "templates": "deck", "command": ["sh", "run.sh"],
                   "result": "heap.csv"},
        "experiment": {"photos": str(source / "examples/photos/powder_a"),
                       "pattern": "run{run}_view{view}.jpg", "plate_diameter": "10 mm",
                       "pixel_size": "100 um"},
        "powder": {"sizes": {"kind": "mono", "diameter": "1 mm"}, "mass": "0.3 g"},
        "device": {"plate": "disc"},
        "parameters": {"sliding_friction": {"min": 0.1, "max": 0.9},
                       "rolling_friction": {"min": 0.02, "max": 0.6}},
        "strategy": {"kind": "sobol", "num_points": 22},
        "budget": {"simulations": 24},
        "noise": {"replicates": 2},
        "confirm": {"candidates": 0},
        "workers": 1,
        "runner": runner,
        "seed": 3,
    }
    (folder / "campaign.json").write_text(json.dumps(text))
    return folder / "campaign.json"


def table(out):
    subprocess.run([talus, "export", out, "--out", out / "tables"], check=True,
                   stdout=subprocess.DEVNULL)
    with open(out / "tables/trials.csv") as file:
        return [tuple(row[key] for key in SAME) for row in csv.DictReader(file)]


def run(*arguments):
    subprocess.run([talus, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)


def run_killed(root, path, out, kills):
    """Kills the process kills times, each time after it has got a little further."""
    arguments = ["calibrate", path, "--out", out]
    log = open(root / "killed.txt", "w")
    for kill in range(kills):
        process = subprocess.Popen([talus, *map(str, arguments)], stdout=log, stderr=log)
        trials = out / "trials"
        wanted = 4 * kill + 2  # folders begun
        while process.poll() is None and (
                not trials.exists() or len(list(trials.iterdir())) < wanted):
            time.sleep(0.03)
        time.sleep(0.1 * kill)
        assert process.poll() is None, "ended before it could be killed: " + str(root)
        process.send_signal(signal.SIGKILL)
        process.wait()
        arguments = ["resume", out]
    run("resume", out)


def main(root):
    run("calibrate", spec(root / "local", {"kind": "local"}), "--out", root / "local/out")
    expected = table(root / "local/out")
    assert len(expected) == 24 and all(row[2] == "ok" for row in expected), expected
    started = subprocess.run([cluster, "start", root / "slurm"], stdout=subprocess.DEVNULL)
    if started.returncode == 77:
        return 77
    started.check_returncode()
    os.environ["SLURM_CONF"] = str(root / "slurm/slurm.conf")
    try:
        run("calibrate", spec(root / "unbroken", {"kind": "slurm"}), "--out", root / "unbroken/out")
        run_killed(root, spec(root / "killed", {"kind": "slurm"}), root / "killed/out", 5)
    finally:
        subprocess.run([cluster, "stop", root / "slurm"])
    for name in ("unbroken", "killed"):
        got = table(root / name / "out")
        assert got == expected, "\n".join(map(str, [name, *set(got) ^ set(expected)]))
        runs = [file.read_text() for file in (root / name / "out/trials").glob("*/runs")]
        assert len(runs) == 24 and set(runs) == {"run\n"}, runs
    print("24 trials each: local, Slurm, and Slurm with five kills agree; none was run twice")
    return 0


with tempfile.TemporaryDirectory(prefix="talus_slurm_") as folder:
    sys.exit(main(pathlib.Path(folder)))
