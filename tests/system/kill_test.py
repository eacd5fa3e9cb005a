#!/usr/bin/env python3
"""kill_test.py TALUS SOURCE_DIR [--kills N] [--seed S] [--two]: kill -9 or Ctrl-C of a campaign at random moments.

Two workers run another engine whose command leaves processes in sessions of their own. After each kill
nothing of it may run on, and what was finished must stay as it was; in the end the campaign has the
trials of one that nobody killed. --two: of two experiments at three scale factors, searched by the posterior.
`bench/kills` runs both with 200 kills.
"""
import contextlib
import json
import os
import pathlib
import random
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time

from chance_arguments import chance_arguments
from commented_json import read_json

DECK = """#!/bin/sh
# What tells the experiments apart: plate {{ plate_diameter }} m.
setsid sleep 300 &
(sleep 300 &)
sleep 0.05
awk -v mu={{ sliding_friction }} -v mr={{ rolling_friction }} 'BEGIN {
  print "x_m,y_m,z_m,diameter_m"; d = 4e-4; R = 5e-3; H = R * (0.2 + 0.5 * mu + 0.3 * mr)
  for (z = d / 2; z < H; z += d) { r = R * (1 - z / H)
    for (x = -R; x <= R; x += d) for (y = -R; y <= R; y += d)
      if (x * x + y * y <= r * r) print x "," y "," z "," d } }' >heap.part
mv heap.part heap.csv
"""


KILLED = (-signal.SIGKILL, -signal.SIGINT, 130)  # by Ctrl-C before and after it is listened to


def search_two(spec, source):
    """Two tests and three scale factors in place of one of each."""
    heap = spec.pop("experiment") | {"name": "heap"}
    wide = {"name": "wide plate", "photos": str(source / "examples/photos/powder_a_wide"), "plate_diameter": "30 mm",
            "pattern": heap["pattern"], "pixel_size": "400 um", "device": spec["device"] | {"plate_diameter": "30 mm"}}
    spec["experiments"] = [heap, wide]
    spec["coarse_graining"] = {"scale_factors": [2, 1.5, 1.2]}
    spec["posterior"] = {"stop_share": 0}
    del spec["strategy"], spec["noise"]


def make_spec(source, folder, simulations, two):
    spec = read_json(source / "examples/demo/campaign.json")
    spec["experiment"]["photos"] = str(source / "examples/photos/powder_a")
    # One run: reading five would take longer than most campaigns here live.
    spec["experiment"] |= {"pattern": "run01_view{view}.jpg", "pixel_size": "200 um"}
    spec["budget"] = {"simulations": simulations, "min_simulations": simulations}
    spec["noise"] = {"replicates": 2}
    spec["confirm"] = {"candidates": 1, "replicates": 2, "ends": False}
    spec["strategy"] = {"kind": "sobol", "num_points": simulations}
    spec["workers"] = 2
    spec["coarse_graining"] = {"scale_factor": 1}
    spec["engine"] = {"kind": "command", "templates": "deck", "command": ["sh", "run.sh"],
                      "result": "heap.csv"}
    if two:
        search_two(spec, source)
    (folder / "deck").mkdir()
    (folder / "deck/run.sh").write_text(DECK)
    (folder / "spec.json").write_text(json.dumps(spec))


def processes_in(folder):
    """The command lines of what runs in this folder."""
    found = []
    for process in pathlib.Path("/proc").iterdir():
        if not process.name.isdigit():
            continue
        try:
            if os.readlink(process / "cwd").startswith(str(folder / "out/trials")):
                found.append((process / "cmdline").read_bytes().replace(b"\0", b" ").decode())
        except OSError:
            pass
    return found


def has_begun(folder):
    """Whether the journal holds the campaign: its file is there some milliseconds before."""
    path = folder / "out/journal.sqlite"
    if not path.exists():
        return False
    with contextlib.closing(sqlite3.connect(f"file:{path}?mode=ro", uri=True)) as journal:
        try:
            return journal.execute("SELECT count(*) FROM campaign").fetchone()[0] > 0
        except sqlite3.Error:
            return False


def delay_of_kill(campaign, folder, dice, longest):
    """How long to wait for the kill [s]. Half of the kills follow the campaign's beginning, whenever that is: on a busy
    machine most of the others come before it."""
    if dice.random() < 0.5:
        return dice.uniform(0.02, longest)
    while campaign.poll() is None and not has_begun(folder):
        time.sleep(0.01)
    return dice.uniform(0, 0.3)


def finished_trials(talus, folder, out="out"):
    subprocess.run([talus, "export", out], cwd=folder, check=True, capture_output=True)
    trials = json.loads((folder / out / "export/trials.json").read_text())["trials"]
    return {t["id"]: (t["unit_point"], t["seed"], t["status"], t["metrics"], t["finish_order"])
            for t in trials if t["status"] != "running"}


def killed_campaign(talus, source, most_kills, dice, two):
    """A campaign killed at random moments until it ends by itself; the kills, those of them after its first trial began,
    and its trials."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name).resolve()
        simulations = 2 + 2 * most_kills
        confirming = 4 if two else 2
        make_spec(source, folder, simulations, two)
        before, kills, late_kills = {}, 0, 0
        longest = 0.6  # that a campaign lives [s]
        command = [talus, "calibrate", "spec.json", "--out", "out"]
        while True:
            campaign = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE,
                                        stderr=subprocess.STDOUT)
            try:
                output = campaign.communicate(timeout=None if kills == most_kills else
                                              delay_of_kill(campaign, folder, dice, longest))[0].decode()
            except subprocess.TimeoutExpired:
                campaign.send_signal(dice.choice((signal.SIGKILL, signal.SIGINT)))
                output = campaign.communicate()[0].decode()
                kills += 1
            deadline = time.monotonic() + 60  # a busy machine ends them late
            while (left := processes_in(folder)) and time.monotonic() < deadline:
                time.sleep(0.01)
            assert not left, f"these live on: {left}"
            if not has_begun(folder):
                assert campaign.returncode in KILLED, output
                for file in sorted((folder / "out").rglob("*")) if (folder / "out").exists() else []:
                    assert file.name in ("campaign.lock", "aehp.png", "aehp_sd.png", "campaign.json") \
                        or ".tmp" in file.name or file.name.startswith(("run_", "experiment_", "journal.sqlite")), file
                if (folder / "out/campaign.json").exists():
                    command = [talus, "resume", "out"]
                longest *= 1.3  # a busy machine needs longer to begin
                continue
            command = [talus, "resume", "out"]
            assert campaign.returncode in (0, *KILLED), output
            late_kills += campaign.returncode != 0
            now = finished_trials(talus, folder)
            lost = [trial for trial, content in before.items() if now.get(trial) != content]
            assert not lost, f"these trials are lost or changed: {lost}"
            before = now
            if campaign.returncode == 0:
                break
        search = [t for t in before if before[t][2] == "ok"]
        assert len(search) == len(before) == simulations + confirming, (len(search), len(before))
        assert sorted(before) == list(range(1, simulations + confirming + 1))
        subprocess.run([talus, "calibrate", "spec.json", "--out", "whole"], cwd=folder, check=True, capture_output=True)
        whole = finished_trials(talus, folder, "whole")
        others = [trial for trial, content in whole.items() if before[trial] != content]
        assert not others, f"these trials are not those of a campaign that nobody killed: {others}"
        return kills, late_kills, len(before)


def main():
    arguments = chance_arguments("kills", 16, "--two")
    dice = random.Random(arguments.seed)
    kills, late_kills, trials = 0, 0, 0
    while kills < arguments.kills:  # a fast machine ends a campaign after few kills
        # The posterior's proposals become dearer with the trials: many short campaigns.
        most = min(arguments.kills - kills, 20) if arguments.two else arguments.kills - kills
        more_kills, more_late, more_trials = killed_campaign(arguments.talus, arguments.source, most, dice, arguments.two)
        kills, late_kills, trials = kills + more_kills, late_kills + more_late, trials + more_trials
    print(f"{kills} kills, {late_kills} of them of a campaign that had begun, {trials} trials, none lost, nothing left running")
    assert late_kills > 0, "no campaign lived long enough to be killed at work: try more kills"


if __name__ == "__main__":
    main()
