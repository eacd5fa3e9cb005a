#!/usr/bin/python3
"""predict_twins.py TALUS FOLDER [--first N] [--last N] [--budget S] [--draws N] [--seeds K] [--scale F,…] [--valley N]:
does `talus predict` hold what a virtual powder, whose true parameters are known, does in four processes?

FOLDER is that of dem_twins.py. For each of its powders from --first to --last the campaign of both tests predicts with
--draws draws in --budget seconds of core time each

  drum         angle of its surface
  draw-down    rate of discharge
  density      as poured
  spreading    packing fraction of the layer

and the truth runs once in each at true size, with a seed of its own. One line a powder and process: the truth's
number, the predicted 90 % interval, whether it is inside, how far off the mean is in standard deviations of the prediction, the
parameters' share, and what told the number. The last lines count.

--valley: of the first N powders the campaign with the heap alone predicts the drum and the wide plate, too: its valley is
wide, and a test that tells its sets apart should have a larger share of parameters.
"""
import json
import math

from twin import arguments, device, finished, run, truth_of

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
WIDE = {"wide plate": (1.6, "mass_fallen_kg", {"device": device(30)})}


def case_of(twin, name, process, truth=None):
    """The file of a process: as the campaigns' powder has it, or with what its truth has."""
    spec = json.loads((twin / "both.json").read_text())
    mass, _, keys = process
    content = {"powder": {**spec["powder"], "mass": f"{mass} g"}, **keys}
    if truth is not None:
        content["powder"]["material"] |= truth
        content["models"] = spec["models"]
    file = twin / f"{name.replace(' ', '_')}{'' if truth is None else '_truth'}.json"
    file.write_text(json.dumps(content))
    return file


def true_value(options, twin, name, process, truth, seed):
    file = case_of(twin, name, process, truth)
    file.write_text(json.dumps({**json.loads(file.read_text()), "seed": seed}))
    run(options.talus, "simulate", file, "--out", file.with_suffix(""))
    return json.loads((file.with_suffix("") / "result.json").read_text())["observables"][process[1]]


def predicted(options, campaign, twin, name, process):
    told = run(options.talus, "predict", campaign, case_of(twin, name, process), "--draws", options.draws, "--seeds",
               options.seeds, "--budget", f"{options.budget} s", *(["--scale", options.scale] if options.scale else []),
               "--json")
    prediction = json.loads(told)[0]
    number = next(n for n in prediction["numbers"] if n["name"] == process[1])
    return prediction, number


def percent(share):
    return "-" if share is None else f"{100 * share:.0f} %"


def judge(options, campaign, name, process, value):
    """A row: whether the truth's number is inside, its distance from the mean [sd], the parameters' share."""
    prediction, number = predicted(options, campaign, campaign.parent, name, process)
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
    parser = arguments(powders=math.inf)
    parser.add_argument("--budget", type=float, default=60)
    parser.add_argument("--draws", type=int, default=12)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--scale", default="")
    parser.add_argument("--valley", type=int, default=0, metavar="N")
    options = parser.parse_args()
    rows = {}
    for i, twin in enumerate(finished(options.folder, options.first, options.last)):
        number, truth = truth_of(twin)
        print(f"{twin.name} truth " + " ".join(f"{v:.3g}" for v in truth.values()), flush=True)
        asked = [("both", name) for name in PROCESSES]
        if i < options.valley:
            asked += [("heap", name) for name in ("drum", *WIDE)]
        values = {}
        for campaign, name in asked:
            process = {**PROCESSES, **WIDE}[name]
            if name not in values:
                values[name] = true_value(options, twin, name, process, truth, 1000 * number + 700 + len(values))
            row = judge(options, twin / campaign, name, process, values[name])
            rows.setdefault((campaign, name), []).append(row)
    for (campaign, name), of_it in rows.items():
        shares = [r["share"] for r in of_it if r["share"] is not None]
        mean_share = sum(shares) / len(shares) if shares else None
        print(f"{name}, by {campaign}: inside {sum(r['inside'] for r in of_it)} of {len(of_it)}, rms "
              f"{(sum(r['off'] ** 2 for r in of_it) / len(of_it)) ** 0.5:.2f} sd, parameters {percent(mean_share)} on average, "
              f"by a surrogate {sum(r['used'] for r in of_it)}")
    both = [r for (campaign, _), of_it in rows.items() if campaign == "both" for r in of_it]
    print(f"all processes: inside {sum(r['inside'] for r in both)} of {len(both)}")


main()
