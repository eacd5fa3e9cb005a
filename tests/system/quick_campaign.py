"""Specs of campaigns that end in seconds: one run of powder A's photographs, one parameter, and a command in the folder
`deck` for an engine; and two tests of one powder by our own engine."""
import json
import subprocess

# An engine that takes no time: a pile whose height follows the friction, steeper than any photographed heap.
PILE = """#!/bin/sh
awk 'BEGIN {
  print "x_m,y_m,z_m,diameter_m"
  for (i = -8; i <= 8; ++i) for (j = -8; j <= 8; ++j)
    for (k = 0; k < 12 * {{ sliding_friction }} - (i * i + j * j) / 12; ++k)
      printf "%g,%g,%g,6e-4\\n", i * 5.9e-4, j * 5.9e-4, 3e-4 + k * 5.9e-4
}' > heap.csv
"""


def quick_spec(source, name, command, **more):
    """`source`: the project's folder; `more`: further keys, or others in place of these."""
    return {
        "name": name,
        "experiment": {"photos": str(source / "examples/photos/powder_a"),
                       "pattern": "run01_view{view}.jpg", "plate_diameter": "10 mm",
                       "pixel_size": "200 um"},
        "powder": {"material": {"density": "4386 kg/m^3", "youngs_modulus": "26.25 MPa",
                                "poisson_ratio": 0.342, "restitution": 0.9},
                   "sizes": {"kind": "mono", "diameter": "0.6 mm"}, "mass": "1.6 g"},
        "device": {"tube_inner_diameter": "10 mm", "plate_diameter": "10 mm"},
        "parameters": {"sliding_friction": {"min": 0.1, "max": 0.9}},
        "engine": {"kind": "command", "templates": "deck", "command": command, "result": "heap.csv"},
        "budget": {"simulations": 4}, "noise": {"replicates": 2},
        "confirm": {"candidates": 1, "replicates": 2}, "seed": 1, **more,
    }


def tube_and_drum(talus, folder):
    """Runs a campaign of two tests by our own engine, some hundred soft grains each, in `folder`/run: five heaps
    with what fell beside them, and the angle of a drum. Returns what the terminal said."""
    frame = {"width_px": 120, "height_px": 80, "pixel_size": 1e-4, "center_x_px": 60, "baseline_px": 70,
             "plate_diameter": 0.01}
    powder = {"sizes": {"kind": "mono", "diameter": "1 mm"}, "mass": "0.3 g", "material": {"density": 2500, "youngs_modulus": "1 MPa"}}
    device = {"lift_velocity": "5 cm/s"}
    truth = {**powder, "material": {**powder["material"], "sliding_friction": 0.4, "rolling_friction": 0.2}}
    folder.mkdir(parents=True)
    fallen, runs = [], []
    for seed in range(1, 6):
        name = f"heap{seed}"
        case = {"powder": truth, "device": device, "frame": frame, "num_views": 1, "seed": seed}
        (folder / f"{name}.json").write_text(json.dumps(case))
        subprocess.run([talus, "simulate", folder / f"{name}.json", "--out", folder / name, "--quiet"], check=True)
        fallen.append(json.loads((folder / name / "result.json").read_text())["observables"]["mass_fallen_kg"])
        runs.append({"name": str(seed), "photos": [f"{name}/profile.png"]})
    spec = {
        "name": "tube and drum",
        "experiments": [
            {"name": "heap", "runs": runs, "plate_diameter": "10 mm", "frame": frame, "mass_fallen": {"value": sum(fallen) / len(fallen), "sd": "10 mg"}},
            {"name": "mixer", "rig": {"kind": "drum", "diameter": "16 mm", "width": "5 mm", "speed": "60 rpm",
                                      "start_turns": 0.2, "turns": 0.25},
             "mass": "0.6 g", "angle": {"value": "43 deg", "sd": "2 deg"}}],
        "powder": powder, "device": device,
        "parameters": {"sliding_friction": {"min": 0.1, "max": 0.9}, "rolling_friction": {"min": 0.02, "max": 0.6}},
        "budget": {"simulations": 26}, "confirm": {"replicates": 2}, "next": {"share": 0.6}, "seed": 3}
    (folder / "spec.json").write_text(json.dumps(spec))
    ended = subprocess.run([talus, "calibrate", folder / "spec.json", "--out", folder / "run"], capture_output=True, text=True)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    return ended.stderr + ended.stdout
