#!/usr/bin/env python3
"""bad_input_test.py TALUS SOURCE_DIR: every bad input ends with exit status 2, names file, place and
remedy, and touches nothing.

The table is tests/system/bad_inputs.txt: one row a case, with columns parted by " | ".

    FILE | PLACE = VALUE | EXPECTED | EXPECTED | …

FILE is a good input (below); the value at the PLACE in it is replaced by the JSON VALUE, or taken away
by "PLACE -". Each EXPECTED must be in the message. A row "$ ARGUMENTS | EXPECTED | …" runs talus with
these arguments instead, in a folder with good files; \\e in it is the escape character, and "done" a
finished campaign, with other_powder.json beside it, the same spec with more powder. "learnt" is one with enough
simulations for a posterior, which is the prior of learnt_denser.json, learnt_elsewhere.json, learnt_other.json
and learnt_more.json.
"""
import concurrent.futures
import contextlib
import functools
import hashlib
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import threading
import time

from commented_json import without_comments
from quick_campaign import PILE

TALUS = sys.argv[1]
SOURCE = pathlib.Path(sys.argv[2])
ROWS = SOURCE / "tests/system/bad_inputs.txt"
# What a library would say, which nobody can act on.
RAW = ("json.exception", "filesystem error", "OpenCV", "std::", "terminate called", "basic_string",
       "what():", "Assertion", "please report", "Could not convert")
MOST_SECONDS = 60  # of processor time
LONGEST_WAIT = 300  # [s]; on a machine with other work they take long
MOST_MEGABYTES = 512  # the sanitizers take their share
CONTROLS = re.compile("[\x00-\x08\x0b-\x1f\x7f\x80-\x9f]")  # but tab and line break


@functools.cache
def plain_text(name):
    return without_comments((SOURCE / "examples" / name).read_text())


def example(name):
    return json.loads(plain_text(name))


def spec():
    good = example("demo/campaign.json")
    good["experiment"]["photos"] = str(SOURCE / "examples/photos/powder_a")
    good["coarse_graining"] = {"scale_factor": 1.5}  # one grain size, so that all strategies serve
    good["budget"] = {"simulations": 30}
    good["noise"] = {"replicates": 3}
    return good


def joint():
    good = example("demo/two_tests.json")
    for experiment, folder in zip(good["experiments"], ("powder_a", "powder_a_wide")):
        experiment["photos"] = str(SOURCE / "examples/photos" / folder)
    good["experiments"][1]["device"]["plate_material"] = {"name": "glass", "sliding_friction": 0.3}
    return good


def paired():
    good = example("scenes/bouncing_pair.json")
    good["materials"].append({"name": "steel"})
    good["walls"][0]["material"] = "steel"
    good["pairs"] = [{"between": ["glass", "steel"], "sliding_friction": 0.2}]
    return good


def searched_pair():
    good = spec()
    good["parameters"] = {"sliding_friction": {"min": 0.1, "max": 0.9},
                          "plate_pair_sliding_friction": {"min": 0.05, "max": 0.5}}
    return good


def command_case():
    good = example("scenes/heap_case.json")
    good["engine"] = {"kind": "command", "templates": "deck", "command": ["sh", "run.sh"]}
    del good["engine"]["kind"]
    return good


def without_device():
    good = example("scenes/heap_case.json")
    del good["device"]
    return good


GOOD = {  # name: content, and how it is tried
    "spec": (spec, ["validate", "{}"]),
    "joint": (joint, ["validate", "{}"]),
    "searched_pair": (searched_pair, ["validate", "{}"]),
    "case": (lambda: example("scenes/heap_case.json"), ["simulate", "{}", "--out", "new"]),
    "rig": (without_device, ["simulate", "{}", "--out", "new"]),
    "command": (command_case, ["simulate", "{}", "--out", "new"]),
    "scene": (lambda: example("scenes/bouncing_pair.json"), ["simulate", "{}", "--out", "new"]),
    "stepped": (lambda: {**example("scenes/bouncing_pair.json"), "time_step": 1e-7},
                ["simulate", "{}", "--out", "new"]),
    "paired": (paired, ["simulate", "{}", "--out", "new"]),
    "packing": (lambda: example("scenes/packing.json"), ["simulate", "{}", "--out", "new"]),
    "problem": (lambda: example("optimize/bowl.json"),
                ["optimize", "{}", "--out", "new.json", "--", "cat"]),
}


def finished_campaign(folder):
    """What the rows call "done"."""
    (folder / "heap_deck").mkdir()
    (folder / "heap_deck/run.sh").write_text(PILE)
    small = spec()
    small["experiment"].update(pattern="run01_view{view}.jpg", pixel_size="200 um")
    small["parameters"] = {"sliding_friction": {"min": 0.1, "max": 0.9}}
    small["engine"] = {"kind": "command", "templates": "heap_deck", "command": ["sh", "run.sh"],
                       "result": "heap.csv"}
    small.update(budget={"simulations": 4}, noise={"replicates": 2},
                 confirm={"candidates": 1, "replicates": 2}, workers=1)
    (folder / "begun.json").write_text(json.dumps(small))
    other = {**small, "powder": {**small["powder"], "mass": "1.7 g"}}
    (folder / "other_powder.json").write_text(json.dumps(other))
    subprocess.run([TALUS, "calibrate", "begun.json", "--out", "done", "--quiet"], cwd=folder,
                   check=True)
    return small


def learnt_campaign(folder, small):
    """What the rows call "learnt", and specs that it can be no prior of."""
    enough = {**small, "budget": {"simulations": 14}}
    (folder / "begun.json").write_text(json.dumps(enough))
    subprocess.run([TALUS, "calibrate", "begun.json", "--out", "learnt", "--quiet"], cwd=folder, check=True)
    prior = {"from": "learnt"}
    material = {**small["powder"].get("material", {}), "density": "8000 kg/m^3"}
    (folder / "learnt_denser.json").write_text(json.dumps(
        {**small, "powder": {**small["powder"], "material": material},
         "parameters": {**small["parameters"], "prior": prior}}))
    (folder / "learnt_elsewhere.json").write_text(json.dumps(
        {**small, "parameters": {"sliding_friction": {"min": 0.895, "max": 0.9}, "prior": prior}}))
    del small["engine"]  # its deck has no rolling friction
    rolling = {"min": 0.1, "max": 0.4}
    (folder / "learnt_other.json").write_text(json.dumps(
        {**small, "parameters": {"rolling_friction": {**rolling, "prior": prior}}}))
    (folder / "learnt_more.json").write_text(json.dumps(
        {**small, "parameters": {"rolling_friction": rolling, "prior": prior}}))


def replaced(root, place, value):
    """`value` at "a.b[3].c"; taken away if it is None; appended at "[+]"."""
    steps = [int(s[1:-1]) if s[1:-1].isdigit() else s for s in re.findall(r"\[[^]]*\]|[^.\[]+", place)]
    at = root
    for step in steps[:-1]:
        at = at.setdefault(step, {}) if isinstance(at, dict) else at[step]
    if steps[-1] == "[+]":
        at.append(value)
    elif value is None:
        del at[steps[-1]]
    else:
        at[steps[-1]] = value
    return root


@functools.cache
def good_text(name):
    return json.dumps(GOOD[name][0](), indent=1)


def good_folder(folder):
    (folder / "deck").mkdir()
    (folder / "deck/run.sh").write_text("exit 3 # {{ sliding_friction }} {{ rolling_friction }}\n")
    (folder / "mine").mkdir()
    (folder / "mine/thesis.txt").write_text("years of work\n")
    for name in GOOD:
        (folder / f"{name}.json").write_text(good_text(name))
    (folder / "text.json").write_text("not JSON\n")
    (folder / "empty.json").write_text("")
    (folder / "white.png").write_bytes(bytes.fromhex(
        "89504e470d0a1a0a0000000d4948445200000001000000010800000000"
        "3a7e9b550000000a49444154789c63f80f0001010100")[:60])
    (folder / "spheres.csv").write_text("x,y,z\n1,2,3\n")
    (folder / "link").symlink_to("nowhere")
    os.mkfifo(folder / "pipe")
    (folder / "blocked").mkdir()
    os.mkfifo(folder / "blocked/run01_view01.jpg")
    (folder / "weighed.json").write_text('{"runout": {"value": "9 mm", "sd": "1 mm"}}')
    (folder / "other_laws.json").write_text(json.dumps(
        {**example("scenes/heap_case.json"), "models": {"rolling": "constant"}}))
    (folder / "fixed_pair.json").write_text(json.dumps(
        {**example("scenes/heap_case.json"),
         "pairs": [{"between": ["powder", "plate"], "sliding_friction": 0.2}]}))
    plan = {k: v for k, v in spec().items() if k not in ("experiment", "budget", "strategy")}
    (folder / "plan.json").write_text(json.dumps(plan))
    (folder / "degrees.json").write_text('{"angle_of_repose_1": {"value": 33, "sd": "1 deg"}}')
    (folder / "levels.json").write_text(json.dumps(
        {"parameters": [{"name": "rpm", "levels": [10, 20]}], "evaluations": 2, "strategy": {"kind": "grid"}}))
    (folder / "further.json").write_text(
        '{"name": "plate", "mass_fallen": {"value": "21 mg", "sd": "2 mg"}}')


def state(folder):
    """Everything in it, by name and content, but what tells processes of each other."""
    return {str(p.relative_to(folder)): hashlib.sha256(p.read_bytes()).hexdigest() if p.is_file() else "no file"
            for p in folder.rglob("*")
            if not p.is_file() or (p.name not in ("campaign.lock", "journal.sqlite-shm")
                                   and (p.stat().st_size > 0 or p.name != "journal.sqlite-wal"))}


def run(arguments, folder):
    """Exit status, message and peak memory in MB; no status if it takes too long."""
    with open(folder.parent / f"{folder.name}.message", "w+b") as message:
        process = subprocess.Popen([TALUS, *arguments], cwd=folder, stdin=subprocess.DEVNULL,
                                   stdout=message, stderr=message)
        deadline = time.monotonic() + LONGEST_WAIT
        pid, status, usage = 0, 0, None
        while pid == 0 and time.monotonic() < deadline:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            time.sleep(0 if pid else 0.003)
        if pid == 0:
            process.kill()
            process.wait()
            return None, "", 0
        process.returncode = os.waitstatus_to_exitcode(status)
        if usage.ru_utime + usage.ru_stime > MOST_SECONDS:
            return None, "", 0
        message.seek(0)
        words = message.read().decode(errors="backslashreplace")
        return process.returncode, words, usage.ru_maxrss // 1024


class Folders(threading.local):
    """A folder of good files a thread, used again as long as nobody has touched it."""
    kept = None

    @contextlib.contextmanager
    def one(self):
        if self.kept is None:
            self.kept = tempfile.TemporaryDirectory()
            folder = pathlib.Path(self.kept.name) / "here"
            folder.mkdir()
            good_folder(folder)
            self.good = state(folder)
        folder = pathlib.Path(self.kept.name) / "here"
        yield folder
        for name in GOOD:
            path = folder / f"{name}.json"
            if path.exists() and path.read_text() != good_text(name):
                path.write_text(good_text(name))
        if state(folder) != self.good:
            self.kept.cleanup()
            self.kept = None


FOLDERS = Folders()


def check(row, done):
    """What is wrong with the answer to the row; empty if nothing is."""
    number, text = row
    case, *rest = [column.strip() for column in text.split(" | ")]
    with FOLDERS.one() as folder:
        if case.startswith("$"):
            arguments, expected = shlex.split(case[1:].replace("\\e", "\x1b")), rest
            if "done" in arguments:
                shutil.copytree(done / "done", folder / "done")
                shutil.copytree(done / "heap_deck", folder / "heap_deck")
                shutil.copy(done / "other_powder.json", folder)
            if arguments and arguments[-1].startswith("learnt"):
                for path in ("learnt", "heap_deck"):
                    shutil.copytree(done / path, folder / path)
                shutil.copy(done / arguments[-1], folder)
        else:
            change, expected = rest[0], rest[1:]
            content, arguments = GOOD[case]
            place, _, value = change.partition(" = ")
            new = None if place.endswith(" -") else json.loads(value, parse_constant=float)
            bad = replaced(content(), place.removesuffix(" -"), new)
            (folder / f"{case}.json").write_text(
                json.dumps(bad, indent=1).replace("Infinity", "1e400").replace("NaN", "nan"))
            arguments = [argument.replace("{}", f"{case}.json") for argument in arguments]
            key = re.split(r"[.\[ ]", place)[0]
            if expected[0].startswith(key):  # else the message is of a file that the input names
                expected = expected + [f"{case}.json:"]
        before = state(folder)
        status, message, megabytes = run(arguments, folder)
        if status is None:
            return f"row {number}: {text}\n  takes more than {MOST_SECONDS} s"
        wrong = []
        if status != 2:
            wrong.append(f"exit status {status}, not 2")
        if megabytes > MOST_MEGABYTES:
            wrong.append(f"takes {megabytes} MB")
        if CONTROLS.search(message):
            wrong.append("sends a control character to the terminal")
        wrong += [f"does not say {e!r}" for e in expected if e not in message]
        wrong += [f"says {raw!r}" for raw in RAW if raw in message]
        wrong += [f"touches {path}" for path in sorted(set(before.items()) ^ set(state(folder).items()))]
        if wrong:
            return f"row {number}: {text}\n  " + "\n  ".join(wrong) + f"\n  message: {message[:600]}"
    return ""


def main():
    rows = [(number, line) for number, line in enumerate(ROWS.read_text().splitlines(), 1)
            if line.strip() and not line.startswith("#")]
    verbs = {line.split()[0] for line in subprocess.run(
        [TALUS, "--help"], capture_output=True, text=True, check=True
    ).stdout.split("Subcommands:")[1].splitlines() if line.strip()}
    tried = {shlex.split(line[1:].split(" | ")[0])[0] for _, line in rows if line.startswith("$ ") and
             shlex.split(line[1:].split(" | ")[0])}
    assert verbs <= tried, f"these verbs have no row: {verbs - tried}"
    with tempfile.TemporaryDirectory() as name, concurrent.futures.ThreadPoolExecutor(2) as pool:
        done = pathlib.Path(name)
        learnt_campaign(done, finished_campaign(done))
        faults = [fault for fault in pool.map(lambda row: check(row, done), rows) if fault]
    for fault in faults:
        print(fault)
    print(f"{len(rows)} bad inputs, {len(faults)} of them not refused as they should be")
    assert len(rows) >= 980, "the table has lost rows"
    sys.exit(1 if faults else 0)


main()
