#!/usr/bin/env python3
"""campaign_test.py TALUS SOURCE_DIR: a campaign of 24 trials on a one-node Slurm ends with the trial
table of the local runner with one worker, also when its process is killed five times in between, when
its node fails while it is dead, and when its jobs are cancelled with Ctrl-C; so does a campaign of two
experiments. Trials that are proposed together are one job array, and Slurm is not asked more than once
in 5 s. A trial of two MPI ranks gets two tasks."""
import contextlib
import csv
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

talus, source = sys.argv[1], pathlib.Path(sys.argv[2])
cluster = source / "tests/system/slurm/one_node_cluster"
# A cone of spheres whose height follows the parameters: an engine that takes a few milliseconds.
# It waits while there is a file `hold` beside the campaign, where it notes each run of a trial.
DECK = """# What tells the experiments apart: {{ lift_velocity }} m/s.
echo run >>../../../runs_$(basename "$PWD")
echo $$ >pid
while [ -e ../../../hold ]; do sleep 0.1; done
awk -v mu={{ sliding_friction }} -v mr={{ rolling_friction }} -v seed={{ seed }} 'BEGIN {
  print "x,y,z,r"
  for (x = -4; x <= 4; ++x) for (y = -4; y <= 4; ++y) if (x * x + y * y <= 16)
    for (z = 0.5; z <= 1 + (4 - sqrt(x * x + y * y)) * (0.4 + mu + 0.3 * mr); ++z)
      print x * 1e-3 "," y * 1e-3 "," z * 1e-3 "," (5.1 + seed % 7 / 100) * 1e-4
}' >heap.csv
"""
SAME = ("trial", "kind", "status", "seed", "sliding_friction", "rolling_friction", "sad_mm2")


def spec(folder, runner, num_trials=24, workers=1):
    (folder / "deck").mkdir(parents=True)
    (folder / "deck/run.sh").write_text(DECK)
    text = {
        "engine": {"kind": "command", "templates": "deck", "command": ["sh", "run.sh"],
                   "result": "heap.csv"},
        "experiment": {"photos": str(source / "examples/photos/powder_a"),
                       "pattern": "run01_view{view}.jpg", "plate_diameter": "10 mm",
                       "pixel_size": "100 um"},
        "powder": {"material": {"density": 2500}, "sizes": {"kind": "mono", "diameter": "1 mm"}, "mass": "0.3 g"},
        "device": {"plate": "disc"},
        "parameters": {"sliding_friction": {"min": 0.1, "max": 0.9},
                       "rolling_friction": {"min": 0.02, "max": 0.6}},
        "strategy": {"kind": "sobol", "num_points": num_trials - 2},
        "budget": {"simulations": num_trials},
        "noise": {"replicates": 2},
        "confirm": {"candidates": 0},
        "workers": workers,
        "runner": runner,
        "seed": 3,
    }
    (folder / "campaign.json").write_text(json.dumps(text))
    return folder / "campaign.json"


def two_experiments(folder, runner):
    """The heap, and the same powder lifted fast with the mass that falls: proposals of the surrogate."""
    path = spec(folder, runner)
    text = json.loads(path.read_text())
    heap = {"name": "heap", **text.pop("experiment")}
    text["experiments"] = [heap, {**heap, "name": "fast lift",
                                  "device": {"plate": "disc", "lift_velocity": "20 cm/s"},
                                  "mass_fallen": {"value": "20 mg", "sd": "5 mg"}}]
    del text["noise"]
    text.update(strategy={"kind": "auto"}, budget={"simulations": 12},
                confirm={"candidates": 1, "replicates": 1, "ends": False}, coarse_graining={"scale_factor": 1})
    path.write_text(json.dumps(text))
    return path


def check_two_experiments(root):
    """On Slurm, killed twice, they end with the table of the local runner, and are reported."""
    folders = {name: root / ("two_" + name) for name in ("local", "slurm")}
    local, on_slurm = (folder / "out" for folder in folders.values())
    run("calibrate", two_experiments(folders["local"], {"kind": "local"}), "--out", local)
    run_killed(root, two_experiments(folders["slurm"], {"kind": "slurm"}), on_slurm, 2)
    expected, got = table(local, SAME + ("experiment",)), table(on_slurm, SAME + ("experiment",))
    assert len(expected) == 14 and {row[-1] for row in expected} == {"heap", "fast lift"}, expected
    assert got == expected, "\n".join(map(str, set(got) ^ set(expected)))
    for name in ("heap", "fast lift"):
        run("compare", on_slurm, "--experiment", name)
        run("report", on_slurm, "--experiment", name)


def table(out, columns=SAME):
    subprocess.run([talus, "export", out, "--out", out / "tables"], check=True,
                   stdout=subprocess.DEVNULL)
    with open(out / "tables/trials.csv") as file:
        return [tuple(row[key] for key in columns) for row in csv.DictReader(file)]


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


def wait_for(what, seconds=60):
    end = time.monotonic() + seconds
    while not what():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.1)


def start_held(folder, out, *arguments):
    """Starts the program and waits until two of its trials run, which do not end by themselves."""
    (folder / "hold").touch()
    log = open(folder / "log.txt", "a")
    process = subprocess.Popen([talus, *map(str, arguments)], stdout=log, stderr=log)
    wait_for(lambda: len(list(out.parent.glob("runs_*"))) == 2)
    return process


def slurm(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def lose_node(trials):
    """The node fails, and comes back without the processes of `trials`, which Slurm may leave running for a while."""
    node = slurm("hostname", "-s").strip()
    slurm("scontrol", "update", "nodename=" + node, "state=down", "reason=test")
    wait_for(lambda: not slurm("squeue", "--me", "--noheader", "--states=running,completing"))
    for pid in trials.glob("*/pid"):
        with contextlib.suppress(ProcessLookupError):
            os.kill(int(pid.read_text()), signal.SIGKILL)
    # Resuming is refused as long as the node's last state is being dealt with, and also when it has
    # come back by itself: what counts is the state it is in.
    def is_back():
        subprocess.run(["scontrol", "update", "nodename=" + node, "state=resume"],
                       capture_output=True)
        return slurm("sinfo", "--noheader", "--format=%t").split() in (["idle"], ["mix"], ["alloc"])

    wait_for(is_back)


def run_twice(root, name, interrupt, runner):
    """Six trials, the first two of which are lost while they run. The campaign runs them again."""
    folder, out = root / name, root / name / "out"
    path = spec(folder, runner, num_trials=6, workers=2)
    process = start_held(folder, out, "calibrate", path, "--out", out)
    interrupt(process, out / "trials")
    (folder / "hold").unlink()
    run("resume", out)
    runs = [(folder / f"runs_{trial:04}").read_text() for trial in range(1, 7)]
    assert runs == 2 * ["run\nrun\n"] + 4 * ["run\n"], (name, runs)
    return table(out)


def die_and_lose_node(process, trials):
    process.send_signal(signal.SIGKILL)
    process.wait()
    lose_node(trials)


def press_ctrl_c_twice(process, _):
    process.send_signal(signal.SIGINT)
    time.sleep(0.7)
    process.send_signal(signal.SIGINT)
    assert process.wait(60) == 130, process.returncode
    wait_for(lambda: not slurm("squeue", "--me", "--noheader"))


def check_array():
    """60 trials at once: one sbatch, and squeue at most once in 5 s."""
    done = subprocess.run([source / "bench/trial_rate", "--slurm", "--trials", "60", "--workers",
                           "60"], env={**os.environ, "TALUS": talus}, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    calls = dict(re.findall(r"(sbatch|squeue|sacct|scancel) (\d+)", done.stdout))
    seconds = float(re.search(r"trials in ([\d.]+) s", done.stdout)[1])
    assert calls["sbatch"] == "1", done.stdout
    assert int(calls["squeue"]) <= seconds / 5, done.stdout
    assert int(calls["sacct"]) <= int(calls["squeue"]), done.stdout  # for what squeue has forgotten
    gap = re.search(r"squeue: ([\d.]+) s", done.stdout)  # missing when there was one call at most
    # Counted from when the commands start, which a busy machine delays by some milliseconds.
    assert gap is None or float(gap[1]) > 4.9, done.stdout


def check_ranks(root):
    """Two MPI ranks a trial: Slurm gives two tasks, and mpirun starts the deck twice."""
    folder, out = root / "ranks", root / "ranks/out"
    as_root = ["export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"]
    path = spec(folder, {"kind": "slurm", "setup": as_root}, num_trials=4)
    deck = folder / "deck/run.sh"
    deck.write_text('echo "$OMPI_COMM_WORLD_SIZE $SLURM_NTASKS" >rank_$OMPI_COMM_WORLD_RANK\n'
                    '[ "$OMPI_COMM_WORLD_RANK" = 0 ] || exit 0\n' + DECK)
    text = json.loads(path.read_text())
    text["engine"]["ranks"] = 2
    path.write_text(json.dumps(text))
    run("calibrate", path, "--out", out)
    trials = sorted((out / "trials").iterdir())
    for trial in trials:
        ranks = {file.name: file.read_text() for file in trial.glob("rank_*")}
        assert ranks == {"rank_0": "2 2\n", "rank_1": "2 2\n"}, (ranks, (trial / "log.txt").read_text())
    assert len(trials) == 4 and all(row[2] == "ok" for row in table(out))


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
        # With --no-requeue it is not Slurm that runs a job again whose node has failed.
        by_us = {"kind": "slurm", "directives": ["--no-requeue"]}
        lost = run_twice(root, "lost", die_and_lose_node, by_us)
        dropped = run_twice(root, "dropped", press_ctrl_c_twice, {"kind": "slurm"})
        check_array()
        check_two_experiments(root)
        if shutil.which("mpirun"):
            check_ranks(root)
    finally:
        subprocess.run([cluster, "stop", root / "slurm"])
    for name in ("unbroken", "killed"):
        got = table(root / name / "out")
        assert got == expected, "\n".join(map(str, [name, *set(got) ^ set(expected)]))
        runs = [file.read_text() for file in (root / name).glob("runs_*")]
        assert len(runs) == 24 and set(runs) == {"run\n"}, runs
    for got in (lost, dropped):
        assert got == expected[:6], "\n".join(map(str, set(got) ^ set(expected[:6])))
    print("24 trials each: local, Slurm, and Slurm with five kills agree; none was run twice")
    return 0


with tempfile.TemporaryDirectory(prefix="talus_slurm_") as folder:
    sys.exit(main(pathlib.Path(folder)))
