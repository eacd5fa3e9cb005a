"""A finished campaign of one test at three scale factors, whose heaps a shell script draws, and a second test to add
to it: what the tests that kill and damage campaigns begin with. No heap is drawn while folder/hold stands."""
import json
import subprocess

from kill_test import make_spec

SIMULATIONS = 6


def make_finished(talus, source, folder):
    """The campaign in folder/out; its second test is folder/wide.json."""
    make_spec(source, folder, SIMULATIONS, True)
    spec = json.loads((folder / "spec.json").read_text())
    wide = spec["experiments"].pop()
    (folder / "spec.json").write_text(json.dumps(spec))
    (folder / "wide.json").write_text(json.dumps(wide))
    deck = (folder / "deck/run.sh").read_text()
    (folder / "deck/run.sh").write_text(deck.replace(
        "setsid sleep 300 &\n(sleep 300 &)\nsleep 0.05\n", f"while [ -e '{folder}/hold' ]; do sleep 0.01; done\n"))
    run(talus, folder, "calibrate", "spec.json", "--out", "out")


def run(talus, folder, *arguments):
    done = subprocess.run([talus, *arguments], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, (arguments, done.stdout + done.stderr)
    return done.stdout
