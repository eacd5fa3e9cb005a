#!/usr/bin/env python3
"""full_disk_test.py TALUS FULL_DISK_SO SOURCE_DIR: the disk is full from the first write of a verb on,
from the second on, and so on to the last.

Each time talus must say so and end with status 1, or do what it does with a full disk all the same; and
when there is room again, the same command must come to what it comes to on a disk with room.
"""
import concurrent.futures
import contextlib
import json
import os
import pathlib
import shutil
import sqlite3
import subprocess
import sys
import tempfile

from quick_campaign import PILE

TALUS, FULL_DISK, SOURCE = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
# How many writes of a verb fail: every one if it has no more, else as many spread over all.
MOST_MOMENTS = int(os.environ.get("TALUS_FULL_DISK_MOMENTS", 6))

SPEC = {
    "name": "quick",
    "experiment": {"photos": str(SOURCE / "examples/photos/powder_a"),
                   "pattern": "run01_view{view}.jpg", "plate_diameter": "10 mm",
                   "pixel_size": "200 um"},
    "powder": {"material": {"density": "4386 kg/m^3"},
               "sizes": {"kind": "mono", "diameter": "0.6 mm"}, "mass": "1.6 g"},
    "device": {"tube_inner_diameter": "10 mm", "plate_diameter": "10 mm"},
    "parameters": {"sliding_friction": {"min": 0.1, "max": 0.9}},
    "engine": {"kind": "command", "templates": "deck", "command": ["sh", "run.sh"],
               "result": "heap.csv"},
    "strategy": {"kind": "sobol", "num_points": 2}, "workers": 1,
    "budget": {"simulations": 2}, "noise": {"replicates": 0}, "confirm": {"candidates": 0},
}
# A campaign of images alone, with a posterior: it can be asked what to do next, and take a
# further test.
LEARNING = {**SPEC, "strategy": {"kind": "auto"}, "budget": {"simulations": 8},
            "coarse_graining": {"scale_factors": [1.5]}}
FURTHER = {"name": "plate", "mass_fallen": {"value": "300 mg", "sd": "50 mg"}}
SCENE = {
    "materials": [{"name": "a", "youngs_modulus": "1 MPa"}],
    "spheres": [{"diameter": "1 mm", "position": [0, 0, "2 mm"]}], "walls": [{"shape": "plane"}],
    "outputs": {"times": [0, 0.001]}, "stop": {"time": 0.002},
}
CASE = {"powder": SPEC["powder"], "device": SPEC["device"],
        "frame": {"width_px": 60, "height_px": 40, "pixel_size": "200 um", "center_x_px": 30, "baseline_px": 36,
                  "plate_diameter": "10 mm"}}
PROBLEM = {"parameters": [{"name": "a", "low": 0, "high": 1}], "evaluations": 3,
           "strategy": {"kind": "sobol", "num_points": 3}}


def talus(arguments, folder, **environment):
    # Sanitizers want to be loaded first, which nothing here needs.
    preload = {"LD_PRELOAD": FULL_DISK, "TALUS_FULL_IN": str(pathlib.Path(TALUS).resolve()),
               "OMP_WAIT_POLICY": "passive"}
    return subprocess.run([TALUS, *arguments], cwd=folder, capture_output=True, text=True,
                          env={**os.environ, **preload, **environment}, timeout=600)


def inputs(folder):
    (folder / "deck").mkdir()
    (folder / "deck/run.sh").write_text(PILE)
    (folder / "evaluate.sh").write_text("cat >/dev/null; echo '{\"value\": 1}'\n")
    for name, content in [("spec", SPEC), ("learning", LEARNING), ("further", FURTHER), ("scene", SCENE),
                          ("problem", PROBLEM), ("case", CASE)]:
        (folder / f"{name}.json").write_text(json.dumps(content))


def campaign_answer(folder):
    """What two runs of one campaign have in common."""
    subprocess.run([TALUS, "export", "out", "--out", "exported"], cwd=folder, check=True,
                   capture_output=True)
    trials = json.loads((folder / "exported/trials.json").read_text())["trials"]
    result = json.loads((folder / "out/result.json").read_text())
    return ([(t["id"], t["unit_point"], t["seed"], t["status"], t["metrics"]) for t in trials],
            result["parameters"])


def spec_of(folder):
    """What the campaign is to do by now."""
    with contextlib.closing(sqlite3.connect(folder / "out/journal.sqlite")) as journal:
        return json.loads(journal.execute("SELECT spec_json FROM campaign").fetchone()[0])


# What is not done again when it has been done: the budget is raised, the test is there.
def extend_again(folder):
    more = [] if spec_of(folder)["budget"]["simulations"] == 9 else ["--add-simulations", "1"]
    return ["resume", "out", "--quiet", *more]


def add_again(folder):
    if "plate" in json.dumps(spec_of(folder).get("experiments", [])):
        return ["resume", "out", "--quiet"]
    return ["add-experiment", "out", "further.json", "--core-time", "1 ms", "--quiet"]


# Its budget is of core time, so that no two runs have the same trials.
def is_answered_with_both(folder):
    told = talus(["consider", "out", "--alone"], folder).stdout
    return "heap" in told and "plate" in told


def content(*names):
    return lambda folder: [(folder / name).read_bytes() for name in names]


def every_file(place):
    """Which files there are, and which of them are empty."""
    return lambda folder: sorted((str(path.relative_to(folder)), path.stat().st_size == 0)
                                 for path in (folder / place).rglob("*") if path.is_file())


def without(key, name):
    def answer(folder):
        parsed = json.loads((folder / name).read_text())
        parsed.pop(key)
        parsed.pop("checksum_xxh3")
        return parsed
    return answer


PHOTO = str(SOURCE / "examples/photos/powder_a/run01_view01.jpg")
VERBS = {  # name: what is done before, the verb, what goes on when there is room again, its answer
    "calibrate": ([], ["calibrate", "spec.json", "--out", "out", "--quiet"],
                  ["resume", "out", "--quiet"], campaign_answer),
    "resume": (["calibrate", "learning.json", "--out", "out", "--quiet"],
               ["resume", "out", "--add-simulations", "1", "--quiet"], extend_again, campaign_answer),
    "add-experiment": (["calibrate", "learning.json", "--out", "out", "--quiet"],
                       ["add-experiment", "out", "further.json", "--core-time", "1 ms", "--quiet"], add_again,
                       is_answered_with_both),
    "next": (["calibrate", "learning.json", "--out", "out", "--quiet"], ["next", "out"], None,
             content("out/next/next.json")),
    "sensitivity": (["calibrate", "learning.json", "--out", "out", "--quiet"],
                    ["sensitivity", "out", "rolling_damping=0.2"], None, content("out/sensitivity.json")),
    "predict": (["calibrate", "learning.json", "--out", "out", "--quiet"],
                ["predict", "out", "case.json", "--draws", "2", "--seeds", "1"], None,
                content("out/predict/case/draws.csv", "out/predict/case/most_different.png")),
    "simulate": ([], ["simulate", "scene.json", "--out", "out"], None, without("timing", "out/result.json")),
    "optimize": ([], ["optimize", "problem.json", "--out", "out", "--quiet", "--", "sh", "evaluate.sh"],
                 None, content("out/result.json")),
    "measure": ([], ["measure", PHOTO, "--plate-diameter", "10mm", "--out", "out"], None,
                content("out/aehp.png", "out/aehp.json")),
    "init": ([], ["init", PHOTO, "--out", "new.json", "--plate-diameter", "10mm", "--tube-diameter",
                  "10mm", "--lift-velocity", "1cm/s", "--mass", "1g", "--density", "4g/cm^3",
                  "--grain-diameter", "0.1mm"], None, content("new.json")),
    "report": (["calibrate", "spec.json", "--out", "out", "--quiet"],
               ["report", "out", "--out", "page"], None, every_file("page")),
    "export": (["calibrate", "spec.json", "--out", "out", "--quiet"],
               ["export", "out", "--out", "table"], None, content("table/trials.csv")),
    "compare": (["calibrate", "spec.json", "--out", "out", "--quiet"],
                ["compare", "out", "--out", "table"], None, every_file("table")),
}


def check(name, moment, fresh, calm):
    """What is wrong when the disk is full from the `moment`th write on; empty if nothing is."""
    _, verb, again, answer = VERBS[name]
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch) / "here"
        shutil.copytree(fresh, folder)
        full = talus(verb, folder, TALUS_FULL_FROM=str(moment))
        wrong = []
        if full.returncode not in (0, 1):
            wrong.append(f"exit status {full.returncode}")
        if full.returncode == 1 and not any(
                words in full.stderr for words in ("No space left", "disk is full", "is the disk full")):
            wrong.append("does not say that the disk is full")
        begun = again and (folder / "out/campaign.json").exists()
        if full.returncode != 0 or name == "calibrate":
            if callable(again):
                again, begun = again(folder), True
            elif again and not begun:
                shutil.rmtree(folder / "out", ignore_errors=True)
            rest = talus(again if begun else verb, folder)
            if rest.returncode != 0:
                wrong.append(f"with room again: {rest.returncode}: {rest.stderr}")
        if not wrong and answer(folder) != calm:
            wrong.append("comes to another answer")
        if wrong:
            return f"{name}, full from write {moment} on: {'; '.join(wrong)}\n  {full.stderr[:400]}"
    return ""


def made_before(before, root):
    """A folder with the inputs and with what the command `before` has left; several verbs come after one of them."""
    folder = root / "_".join(["inputs", *before[1:2]])
    if not folder.exists():
        folder.mkdir()
        inputs(folder)
        if before:
            assert talus(before, folder).returncode == 0
    return folder


def main():
    faults = []
    root = tempfile.TemporaryDirectory()
    for name, (before, verb, _, answer) in VERBS.items():
        with tempfile.TemporaryDirectory() as scratch:
            fresh, used = made_before(before, pathlib.Path(root.name)), pathlib.Path(scratch) / "used"
            shutil.copytree(fresh, used)
            counted = pathlib.Path(scratch) / "count"
            done = talus(verb, used, TALUS_FULL_COUNT=str(counted))
            assert done.returncode == 0, (name, done.stderr)
            writes, calm = int(counted.read_text()), answer(used)
            assert writes > 0, f"{name}: nothing was written, or not counted"
            assert calm, f"{name}: comes to no answer"
            step = max(1, -(-writes // MOST_MOMENTS))
            moments = range(1, writes + 1, step)
            with concurrent.futures.ThreadPoolExecutor(2) as pool:
                found = [fault for fault in
                         pool.map(lambda moment: check(name, moment, fresh, calm), moments) if fault]
            print(f"{name}: {writes} writes, {len(moments)} moments, {len(found)} faults", flush=True)
            faults += found
    print("\n".join(faults))
    sys.exit(1 if faults else 0)


main()
