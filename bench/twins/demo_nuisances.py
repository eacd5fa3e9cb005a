#!/usr/bin/python3
"""demo_nuisances.py TALUS FOLDER [--first 16] [--last 21] [--core-time 1200]: the demo's photographs, the restitution and
the rolling damping of its powder unknown.

Both tests of the demo (examples/demo/two_tests.json), friction searched as there, restitution (0.3 to 0.95) and rolling
damping (0.05 to 1) as nuisances. Prints for each seed the credible level of the truth (0.45, 0.15), what the restitution,
0.9, is known to, and what it cost. 25 core min a seed; what is in FOLDER is not made twice.
"""
import json
import pathlib
import sys

import twin

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/system"))
from commented_json import read_json  # noqa: E402

TRUTH = {"sliding_friction": 0.45, "rolling_friction": 0.15}


def spec_of(seed, core_time):
    demo = ROOT / "examples/demo"
    spec = read_json(demo / "two_tests.json")
    for experiment in spec["experiments"]:
        experiment["photos"] = str(demo / experiment["photos"])
    for unknown in ("restitution", "rolling_damping"):
        del spec["powder"]["material"][unknown]
    spec["parameters"] |= {"restitution": {"min": 0.3, "max": 0.95, "nuisance": True},
                           "rolling_damping": {"min": 0.05, "max": 1, "scale": "log", "nuisance": True}}
    del spec["$schema"]
    return spec | {"budget": {"simulations": 1000, "core_time": core_time}, "workers": 1, "seed": seed,
                   "next": {"share": 0}}


def main():
    parser = twin.arguments(powders=21, core_time=1200)
    parser.set_defaults(first=16)
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    for seed in range(options.first, options.last + 1):
        campaign = options.folder / f"seed{seed}"
        if not (campaign / "result.json").exists():
            spec = options.folder / f"seed{seed}.json"
            spec.write_text(json.dumps(spec_of(seed, options.core_time), indent=1))
            twin.run(options.talus, "calibrate", spec, "--out", campaign, "--quiet")
        result = json.loads((campaign / "result.json").read_text())
        restitution = next(p for p in result["parameters"] if p["name"] == "restitution")
        level = twin.credible_level(options.talus, campaign, TRUTH)
        print(f"seed {seed}: level {level:.3f}, restitution {restitution['credible_90_low']:.3f} to "
              f"{restitution['credible_90_high']:.3f}, "
              f"{60 * result['cost']['core_hours']:.0f} core min", flush=True)


if __name__ == "__main__":
    main()
