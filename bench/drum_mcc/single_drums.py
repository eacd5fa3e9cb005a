#!/usr/bin/python3
"""single_drums.py TALUS PHOTOS OUT [NAME ...]: drums of true grains at 15 and 45 rpm, one set each, and by how much more powder than the
photographs they show [mm^2], both cut at half of the mean picture, inside √0.6 of the drum's radius.

NAME of SETS; all of them without one. A drum takes 3 to 5 min of a core. The photographs, gd_15rpm.png and gd_45rpm.png, lie in PHOTOS.
OUT/NAME_15rpm has the states that published_measure.py reads.
"""
import argparse
import json
import pathlib
import subprocess

import numpy
from drum_pictures import counted, pixel_area
from PIL import Image

GRAMS = 44.64233 / 29185  # of a sphere
SETS = {  # restitution, sliding and rolling friction, surface energy, modulus, spheres, time until the pictures at 15 and 45 rpm [s]
    "best": (0.3, 0.533, 0.271, 0, "5 MPa", 29630, (1.5, 1.5)),
    "chosen": (0.3, 0.5613471, 0.2931411, 0, "5 MPa", 29185, (1.5, 1.5)),
    "soft": (0.3, 0.533, 0.271, 0, "1 MPa", 29630, (1.5, 1.0)),
    "elastic": (0.8, 0.5, 0.2, 0, "1 MPa", 29630, (1.5, 1.0)),
    "cohesive_2": (0.8, 0.5, 0.2, 2e-3, "1 MPa", 29630, (1.5, 1.0)),
    "cohesive_4": (0.8, 0.4, 0.1, 4e-3, "1 MPa", 29630, (1.5, 1.0)),
    "cohesive_8": (0.8, 0.5, 0.1, 8e-3, "1 MPa", 29630, (1.5, 1.0)),
}
LIGHT, BED = 0.969, 0.1  # of the photographs: grey where no powder is, and where it always is


def case(values, rpm, start):
    restitution, sliding, rolling, energy, modulus, spheres, _ = values
    material = {"density": 1580, "youngs_modulus": modulus, "poisson_ratio": 0.3, "restitution": restitution,
                "sliding_friction": sliding, "rolling_friction": rolling}
    if energy:
        material["surface_energy"] = energy
    return {
        "powder": {
            "mass": f"{GRAMS * spheres} g", "material": material,
            "sizes": {"kind": "classes", "by": "number", "diameters": [f"{1.025 + 0.05 * i:.3f} mm" for i in range(11)],
                      "shares": [0.0065, 0.0739, 0.2625, 0.2525, 0.1701, 0.1053, 0.0689, 0.0366, 0.0186, 0.0051]}},
        # 0.1 s to settle, then it turns; 20 pictures in 0.2 s.
        "rig": {"kind": "drum", "diameter": "84 mm", "width": "20 mm", "speed": f"{rpm} rpm", "start_turns": (start - 0.1) * rpm / 60,
                "turns": 0.22 * rpm / 60, "camera": {"frames": 20, "interval": "10 ms"}},
        "models": {"adhesion": "dmt" if energy else "none", "rolling": "constant"},
        "rayleigh_fraction": 0.15,
        "rules": {"settling": {"max_time": "0.1 s"}},
        "frame": {"width_px": 406, "height_px": 406, "pixel_size": "206.9 um", "center_x_px": 203, "baseline_px": 406,
                  "plate_diameter": "84 mm", "disc_diameter": "82.5 mm"},
        "outputs": {"times": [f"{start + 0.01 * k:.2f} s" for k in range(21)]}}


def area(picture, light, bed):
    """Darker than half, where it counts [mm^2]."""
    grey = numpy.array(Image.open(picture).convert("L")) / 255
    size = grey.shape[0]
    return pixel_area(size) * ((grey < (light + bed) / 2) & counted(size)).sum()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("talus", metavar="TALUS")
    parser.add_argument("photos", metavar="PHOTOS", type=pathlib.Path)
    parser.add_argument("out", metavar="OUT", type=pathlib.Path)
    parser.add_argument("names", metavar="NAME", nargs="*", choices=SETS)
    asked = parser.parse_args()
    out = asked.out
    out.mkdir(parents=True, exist_ok=True)
    for name in asked.names or SETS:
        more = []
        for rpm, start in zip((15, 45), SETS[name][-1]):
            place = out / f"{name}_{rpm}rpm"
            place.with_suffix(".json").write_text(json.dumps(case(SETS[name], rpm, start), indent=1))
            subprocess.run([asked.talus, "simulate", place.with_suffix(".json"), "--out", place], check=True, stdout=subprocess.DEVNULL)
            more.append(area(place / "profile.png", 1, 0) - area(asked.photos / f"gd_{rpm}rpm.png", LIGHT, BED))
        print(f"{name}: {more[0]:+.0f} mm^2 at 15 rpm, {more[1]:+.0f} at 45, swelling {more[1] - more[0]:.0f}", flush=True)


if __name__ == "__main__":
    main()
