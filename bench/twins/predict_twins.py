#!/usr/bin/python3
"""predict_twins.py TALUS FOLDER [--first N] [--last N] [--core-time S] [--budget S] [--draws N] [--seeds K] [--runs N]
[--scale F,…] [--valley]: does `talus predict` hold what a virtual powder, whose true parameters are known, does in four processes?

Each powder has sliding and rolling friction drawn at random. --runs heaps on a plate of 10 mm and as many on one of 30 mm
are simulated at true grain size; a campaign with scale factors 1.4 and 1 and --core-time calibrates both tests. It predicts
with --draws draws in --budget seconds of core time each

  drum         angle of its surface
  draw-down    rate of discharge
  density      as poured
  spreading    packing fraction of the layer

and the truth runs once in each at true size, with a seed of its own. One line a powder and process: the truth's
number, the predicted 90 % interval, whether it is inside, how far off the mean is in standard deviations of the prediction, the
parameters' share, and what told the number. The last lines count.

--valley: a campaign with the heap alone predicts the drum and the wide plate, too: its valley is wide, and a test that
tells its sets apart should have a larger share of parameters.
"""
import json
import random

from twin import arguments, device, mean_heap, run

SEARCHED = {"sliding_friction": (0.1, 0.9), "rolling_friction": (0.02, 0.6)}
DRAWN = {"sliding_friction": (0.15, 0.85), "rolling_friction": (0.04, 0.5)}
MATERIAL = {"density": 4386, "youngs_modulus": "26.25 MPa", "poisson_ratio": 0.342, "restitution": 0.9,
            "rolling_damping": 0.3}
SIZES = {"kind": "mono", "diameter": "0.7 mm"}
MODELS = {"adhesion": "none", "rolling": "epsd", "full_mobilisation_damping": 0}
HEAP_MASS = 1.6  # [g]
# Mass [g], what is measured, and what the case has of its own.
PROCESSES = {
    "drum": (0.8, "angle_deg", {
        "rig": {"kind": "drum", "diameter": "16 mm", "width": "5 mm", "speed": "40 rpm", "start_turns": 0.2, "turns": 0.25},
        "device": {"tube_material": {"sliding_friction": 0.9}}}),
    "draw-down": (0.9, "discharge_rate_kg_per_s", {
        "rig": {"kind": "draw_down", "length": "14 mm", "width": "4 mm", "slot": "5 mm", "height": "12 mm"}}),
    "density": (0.6, "poured_density_kg_per_m3", {
        "rig": {"kind": "tapped_density", "diameter": "8 mm", "taps": {"count": 2, "height": "1 mm", "interval": "0.1 s"}},
        "filling": {"kind": "pour"}}),
    "spreading": (0.5, "packing_fraction", {
        "rig": {"kind": "spreading", "gap": "1.75 mm", "speed": "200 mm/s", "length": "16 mm", "width": "4.2 mm",
                "feed": "7 mm"}}),
}
WIDE = {"wide plate": (HEAP_MASS, "mass_fallen_kg", {"device": device(30)})}


def powder(mass, truth=None):
    return {"material": {**MATERIAL, **(truth or {})}, "sizes": SIZES, "mass": f"{mass} g"}


def calibrate(options, folder, name, experiments, seed):
    spec = {"experiments": experiments, "powder": powder(HEAP_MASS), "device": device(10), "models": MODELS,
            "coarse_graining": {"scale_factors": [1.4, 1]}, "seed": seed, "workers": options.workers,
            "parameters": {k: {"min": a, "max": b} for k, (a, b) in SEARCHED.items()},
            "budget": {"core_time": f"{options.core_time} s"}, "confirm": {"candidates": 0}, "next": {"share": 0}}
    (folder / f"{name}.json").write_text(json.dumps(spec))
    run(options.talus, "calibrate", folder / f"{name}.json", "--out", folder / name, "--quiet")
    return folder / name


def case_of(folder, name, process, truth=None):
    mass, _, keys = process
    file = folder / f"{name.replace(' ', '_')}{'' if truth is None else '_truth'}.json"
    content = {"powder": powder(mass, truth), **keys}
    if truth is not None:
        content["models"] = MODELS
    file.write_text(json.dumps(content))
    return file


def true_value(options, folder, name, process, truth, seed):
    case = json.loads(case_of(folder, name, process, truth).read_text())
    out = folder / f"{name.replace(' ', '_')}_truth"
    (folder / "truth.json").write_text(json.dumps({**case, "seed": seed}))
    run(options.talus, "simulate", folder / "truth.json", "--out", out)
    return json.loads((out / "result.json").read_text())["observables"][process[1]]


def predicted(options, campaign, folder, name, process):
    told = run(options.talus, "predict", campaign, case_of(folder, name, process), "--draws", options.draws, "--seeds",
               options.seeds, "--budget", f"{options.budget} s", *(["--scale", options.scale] if options.scale else []),
               "--json")
    prediction = json.loads(told)[0]
    number = next(n for n in prediction["numbers"] if n["name"] == process[1])
    return prediction, number


def percent(share):
    return "-" if share is None else f"{100 * share:.0f} %"


def judge(options, campaign, folder, name, process, truth, seed):
    """A row: whether the truth is inside, its distance from the mean [sd], the parameters' share."""
    value = true_value(options, folder, name, process, truth, seed)
    prediction, number = predicted(options, campaign, folder, name, process)
    inside = number["low_90"] <= value <= number["high_90"]
    surrogate = number["surrogate"] or {"is_used": False, "sd": 0, "left_out_error": 0, "draws_error": 0}
    sd = (number["parameters_sd"] ** 2 + number["run_sd"] ** 2 + (surrogate["sd"] ** 2 if surrogate["is_used"] else 0)) ** 0.5
    by = f"surrogate for {prediction['target_scale_factor']:g}" if surrogate["is_used"] else f"draws at {prediction['scale_factor']:g}"
    factors = sorted({run["scale_factor"] for run in prediction["runs"]}, reverse=True)
    print(f"  {campaign.name}, {name}: {process[1]} {value:.4g}, predicted {number['low_90']:.4g} … {number['high_90']:.4g}, "
          f"{'inside' if inside else 'OUTSIDE'}, off by {(number['mean'] - value) / sd:+.2f} sd, parameters "
          f"{percent(number['parameters_share'])}, by {by} (left out: {surrogate['left_out_error']:.2g} and {surrogate['draws_error']:.2g}), "
          f"{prediction['num_ended']} runs at {factors}, {prediction['core_time_s']:.0f} s", flush=True)
    return {"inside": inside, "off": (number["mean"] - value) / sd, "share": number["parameters_share"],
            "used": surrogate["is_used"]}


def main():
    parser = arguments(powders=20, core_time=60)
    parser.add_argument("--budget", type=float, default=60)
    parser.add_argument("--draws", type=int, default=12)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--scale", default="")
    parser.add_argument("--valley", action="store_true")
    options = parser.parse_args()
    rows = {}
    for twin in range(options.first, options.last + 1):
        draw = random.Random(twin)
        truth = {k: draw.uniform(a, b) for k, (a, b) in DRAWN.items()}
        folder = options.folder / f"twin{twin:02}"
        case = {"powder": powder(HEAP_MASS, truth), "models": MODELS}
        heap, _ = mean_heap(options.talus, folder, case, 10, 1000 * twin, options.runs)
        wide, fallen = mean_heap(options.talus, folder, case, 30, 1000 * twin + 500, options.runs)
        tests = [{"name": "heap", **heap},
                 {"name": "wide plate", **wide, "device": device(30), "mass_fallen": fallen}]
        print(f"twin {twin} truth " + " ".join(f"{v:.3g}" for v in truth.values()), flush=True)
        both = calibrate(options, folder, "both", tests, twin)
        for i, (name, process) in enumerate(PROCESSES.items()):
            row = judge(options, both, folder, name, process, truth, 1000 * twin + 700 + i)
            rows.setdefault(name, []).append(row)
        if not options.valley:
            continue
        alone = calibrate(options, folder, "heap", tests[:1], twin)
        for i, (name, process) in enumerate({"drum": PROCESSES["drum"], **WIDE}.items()):
            row = judge(options, alone, folder, name, process, truth, 1000 * twin + 800 + i)
            rows.setdefault(f"{name}, by the heap alone", []).append(row)
    for name, of_it in rows.items():
        shares = [r["share"] for r in of_it if r["share"] is not None]
        mean_share = sum(shares) / len(shares) if shares else None
        print(f"{name}: inside {sum(r['inside'] for r in of_it)} of {len(of_it)}, rms {(sum(r['off'] ** 2 for r in of_it) / len(of_it)) ** 0.5:.2f} "
              f"sd, parameters {percent(mean_share)} on average, by a surrogate {sum(r['used'] for r in of_it)}")
    both = [r for name in PROCESSES for r in rows[name]]
    print(f"all processes: inside {sum(r['inside'] for r in both)} of {len(both)}")


main()
