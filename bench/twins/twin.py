"""What the benches on virtual powders have in common: the device of their heaps, the frame of their images, the program."""
import json
import pathlib
import subprocess
import sys


def device(plate_mm):
    return {"tube_inner_diameter": "10 mm", "plate_diameter": f"{plate_mm} mm", "plate": "disc",
            "lift_velocity": "50 mm/s"}


def frame(plate_mm, height=120):
    width = 12 * plate_mm
    return {"width_px": width, "height_px": height, "pixel_size": "0.1 mm", "center_x_px": width / 2,
            "baseline_px": 110, "plate_diameter": f"{plate_mm} mm"}


def drawn_engine():
    """The spec's engine where heaps are drawn, not simulated (drawn_heap.py)."""
    here = pathlib.Path(__file__).resolve().parent
    return {"kind": "command", "templates": str(here / "deck"), "result": "heap.png",
            "command": ["/usr/bin/python3", str(here / "drawn_heap.py")]}


def run(*command):
    """What it prints; ends the bench with its message where it fails."""
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: {done.stderr}")
    return done.stdout


def credible_level(talus, campaign, truth):
    """Of the smallest joint region that holds the truth: 0.9 or less is inside the 90 % region."""
    told = run(talus, "consider", campaign, "--json", *(f"{k}={v}" for k, v in truth.items()))
    return json.loads(told)["credible_level"]
