#!/usr/bin/env python3
"""python_test.py TALUS MODULE_DIR: the Python module reads campaigns, drives strategies, simulates and
compares."""
import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, sys.argv[2])
import numpy

import talus

FRAME = {"width_px": 120, "height_px": 80, "pixel_size": 1e-4, "center_x_px": 60, "baseline_px": 70,
         "plate_diameter": 0.01}
CASE = {"powder": {"sizes": {"kind": "mono", "diameter": "1 mm"}, "mass": "0.3 g",
                   "material": {"youngs_modulus": "1 MPa"}}, "frame": FRAME}


def raises(error, words, call, *arguments, **keys):
    try:
        call(*arguments, **keys)
    except error as caught:
        assert words in str(caught), caught
    else:
        raise AssertionError(f"no {error.__name__} from {call}")


def check_ask_tell():
    parameters = [{"name": "friction", "low": 0.1, "high": 0.9},
                  {"name": "energy", "low": 1e-6, "high": 1e-3, "scale": "log"}]

    def run():
        strategy = talus.Strategy(parameters, {"kind": "gp", "exact": True}, seed=3)
        told = []
        for _ in range(30):
            for values in strategy.ask():
                value = (values["friction"] - 0.4) ** 2 + (numpy.log10(values["energy"]) + 4) ** 2
                strategy.tell(values, value)
                told.append(tuple(values.values()))
        return told, strategy.answer()

    told, answer = run()
    assert run()[0] == told, "equal evaluations make equal proposals"
    # An exact smooth bowl: 30 evaluations find the minimum to a few percent of the ranges.
    assert abs(answer["values"]["friction"] - 0.4) < 0.05, answer
    assert abs(numpy.log10(answer["values"]["energy"]) + 4) < 0.2, answer
    low, high = answer["ranges_90"]["friction"]
    assert low <= answer["values"]["friction"] <= high
    strategy = talus.Strategy(parameters)
    raises(talus.ConfigError, "energy", strategy.tell, {"friction": 0.5}, 1.0)
    raises(talus.ConfigError, "needs a value", strategy.tell, {"friction": 0.5, "energy": 1e-4})
    raises(talus.ConfigError, "beyond 1e100", strategy.tell, {"friction": 0.5, "energy": 1e-4}, -1e160)
    for energy in (1.0, -1.0, float("nan")):
        raises(talus.ConfigError, "outside the searched range", strategy.tell, {"friction": 0.5, "energy": energy}, 1.0)
    raises(ValueError, "frictoin", talus.Strategy, [{"name": "a", "low": 0, "high": 1}],
           {"frictoin": 1})


def check_images_as_evaluations():
    """A strategy that is told images: columns of a height that is searched for."""
    def image(height):
        rows = numpy.arange(40)[:, None] + numpy.zeros((1, 30))
        return numpy.where(rows >= 40 - height, 0, 255).astype(numpy.uint8)

    strategy = talus.Strategy([{"name": "height", "low": 2, "high": 38}], seed=2, target=image(17),
                              pixel_area=0.01)
    for _ in range(12):
        for values in strategy.ask():
            strategy.tell(values, image=image(round(values["height"])))
    assert abs(strategy.answer()["values"]["height"] - 17) < 1.5, strategy.answer()
    raises(talus.ConfigError, "size of the target", strategy.tell, {"height": 3},
           image=numpy.zeros((5, 5), dtype=numpy.uint8))


def check_simulation(root):
    (root / "case.json").write_text(json.dumps(CASE))
    talus.simulate(str(root / "case.json"), str(root / "heap"))
    profile = talus._core.read_image(str(root / "heap/profile.png"))
    assert profile.shape == (80, 120) and profile.min() == 0
    metrics = talus.compare(profile, profile, FRAME)
    assert metrics["sad_mm2"] == 0 and metrics["iou"] == 1
    raises(talus.ConfigError, "case.json", talus.simulate, str(root / "absent/case.json"), str(root / "x"))


def check_projection():
    """One sphere of 2 mm: its silhouette has the area of a disc, within a pixel along its rim."""
    image = talus.project(numpy.array([[0, 0, 1e-3, 2e-3]]), FRAME)
    area = (image == 0).sum() * 1e-8
    assert abs(area - numpy.pi * 1e-6) < 2 * numpy.pi * 1e-3 * 1e-4, area
    raises(talus.ConfigError, "four columns", talus.project, numpy.zeros((2, 3)), FRAME)
    for bad in ([numpy.nan, 0, 0, 1e-3], [0, 0, 0, -1e-3], [0, 0, 0, numpy.inf]):
        raises(talus.ConfigError, "row 1", talus.project, numpy.array([[0, 0, 0, 1e-3], bad]), FRAME)
    empty = numpy.zeros((0, 0), numpy.uint8)
    raises(talus.ConfigError, "is empty", talus.compare, empty, empty, FRAME)
    raises(talus.ConfigError, "reference: has 7 x 5 px", talus.compare, image, numpy.zeros((5, 7), numpy.uint8), FRAME)
    raises(talus.ConfigError, "width", talus.project, numpy.zeros((0, 4)), {**FRAME, "width_px": -1})


def check_campaign(program, root):
    heap = talus._core.read_image(str(root / "heap/profile.png"))
    assert heap.shape == (80, 120)
    spec = {"experiment": {"map": str(root / "heap/profile.png"), "plate_diameter": "10 mm", "frame": FRAME},
            "powder": CASE["powder"], "parameters": {"sliding_friction": {"min": 0.1, "max": 0.9}},
            "strategy": {"kind": "sobol", "num_points": 4}, "budget": {"simulations": 4},
            "noise": {"replicates": 0}, "confirm": {"candidates": 0}}
    (root / "spec.json").write_text(json.dumps(spec))
    subprocess.run([program, "calibrate", root / "spec.json", "--out", root / "run", "--quiet"], check=True)
    campaign = talus.Campaign(root / "run")
    assert campaign.parameters == ["sliding_friction"]
    trials = campaign.trials()
    assert len(trials) == 4 and (trials.status == "ok").all()
    assert trials.sliding_friction.between(0.1, 0.9).all() and (trials.sad_mm2 >= 0).all()
    assert campaign.result["parameters"][0]["name"] == "sliding_friction"
    assert campaign.spec["budget"]["simulations"] == 4
    assert campaign.profiles().dims == ("trial", "row", "column") and len(campaign.profiles()) == 4
    assert campaign.profile(1).shape == campaign.aehp().shape == (80, 120)
    raises(FileNotFoundError, "posterior", campaign.posterior)
    raises(FileNotFoundError, "holds no campaign", talus.Campaign, root)
    (root / "run/posterior.csv").write_text("sliding_friction\n0.5\n0.6\n")
    assert campaign.posterior().sliding_friction.tolist() == [0.5, 0.6]


check_ask_tell()
check_images_as_evaluations()
check_projection()
with tempfile.TemporaryDirectory() as scratch:
    check_simulation(pathlib.Path(scratch))
    check_campaign(sys.argv[1], pathlib.Path(scratch))
print("the module does what it says")
