#!/usr/bin/env python3
"""flip_test.py TALUS SOURCE_DIR [--flips N]: one bit turned over in a campaign's folder.

In a file that the program reads again, of a campaign of two tests at three scale factors: the second was just added,
or has been simulated. Each flip is harmless, so that trials and answer are the same bits, or it is said. Every second
flip is in the journal. `bench/kills` runs it with more flips.
"""
import argparse
import pathlib
import random
import re
import shutil
import subprocess
import tempfile

from two_experiments_campaign import make_finished, run

READ = ("journal.sqlite", "campaign.json", "result.json", "*.png", "trials/*/trial.json", "trials/*/profile.png",
        "trials/*/heap.csv")


def what_it_says(talus, folder):
    """All that is made of the campaign, and whether a word was said of damage."""
    text, noticed = "", False
    for verb in (("resume", "out"), ("export", "out"), ("consider", "out", "sliding_friction=0.5", "rolling_friction=0.3"),
                 ("card", "out")):
        done = subprocess.run([talus, *verb], cwd=folder, capture_output=True, text=True)
        told = done.stdout + done.stderr
        noticed |= done.returncode != 0 or "damaged" in told or "made anew" in told
        assert done.returncode in (0, 1, 2), (verb, done.returncode, done.stderr)
        if verb[0] in ("consider", "card"):
            text += done.stdout
    for file in ("out/result.json", "out/export/trials.json"):
        text += (folder / file).read_text() if (folder / file).exists() else "gone"
    return re.sub('"elapsed_s": .*', "", text), noticed


def flip(dice, folder):
    files = [file for pattern in READ for file in sorted((folder / "out").glob(pattern))]
    file = folder / "out/journal.sqlite" if dice.random() < 0.5 else dice.choice(files)
    content = bytearray(file.read_bytes())
    if not content:
        return flip(dice, folder)
    place = dice.randrange(len(content))
    content[place] ^= 1 << dice.randrange(8)
    file.write_bytes(content)
    return f"{file.relative_to(folder / 'out')}, byte {place}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("talus", type=pathlib.Path)
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("--flips", type=int, default=12)
    arguments = parser.parse_args()
    talus, source = arguments.talus.resolve(), arguments.source.resolve()
    dice = random.Random(3)
    harmless, noticed = 0, 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name).resolve()
        make_finished(talus, source, folder)
        run(talus, folder, "add-experiment", "out", "wide.json", "--core-time", "50 ms")
        run(talus, folder, "resume", "out")
        shutil.copytree(folder / "out", folder / "good")
        good, said = what_it_says(talus, folder)
        assert not said, good
        for _ in range(arguments.flips):
            shutil.rmtree(folder / "out")
            shutil.copytree(folder / "good", folder / "out")
            place = flip(dice, folder)
            text, said = what_it_says(talus, folder)
            assert said or text == good, f"{place}: another answer without a word"
            noticed += said
            harmless += not said
    print(f"{harmless + noticed} bits turned over, {noticed} said, {harmless} without effect")


main()
