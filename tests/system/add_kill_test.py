#!/usr/bin/env python3
"""add_kill_test.py TALUS SOURCE_DIR [--kills N] [--seed S]: kill -9 of `talus add-experiment` at random moments.

After each kill the second test is in the campaign or it is not, and no trial is lost or changed. Where it is not, the
same command adds it; where it is, the command says so. A `resume` that is killed, too, goes on to an answer of both
tests. `bench/kills` runs it with more kills.
"""
import json
import pathlib
import random
import shutil
import signal
import subprocess
import tempfile
import time

from chance_arguments import chance_arguments
from kill_test import finished_trials
from two_experiments_campaign import make_finished, run

ADD = ("add-experiment", "out", "wide.json", "--core-time", "50 ms")


def killed(command, folder, seconds):
    """Whether it was killed before it ended."""
    process = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    try:
        output = process.communicate(timeout=seconds)[0].decode()
    except subprocess.TimeoutExpired:
        process.send_signal(signal.SIGKILL)
        process.communicate()
        return True
    assert process.returncode == 0, output
    return False


def keeps(before, now):
    lost = [trial for trial, content in before.items() if now.get(trial) != content]
    assert not lost, f"these trials are lost or changed: {lost}"


def experiments_of(folder):
    return [e["name"] for e in json.loads((folder / "out/result.json").read_text())["experiments"]]


def check(talus, folder, seconds, before):
    """One campaign, killed while the test is added and while it goes on; whether the first kill came before its end, whether
    before the test was recorded, and whether the second came before the end."""
    was_killed = killed([talus, *ADD], folder, seconds)
    keeps(before, finished_trials(talus, folder))
    again = subprocess.run([talus, *ADD], cwd=folder, capture_output=True, text=True)
    words = again.stdout + again.stderr
    came_before = again.returncode == 0
    assert was_killed or not came_before, words
    assert came_before or "goes on with it" in words, words
    killed_again = killed([talus, "resume", "out"], folder, seconds)
    run(talus, folder, "resume", "out")
    now = finished_trials(talus, folder)
    keeps(before, now)
    assert len(now) > len(before) and experiments_of(folder) == ["heap", "wide plate"], (len(now), experiments_of(folder))
    return was_killed, was_killed and came_before, killed_again


def main():
    arguments = chance_arguments("kills", 8)
    talus, dice = arguments.talus, random.Random(arguments.seed)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name).resolve()
        make_finished(talus, arguments.source, folder)
        shutil.copytree(folder / "out", folder / "good")
        start = time.monotonic()
        run(talus, folder, *ADD)
        usual = time.monotonic() - start
        kills, came_before, further = 0, 0, 0
        while kills < arguments.kills:
            shutil.rmtree(folder / "out")
            shutil.copytree(folder / "good", folder / "out")
            before = finished_trials(talus, folder)
            # The test is recorded early, and the search goes on.
            most = dice.choice((0.1, 1.1)) * usual
            was_killed, was_before, killed_again = check(talus, folder, dice.uniform(0.0, most), before)
            kills += was_killed
            came_before += was_before
            further += killed_again
        assert further > 0 and 0 < came_before, (kills, came_before, further)
        print(f"{kills} kills of add-experiment, {came_before} before the test was recorded, and {further} of resume after "
              "it; no trial lost or changed")


main()
