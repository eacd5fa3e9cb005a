#!/usr/bin/python3
"""at_rest.py TALUS FOLDER [--scale-factor F] [--set N] [--softness S] [--interval MS] [--distance D]

What share of grain steps goes to grains at rest? One poured heap of Ti6Al4V; states every 10 ms. Of each state's grains,
those that have moved by less than 1e-4 of their diameter since the state before are at rest. A phase's share is that of the
grains of its states. Half a core minute at f = 8.
"""
import argparse
import base64
import json
import pathlib
import subprocess
import xml.etree.ElementTree as ET

import numpy

import optima

LONGEST = 2.0  # [s]


def simulate(options):
    folder = options.folder / f"set{options.set}_f{options.scale_factor:g}_softness{options.softness:g}"
    if (folder / "result.json").exists():
        return folder
    folder.mkdir(parents=True, exist_ok=True)
    case = optima.case("ti6al4v", optima.POWDERS["ti6al4v"]["sets"][options.set - 1], options.scale_factor, 1, None)
    case["powder"]["material"]["youngs_modulus"] = 26.25e6 / options.softness
    step = 1e-3 * options.interval
    case["outputs"] = {"times": [step * k for k in range(1, round(LONGEST / step))]}
    path = folder.with_suffix(".json")
    path.write_text(json.dumps(case))
    subprocess.run([options.talus, "simulate", path, "--out", folder, "--quiet"], check=True)
    return folder


def array(piece, name, kind):
    text = piece.find(f".//DataArray[@Name='{name}']").text
    return numpy.frombuffer(base64.b64decode(text.strip())[8:], dtype=kind)


def read(path):
    """Numbers of the grains, ascending, with their places and diameters [m]."""
    piece = ET.parse(path).getroot().find("PolyData/Piece")
    numbers = array(piece, "id", "<i8")
    order = numpy.argsort(numbers)
    return numbers[order], array(piece, "Points", "<f8").reshape(-1, 3)[order], array(piece, "diameter_m", "<f8")[order]


def num_resting(before, now, distance):
    _, old, new = numpy.intersect1d(before[0], now[0], assume_unique=True, return_indices=True)
    moved = numpy.linalg.norm(now[1][new] - before[1][old], axis=1)
    return int((moved < distance * now[2][new]).sum())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("talus")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--scale-factor", type=float, default=8)
    parser.add_argument("--set", type=int, default=5)
    parser.add_argument("--softness", type=float, default=1)
    parser.add_argument("--interval", type=float, default=10, metavar="MS")
    parser.add_argument("--distance", type=float, default=1e-4, metavar="DIAMETERS")
    options = parser.parse_args()
    folder = simulate(options)
    phases = json.loads((folder / "result.json").read_text())["phases"]
    counts = {phase["name"]: [0, 0] for phase in phases}
    states = [read(path) for path in sorted(folder.glob("state_*.vtp"))]
    for k, (before, now) in enumerate(zip(states, states[1:])):
        time = 1e-3 * options.interval * (k + 2)
        name = next(p["name"] for p in phases if time <= p["end_time_s"] or p is phases[-1])
        counts[name][0] += num_resting(before, now, options.distance)
        counts[name][1] += len(now[0])
    total = sum(all_of_them for _, all_of_them in counts.values())
    for name, (resting, all_of_them) in counts.items():
        print(f"{name}: {100 * resting / max(all_of_them, 1):.1f} % at rest of {100 * all_of_them / total:.1f} % of the grain steps")
    print(f"all: {100 * sum(resting for resting, _ in counts.values()) / total:.1f} % at rest")


if __name__ == "__main__":
    main()
