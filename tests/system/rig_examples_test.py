#!/usr/bin/env python3
"""rig_examples_test.py TALUS SOURCE_DIR: every rig has an example that is simulated and gives the
numbers that docs/rigs.md names; and another engine serves every rig through templates, which see the
rig's keys and answer with numbers alone. Such a campaign is compared and reported, too."""
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

from commented_json import read_json

talus, source = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()

# The number that the deck gives, and what it makes it of.
NUMBERS = {
    "lifted_tube": ("mass_fallen", "mass_fallen_kg", "2e-5 * (1 - mu)", "10 mg", "1 mg"),
    "tapped_density": ("tapped_density", "tapped_density_kg_per_m3", "1000 * d / 0.02 + 300 * mr", "1090 kg/m^3", "5 kg/m^3"),
    "column_collapse": ("runout", "runout_m", "d * (1 - mu)", "10 mm", "0.5 mm"),
    "tilting_box": ("angle", "angle_deg", "30 + 20 * mu", "40 deg", "1 deg"),
    "draw_down": ("discharge_time", "discharge_time_s", "d / 0.06 * (1 + mu)", "1.5 s", "0.05 s"),
    "drum": ("angle", "angle_deg", "20 + 20 * mr + 10 * mu", "31 deg", "1 deg"),
    "orifice_flow": ("discharge_rate", "discharge_rate_kg_per_s", "d * (1 - mu)", "15 g/s", "0.5 g/s"),
    "spreading": ("thickness", "thickness_m", "d * (1 - mu)", "10 mm", "0.5 mm"),
    "shear_cell": ("internal_friction_angle", "internal_friction_angle_deg", "20 + 20 * mr + 10 * mu", "31 deg", "1 deg"),
    "funnel_heap": ("angle_of_repose_2", "angle_of_repose_2_deg", "20 + 20 * mr + 10 * mu", "31 deg", "1 deg"),
}
# What any heap of grains of 0.2 to 2 mm in a device of centimetres has, by the unit in the name: degrees are no radians,
# metres no millimetres.
BOUNDS = {"_kg_per_s": (1e-5, 0.1), "_deg": (0.05, 80), "_m": (1e-5, 0.2), "_kg_per_m3": (500, 2000), "_kg": (0, 0.1),
          "_s": (0.01, 60)}
# One unit that `value` is given in, in the unit of the deck's number.
UNITS = {"mg": 1e-6, "kg/m^3": 1, "mm": 1e-3, "deg": 1, "s": 1, "g/s": 1e-3}
LENGTHS = {"lifted_tube": None, "tapped_density": "diameter", "column_collapse": "length",
           "tilting_box": "length", "draw_down": "length", "drum": "diameter",
           "orifice_flow": "diameter", "funnel_heap": "plate_diameter", "spreading": "length", "shear_cell": "diameter"}
# Pages know numbers of an experiment, whatever rig gives them.
REPORTED = ("lifted_tube", "shear_cell")


def run(*arguments):
    done = subprocess.run([talus, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, (arguments, done.stdout[-2000:], done.stderr[-2000:])
    return done.stdout


def documented():
    """The observables of each rig, from the table in docs/rigs.md."""
    rows = re.findall(r"(?m)^\| `(\w+)` \| (`.*`) \| \w.* \|$", (source / "docs/rigs.md").read_text())
    return {rig: re.findall(r"`(\w+)`", names) for rig, names in rows}


def simulate_examples(root):
    known = documented()
    assert set(known) == set(NUMBERS), known
    for rig in known:
        path = source / ("examples/scenes/heap_case.json" if rig == "lifted_tube" else f"examples/rigs/{rig}.json")
        run("validate", path)
        if rig == "lifted_tube":  # of an eighth of its grains: ten seconds are a long time here
            case = read_json(path)
            case["coarse_graining"] = {"scale_factor": 2}
            path = root / "heap_case.json"
            path.write_text(json.dumps(case))
        run("simulate", path, "--out", root / rig)
        result = read_json(root / rig / "result.json")
        got = result["observables"]
        assert set(got) | set(result.get("undefined", {})) == set(known[rig]), (rig, got)
        for name, value in got.items():
            low, high = next((bounds for unit, bounds in BOUNDS.items() if name.endswith(unit)), (0, math.inf))
            assert low <= value <= high, (rig, name, value)
        assert (root / rig / "heap.vtp").exists()


def given_by_deck(trial, formula):
    """The number that the trial's deck has printed, worked out from what stands in its file."""
    values = dict(re.findall(r"-v (\w+)=(\S+)", (trial / "run.sh").read_text()))
    seed = float(values.pop("seed"))  # awk has no integers
    return eval(formula, {}, {name: float(value) for name, value in values.items()}) * (1 + seed % 7 / 2000)


def other_engine(root, rig):
    """A search and its answer for the rigs of REPORTED; of the others three trials and a confirming one."""
    key, metric, formula, value, sd = NUMBERS[rig]
    length = "0" if LENGTHS[rig] is None else "{{ rig_%s }}" % LENGTHS[rig]
    folder = root / ("deck_" + rig)
    (folder / "deck").mkdir(parents=True)
    kind = "lifted_tube" if LENGTHS[rig] is None else "{{ rig_kind }}"
    (folder / "deck/run.sh").write_text(
        f"""echo {kind} >kind
awk -v d={length} -v mu={{{{ sliding_friction }}}} -v mr={{{{ rolling_friction }}}} -v seed={{{{ seed }}}} \\
  'BEGIN {{ printf "{metric},%.9g\\n", ({formula}) * (1 + (seed % 7) / 2000) }}' >scalars.csv
""")
    experiment = {"name": "test", key: {"value": value, "sd": sd}}
    if LENGTHS[rig]:
        experiment["rig"] = {"kind": rig}
    if rig == "spreading":  # grains of 0.8 mm are too large for its defaults
        experiment["rig"].update({"length": "20 mm", "width": "6 mm", "feed": "10 mm"})
    if rig == "shear_cell":  # 1 g fills its default cell two grains high
        experiment["rig"].update({"diameter": "12 mm"})
    if rig == "funnel_heap":
        experiment["filling"] = {"kind": "pour"}
    spec = {"engine": {"kind": "command", "templates": "deck", "command": ["sh", "run.sh"]},
            "experiments": [experiment],
            "powder": {"material": {"density": 2500}, "sizes": {"kind": "mono", "diameter": "0.8 mm"}, "mass": "1 g"},
            "parameters": {"sliding_friction": {"min": 0.1, "max": 0.9},
                           "rolling_friction": {"min": 0.05, "max": 0.5}},
            "budget": {"simulations": 10}, "confirm": {"candidates": 1, "replicates": 2}, "seed": 2}
    if rig not in REPORTED:
        spec.update({"budget": {"simulations": 3}, "confirm": {"candidates": 1, "replicates": 1}})
    (folder / "campaign.json").write_text(json.dumps(spec))
    out = folder / "out"
    run("validate", folder / "campaign.json")
    run("calibrate", folder / "campaign.json", "--out", out)
    assert {p.read_text().strip() for p in out.glob("trials/*/kind")} == {rig}
    result = read_json(out / "result.json")
    confirmed = result["confirmed"][0]["experiments"][0]
    number = confirmed["scalars"][0]
    assert number["name"] == metric, number
    measured = result["experiments"][0]["numbers"][0]
    amount, unit = value.split()
    if rig not in REPORTED:
        assert confirmed["num_trials"] == 1, confirmed
        given = given_by_deck(out / "trials/0004", formula) / float(amount) / UNITS[unit]
        assert abs(number["mean"] / measured["value"] / given - 1) < 1e-6, (rig, number, given)
        return
    assert confirmed["num_trials"] == 2, confirmed
    # Ten trials find a set within a few errors of what was measured.
    assert abs(number["mean"] - measured["value"]) < 4 * measured["standard_error"], (rig, number)
    assert "best of the trials" in run("compare", out)
    run("report", out)
    page = (out / "report/report.html").read_text()
    data = json.loads(page.split('id="data">')[1].split("</script>")[0])
    assert data["pictures"] == [] and len(data["headline"]["fit"]) == 1, data["headline"]["fit"]


with tempfile.TemporaryDirectory(prefix="talus_rigs_") as name:
    simulate_examples(pathlib.Path(name))
    for rig_kind in NUMBERS:
        other_engine(pathlib.Path(name), rig_kind)
