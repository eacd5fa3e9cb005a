#!/usr/bin/env python3
"""notebooks_test.py TALUS SOURCE_DIR MODULE_DIR: the Python of docs/notebooks.md runs on a small campaign."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

talus, source = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
PYTHON = "/usr/bin/python3"  # Debian's, which sees Debian's modules
NEEDED = ("pandas", "matplotlib", "vtkmodules.vtkIOXML")
DECK = "printf 'x,y,z,r\\n0,0,5e-4,{{ sliding_friction }}e-3\\n' >heap.csv\n"


def campaign(root):
    (root / "deck").mkdir()
    (root / "deck/run.sh").write_text(DECK)
    spec = {
        "engine": {"kind": "command", "templates": "deck", "command": ["sh", "run.sh"]},
        "experiment": {"photos": str(source / "examples/photos/powder_a"),
                       "pattern": "run{run}_view{view}.jpg", "plate_diameter": "10 mm",
                       "pixel_size": "100 um"},
        "powder": {"material": {"density": 2500}, "sizes": {"kind": "mono", "diameter": "1 mm"}, "mass": "0.3 g"},
        "parameters": {"sliding_friction": {"min": 1, "max": 2}},
        "strategy": {"kind": "sobol", "num_points": 5},
        "budget": {"simulations": 5},
        "noise": {"replicates": 0},
        "confirm": {"candidates": 0},
    }
    (root / "campaign.json").write_text(json.dumps(spec))
    subprocess.run([talus, "calibrate", root / "campaign.json", "--out", root / "out"], check=True,
                   stdout=subprocess.DEVNULL)
    return root / "out"


def run(code, argument):
    found = subprocess.run([PYTHON, "-c", code, str(argument)], check=True, capture_output=True,
                           text=True)
    return found.stdout


def main(root):
    for module in NEEDED:
        if subprocess.run([PYTHON, "-c", "import " + module], stderr=subprocess.DEVNULL).returncode:
            print(module + " is not installed for " + PYTHON)
            return 77
    os.environ["PATH"] = str(talus.parent) + ":" + os.environ["PATH"]
    os.environ["PYTHONPATH"] = sys.argv[3]
    os.environ["MPLBACKEND"] = "Agg"
    os.environ["MPLCONFIGDIR"] = str(root)
    text = (source / "docs/notebooks.md").read_text()
    convergence, journal, heap = re.findall(r"```python\n(.*?)```", text, re.S)
    out = campaign(root)
    run(convergence, out)
    assert (out / "convergence.png").read_bytes().startswith(b"\x89PNG")
    assert len(run(journal, out).splitlines()) == 5
    said = run(heap, out / "trials/0001/heap.vtp")
    found = re.fullmatch(r"1 grains, the highest reaches (\S+) m\n?", said)
    friction = float(re.search(r"4,(\S+)e-3", (out / "trials/0001/run.sh").read_text())[1])
    assert abs(float(found[1]) - (5e-4 + friction * 1e-3)) < 1e-6, (said, friction)
    return 0


with tempfile.TemporaryDirectory(prefix="talus_notebooks_") as folder:
    sys.exit(main(pathlib.Path(folder)))
