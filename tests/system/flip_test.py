#!/usr/bin/env python3
"""flip_test.py TALUS SOURCE_DIR [--flips N] [--seed S]: one bit turned over in a campaign's folder.

In a file that the program reads again, of a campaign of two tests at three scale factors; in turn the second test is
still to be added, was recorded by a command that was then killed, or has been simulated. Each flip is harmless, so that
trials and answer are the same bits, or it is said. Every second flip is in the journal. `bench/kills` runs it with more
flips.
"""
import pathlib
import random
import re
import shutil
import signal
import subprocess
import tempfile
import time

from chance_arguments import chance_arguments
from two_experiments_campaign import make_finished, run

READ = ("journal.sqlite", "campaign.json", "result.json", "*.png", "trials/*/trial.json", "trials/*/profile.png",
        "trials/*/heap.csv")
# The least core time: how many trials a search may have does not depend on how long each takes.
ADD = ("add-experiment", "out", "wide.json", "--core-time", "1 ms")
RESUME = ("resume", "out")
# What goes on with a campaign in each state. What is simulated after the flip takes another time in each run.
GOES_ON = {"before": ADD, "recorded": RESUME, "simulated": RESUME}
NEW_TRIALS = "elapsed_s|core_hours|duration_s|cpu_s|started_utc|finished_utc|finish_order"
TIMES = {"before": NEW_TRIALS, "recorded": NEW_TRIALS, "simulated": "elapsed_s"}


def keep(folder, state):
    shutil.copytree(folder / "out", folder / state)


def make_states(talus, source, folder):
    """A copy of the campaign in each of its states."""
    make_finished(talus, source, folder)
    keep(folder, "before")
    trials = len(list((folder / "out/trials").iterdir()))
    (folder / "hold").touch()
    adding = subprocess.Popen([talus, *ADD], cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while len(list((folder / "out/trials").iterdir())) == trials:
        assert adding.poll() is None
        time.sleep(0.01)
    adding.send_signal(signal.SIGKILL)
    adding.communicate()
    (folder / "hold").unlink()
    keep(folder, "recorded")
    run(talus, folder, *RESUME)
    keep(folder, "simulated")


def restore(folder, state):
    shutil.rmtree(folder / "out")
    shutil.copytree(folder / state, folder / "out")


def what_it_says(talus, folder, state):
    """All that is made of the campaign, and whether a word was said of damage."""
    text, noticed = "", False
    for verb in (GOES_ON[state], ("export", "out"),
                 ("consider", "out", "sliding_friction=0.5", "rolling_friction=0.3"), ("card", "out")):
        done = subprocess.run([talus, *verb], cwd=folder, capture_output=True, text=True)
        told = done.stdout + done.stderr
        noticed |= done.returncode != 0 or "damaged" in told or "made anew" in told
        assert done.returncode in (0, 1, 2), (verb, done.returncode, done.stderr)
        if verb[0] in ("consider", "card"):
            text += done.stdout
    for file in ("out/result.json", "out/export/trials.json"):
        text += (folder / file).read_text() if (folder / file).exists() else "gone"
    return re.sub(f'"({TIMES[state]})": .*', "", text), noticed


def flip(dice, folder):
    files = [file for pattern in READ for file in sorted((folder / "out").glob(pattern))]
    file = folder / "out/journal.sqlite" if dice.random() < 0.5 else dice.choice(files)
    content = bytearray(file.read_bytes())
    if not content:
        return flip(dice, folder)
    place, bit = dice.randrange(len(content)), dice.randrange(8)
    content[place] ^= 1 << bit
    file.write_bytes(content)
    return f"{file.relative_to(folder / 'out')}, byte {place}, bit {bit}"


def check(talus, folder, state, good, dice):
    """Whether a flip was said."""
    restore(folder, state)
    place = flip(dice, folder)
    text, said = what_it_says(talus, folder, state)
    if not said and text != good[state]:
        (folder / "other").write_text(text)
        (folder / "good").write_text(good[state])
        print(subprocess.run(["diff", "good", "other"], cwd=folder, capture_output=True, text=True).stdout[:2000])
        raise AssertionError(f"{place}, {state}: another answer without a word")
    return said


def main():
    arguments = chance_arguments("flips", 6)
    talus, dice = arguments.talus, random.Random(arguments.seed)
    noticed, good = dict.fromkeys(GOES_ON, 0), {}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name).resolve()
        make_states(talus, arguments.source, folder)
        for state in GOES_ON:
            restore(folder, state)
            good[state], said = what_it_says(talus, folder, state)
            assert not said, good[state]
        for i in range(arguments.flips):
            state = list(GOES_ON)[i % len(GOES_ON)]
            noticed[state] += check(talus, folder, state, good, dice)
    said = sum(noticed.values())
    print(f"{arguments.flips} bits turned over, {said} said, {arguments.flips - said} without effect; said by state: {noticed}")


main()
