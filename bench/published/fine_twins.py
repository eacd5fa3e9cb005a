#!/usr/bin/python3
"""fine_twins.py TALUS FOLDER [--powder ti6al4v|al6061] [--first N] [--last N] [--true F] [--scale-factors F…]
[--core-time S] [--tests heap,all]: do the examples of fine powders find a virtual truth?

Each truth is drawn at random in the ranges of the example's spec. Three heaps of it at the scale factor --true, and three on
a plate of 30 mm, are photographed: 16 views each, dark grains on a dark plate against the light. The example's spec is
calibrated on them at --scale-factors, for --true, which it simulates only where --scale-factors names it:

  heap  the photographs of the heap alone, the test that the method was published with
  all   these, those of the wide plate, and the bulk density in the tube, known to a hundredth

One line a truth and campaign: the credible level of the truth (0.9 or less is inside the joint 90 % region), the region's
share of what is searched, 90 % ranges, and alarms. What is in FOLDER is not made twice.
"""
import argparse
import json
import math
import pathlib
import random
import subprocess
from importlib.machinery import SourceFileLoader

import numpy
from PIL import Image, ImageDraw

from optima import ROOT, case, spec

render_heap = SourceFileLoader("render_heap", str(ROOT / "scripts" / "render_heap")).load_module()
RUNS = 3
VIEWS = 16
PLATES = {"heap": 10, "wide plate": 30}  # [mm]
PHOTOS = {"heap": "photos", "wide plate": "photos_wide"}
PIXEL = 0.05  # [mm]
FINER = 4  # a photograph is drawn so many times as large: its edges are as blurred as a camera's
HEIGHT, TOP, BOTTOM = 360, 300, 340  # rows: of the photograph, the plate's top and its lower edge
LIGHT, DARK = 235, 25


def photograph(grains, plate_mm, azimuth):
    """A silhouette of grains, x y z radius [mm], one a row; the plate's top is z = 0."""
    scale = FINER / PIXEL
    width = round(1.4 * plate_mm / PIXEL)
    picture = Image.new("L", (FINER * width, FINER * HEIGHT), LIGHT)
    draw = ImageDraw.Draw(picture)
    middle = FINER * width / 2
    half = plate_mm / 2 * scale
    draw.rectangle([middle - half, FINER * TOP, middle + half - 1, FINER * BOTTOM - 1], fill=DARK)
    x = (grains[:, 0] * math.cos(azimuth) + grains[:, 1] * math.sin(azimuth)) * scale + middle
    y = FINER * TOP - grains[:, 2] * scale
    for a, b, r in zip(x, y, grains[:, 3] * scale):
        draw.ellipse([a - r, b - r, a + r - 1, b + r - 1], fill=DARK)
    return picture.resize((width, HEIGHT), Image.BOX)


def measure(options, folder, name, truth, seed):
    """Photographs three heaps; their bulk densities in the tube [kg/m^3]."""
    (folder / PHOTOS[name]).mkdir(parents=True, exist_ok=True)
    densities = []
    for i in range(RUNS):
        place = folder / f"{PHOTOS[name]}_run{i + 1}"
        if not (place / "result.json").exists():
            one = case(options.powder, truth.values(), options.true, seed + i, None)
            one["device"]["plate_diameter"] = f"{PLATES[name]} mm"
            del one["frame"]  # it is photographed here
            place.with_suffix(".json").write_text(json.dumps(one, indent=1))
            subprocess.run([options.talus, "simulate", place.with_suffix(".json"), "--out", place, "--quiet"], check=True)
            grains = 1e3 * numpy.array(render_heap.read_spheres(place / "heap.vtp"))
            for view in range(VIEWS):
                photograph(grains, PLATES[name], math.pi * view / VIEWS).save(
                    folder / PHOTOS[name] / f"run{i + 1}_view{view + 1}.png")
        densities.append(json.loads((place / "result.json").read_text())["observables"]["bulk_density_kg_per_m3"])
    return densities


def calibrate(options, folder, tests, densities, seed):
    campaign = spec(options.powder)
    campaign.pop("$schema")
    if tests == "all":
        heap = campaign["experiments"][0]
        wide = heap | {"name": "wide plate", "photos": PHOTOS["wide plate"], "plate_diameter": "30 mm",
                       "device": campaign["device"] | {"plate_diameter": "30 mm"}}
        mean = numpy.mean(densities)
        error = max(numpy.std(densities, ddof=1) / len(densities) ** 0.5, 0.01 * mean)
        campaign["experiments"] = [heap | {"bulk_density": {"value": mean, "sd": error}}, wide]
    campaign |= {"coarse_graining": {"scale_factors": options.scale_factors, "target": options.true}, "seed": seed,
                 "budget": {"core_time": f"{options.core_time} s"}, "confirm": {"candidates": 0}, "next": {"share": 0}}
    (folder / f"{tests}.json").write_text(json.dumps(campaign, indent=1))
    if not (folder / tests / "result.json").exists():
        begun = (folder / tests / "journal.sqlite").exists()
        subprocess.run([options.talus, *(["resume", folder / tests] if begun else
                                         ["calibrate", folder / f"{tests}.json", "--out", folder / tests]), "--quiet"], check=True)
    return folder / tests


def tell(options, campaign, truth):
    result = json.loads((campaign / "result.json").read_text())
    considered = subprocess.run([options.talus, "consider", campaign, "--json", *(f"{k}={v}" for k, v in truth.items())],
                                check=True, capture_output=True, text=True).stdout
    level = json.loads(considered)["credible_level"]
    ranges = ", ".join(f"{p['name']} {p['value']:.3g} ({p['credible_90_low']:.3g} … {p['credible_90_high']:.3g})"
                       for p in result["parameters"])
    if level is None:
        print(f"  {campaign.name}: too few simulations for a region", flush=True)
        return False
    print(f"  {campaign.name}: level {level:.3f}, volume {result['posterior']['region_90_volume_fraction']:.3f}; {ranges}; "
          f"alarms {sorted({w['kind'] for w in result['warnings']})}", flush=True)
    return level <= 0.9


def drawn(powder, seed):
    """A truth in the ranges of the example's spec."""
    draw = random.Random(seed)
    truth = {}
    for name, p in spec(powder)["parameters"].items():
        low, high = (float(str(p[k]).split()[0]) for k in ("min", "max"))
        truth[name] = math.exp(draw.uniform(math.log(low), math.log(high))) if p.get("scale") == "log" else draw.uniform(low, high)
    return truth


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("talus")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--powder", choices=["ti6al4v", "al6061"], default="ti6al4v")
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--last", type=int, default=6)
    parser.add_argument("--true", type=float, default=4)
    parser.add_argument("--scale-factors", type=float, nargs="+", default=[10, 7, 5])
    parser.add_argument("--core-time", type=float, default=10000)
    parser.add_argument("--tests", default="heap,all")
    options = parser.parse_args()
    inside = {tests: [] for tests in options.tests.split(",")}
    for twin in range(options.first, options.last + 1):
        truth = drawn(options.powder, twin)
        folder = options.folder / f"{options.powder}{twin:02}"
        densities = measure(options, folder, "heap", truth, 1000 * twin)
        if "all" in inside:
            measure(options, folder, "wide plate", truth, 1000 * twin + 500)
        print(f"{options.powder} {twin}: truth " + ", ".join(f"{k} {v:.3g}" for k, v in truth.items()), flush=True)
        for tests, held in inside.items():
            held.append(tell(options, calibrate(options, folder, tests, densities, twin), truth))
    for tests, held in inside.items():
        print(f"{tests}: the truth is inside in {sum(held)} of {len(held)}")


if __name__ == "__main__":
    main()
