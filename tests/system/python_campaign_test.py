#!/usr/bin/env python3
"""python_campaign_test.py TALUS MODULE_DIR: the Python module runs campaigns and reads them."""
import contextlib
import io
import json
import os
import pathlib
import sqlite3
import sys
import tempfile
import types
import warnings

sys.path.insert(0, sys.argv[2])
import numpy

import talus
from python_case import CASE, FRAME, raises


def check_campaign(root):
    (root / "case.json").write_text(json.dumps(CASE))
    talus.simulate(root / "case.json", root / "heap")
    heap = talus.read_image(root / "heap/profile.png")
    assert heap.shape == (80, 120)
    spec = {"experiment": {"map": str(root / "heap/profile.png"), "plate_diameter": "10 mm", "frame": FRAME},
            "powder": CASE["powder"], "parameters": {"sliding_friction": {"min": 0.1, "max": 0.9}},
            "strategy": {"kind": "sobol", "num_points": 4}, "budget": {"simulations": 4},
            "noise": {"replicates": 0}, "confirm": {"candidates": 0}}
    events = []
    spec["name"] = "a <drawn> heap"
    campaign = talus.calibrate(spec, out=root / "run", progress=events.append)
    assert {event["event"] for event in events} >= {"trial", "progress", "result"}, events
    trial = next(event for event in events if event["event"] == "trial")
    assert trial["parameters"] == ["sliding_friction"] and len(trial["values"]) == 1
    assert campaign.parameters == ["sliding_friction"] and campaign.ranges == {"sliding_friction": (0.1, 0.9)}
    trials = campaign.trials()
    assert len(trials) == 4 and (trials.status == "ok").all()
    assert trials.sliding_friction.between(0.1, 0.9).all() and trials.sad_mm2.is_unique
    units = trials.attrs["units"]
    assert (units["sad_mm2"], units["iou"], units["sliding_friction"]) == ("mm2", "", ""), units
    assert trials.attrs["ranges"]["sliding_friction"] == (0.1, 0.9)
    assert campaign.result["parameters"][0]["name"] == "sliding_friction"
    assert campaign.spec["budget"]["simulations"] == 4
    check_spec(campaign)
    check_spec_of_a_drum(campaign.folder.parent)
    check_profiles(campaign)
    check_program(campaign)
    check_warnings(campaign)
    raises(FileNotFoundError, "posterior", campaign.posterior)
    raises(FileNotFoundError, "holds no campaign", talus.Campaign, root)
    raises(talus.ConfigError, "out: is needed", talus.calibrate, spec)
    (root / "bad.json").write_text("{}")
    raises(talus.ConfigError, "powder", talus.calibrate, root / "bad.json", out=root / "bad", progress=False)
    raises(talus.ConfigError, "budget: is for simulate", campaign.next, budget=3)
    for budget, words in ((0, '"0 s"'), ("0 min", '"0 min"'), ("long", "long")):
        raises(talus.ConfigError, words, campaign.next, simulate=True, budget=budget)
    raises(talus.ConfigError, "simulate: must be True or False", campaign.next, simulate="no")
    raises(talus.ConfigError, "candidates: is empty", campaign.next, "")
    raises(talus.ConfigError, "sliding_friction", campaign.consider, sliding_friction=3.0)
    for bad, words in ((numpy.nan, "sliding_friction"), ("wide", "does not start with a number"), (None, "NoneType"),
                       ([.5], "it is a list")):
        raises(talus.ConfigError, words, campaign.consider, sliding_friction=bad)
    for name in ("--json", "friction"):
        raises(talus.ConfigError, f"{name}: is no parameter of {campaign.folder}; it has sliding_friction",
               campaign.consider, **{name: 1})
    raises(talus.ConfigError, "cannot be read", campaign.next, "--help")
    raises(talus.ConfigError, "cannot be read", talus.calibrate, "--help", out=root / "help", progress=False)
    raises(talus.ConfigError, "add-simulations", campaign.resume, add_simulations="many", progress=False)
    raises(FileNotFoundError, "holds no campaign", talus.Campaign, "--help")
    assert campaign.consider(sliding_friction=0.5)["values"] == {"sliding_friction": 0.5}
    assert repr(campaign).startswith('<talus.Campaign "a <drawn> heap", finished, 4 trials')
    shown = campaign._repr_html_()
    # It has no verdict, of which nothing is left over.
    assert all(line.strip() for line in repr(campaign).splitlines()) and "<p></p>" not in shown, repr(campaign)
    assert "a &lt;drawn&gt; heap" in shown and "<td>sliding_friction</td>" in shown, shown
    assert campaign.resume(add_simulations=1, progress=False).trials().shape[0] >= 4
    assert campaign.report().stat().st_size > 1e5
    check_inference_data(campaign)
    check_calibrate_arguments(root, spec)


def check_calibrate_arguments(root, spec):
    """A dictionary's numbers may be numpy's; its file, beside the campaign, takes no other's place."""
    folder = root / "a#1 %41? powder 1.5"
    quick = {**spec, "budget": {"simulations": numpy.int64(2)}, "strategy": {"kind": "sobol", "num_points": 2}}
    assert len(talus.calibrate(quick, out=folder, progress=False).trials()) == 2
    assert json.loads((root / "a#1 %41? powder 1.5.json").read_text())["budget"] == {"simulations": 2}
    (root / "mine.json").write_text("{} // mine")
    raises(talus.ConfigError, "is there already", talus.calibrate, quick, out=root / "mine", progress=False)
    assert (root / "mine.json").read_text() == "{} // mine"
    for bad in (3, "yes", 1):
        raises(talus.ConfigError, "progress: must be True, False or a function", talus.calibrate, quick,
               out=root / "untold", progress=bad)
        raises(talus.ConfigError, "progress: must be True, False or a function", talus.Campaign(folder).resume, progress=bad)
    assert not (root / "untold.json").exists()
    for bad, words in (("", "out: is empty"), ("a\0b", "has a NUL byte"), (3, "must be a path; it is a int")):
        raises(talus.ConfigError, words, talus.calibrate, quick, out=bad, progress=False)
    raises(talus.ConfigError, "spec: is empty", talus.calibrate, "", progress=False)
    raises(talus.ConfigError, "which JSON has not", talus.calibrate, {**spec, "seed": {1}}, out=root / "set")
    raises(talus.ConfigError, "typo", talus.calibrate, {**quick, "typo": 1}, out=root / "new/one/", progress=False)
    again = talus.calibrate(quick, out=root / "new/one/", progress=False)  # the typo's file does not stand in the way
    with sqlite3.connect(again.folder / "journal.sqlite") as journal:  # as kill -9 leaves it
        journal.execute("update campaign set state = 'running'")
    assert again.state == "interrupted"

    def fails(event):
        raise RuntimeError("mine")

    raises(RuntimeError, "mine", talus.calibrate, {**spec, "name": "again"}, out=root / "again", progress=fails)


def check_profiles(campaign):
    """The sphere heaps stand on the plate, z = 0, round its centre, x = 0."""
    profiles = campaign.profiles()
    assert profiles.dims == ("trial", "z", "x") and len(profiles) == 4
    assert profiles.x.attrs["units"] == profiles.z.attrs["units"] == "m"
    assert abs(float(profiles.x[0]) + 59.5e-4) < 1e-9 and abs(float(profiles.z[0]) - 69.5e-4) < 1e-9
    powder = profiles.sel(trial=1) < 128
    assert bool(powder.any()) and not bool(powder.where(profiles.z < -1e-4, False).any())
    assert campaign.aehp().shape == campaign.profile(1).shape == (80, 120)
    best = campaign.profile(campaign.trials().sad_mm2.idxmin())
    found = talus.compare(best, campaign.aehp(), campaign.aehp().attrs)["sad_mm2"]
    assert abs(found - campaign.trials().sad_mm2.min()) < 1e-9 * found, found
    frame = json.loads((campaign.folder / "trials/0001/result.json").read_text())["profile"]
    assert talus.project(numpy.array([[0, 0, 1e-3, 2e-3]]), frame).shape == best.shape
    raises(talus.ConfigError, "is no experiment", campaign.profiles, "drum")
    raises(FileNotFoundError, "has no profile", campaign.profile, 99)
    for bad in (2**70, 0, "1"):
        raises(talus.ConfigError, "trial: must be a whole number", campaign.profile, bad)


def check_film(root):
    """A film's pictures lie one behind the other, each on a plate of its own: its wall is 3 mm left of the middle."""
    rig = {"kind": "column_collapse", "length": "6 mm", "width": "5 mm", "camera": {"times": ["15 ms", "60 ms"]}}
    frame = {**FRAME, "center_x_px": 40, "plate_diameter": 0.006}
    powder = {**CASE["powder"], "mass": "0.1 g"}
    (root / "film.json").write_text(json.dumps({"powder": powder, "rig": rig, "frame": frame}))
    talus.simulate(root / "film.json", root / "film")
    maps = [{"map": str(root / f"film/profile_{i}.png")} for i in (1, 2)]
    campaign = talus.calibrate({
        "experiments": [{"name": "film", "rig": rig, "plate_diameter": "6 mm", "frame": frame, "film": maps}],
        "powder": powder, "parameters": {"sliding_friction": {"min": 0.1, "max": 0.9}}, "budget": {"simulations": 1},
        "strategy": {"kind": "sobol", "num_points": 1}, "noise": {"replicates": 0}, "confirm": {"candidates": 0}},
        out=root / "film_run", progress=False)
    film = campaign.aehp()
    assert film.dims == ("picture", "z", "x") and film.shape == (2, 80, 120) and film.picture.values.tolist() == [1, 2]
    assert campaign.profiles().shape == (1, 2, 80, 120)
    for place, file in enumerate(maps):
        assert (film[place].values == talus.read_image(file["map"])).all()
        powder = film.x[(film[place] < 128).any("z")]
        assert abs(float(powder[0]) + 3e-3) < 2e-4, powder  # beside the wall, within two pixels
        assert talus.compare(campaign.profiles()[0, place].values, film[place].values, film.attrs)["sad_mm2"] > 0


def check_spec(campaign):
    """A campaign's spec, changed, is one of another: with a parameter held fixed, several grain sizes, numbers alone."""
    again = campaign.spec
    again["seed"] = 5
    again["budget"]["simulations"] = 1
    again["parameters"]["rolling_friction"] = {"fixed": 0.1}
    again["coarse_graining"] = {"scale_factors": [1.4, 1.2]}
    again["powder"]["sizes"]["diameter"] = "0.7 mm"
    again["strategy"] = {"kind": "auto"}
    root = campaign.folder.parent
    second = talus.calibrate(again, out=root / "second", progress=False)
    filled_in = {"experiment": {}, "num_added": 1, "engine": {"kind": "command", "templates_hash": "1"},
                 "parameters": {"restitution": {"min": 0.3, "max": 0.9, "added_at": 0.5}}}
    assert talus.campaign._taken_again(filled_in) == {
        "experiment": {}, "engine": {"kind": "command"}, "parameters": {"restitution": {"min": 0.3, "max": 0.9}}}
    again = second.spec
    again["seed"] = 6
    del again["experiment"], again["objective"]
    again["experiments"] = [{"name": "heap", "plate_diameter": "10 mm",
                             "height": {"values": ["2 mm", "2.2 mm", "2.1 mm"]}}]
    third = talus.calibrate(again, out=root / "third", progress=False)
    numbers = third.spec
    numbers["seed"] = 7
    fourth = talus.calibrate(numbers, out=root / "fourth", progress=False)
    assert len(fourth.trials()) == 1
    (fourth.folder / "posterior.csv").write_text("sliding_friction\n0.5\n")
    measured = fourth.datasets()["observed_data"]["heap: height_m"]
    # Their mean; their sd, 0.1 mm, over the square root of 3, by the two degrees that three heaps leave.
    assert abs(float(measured) - 2.1e-3) < 1e-12 and abs(measured.attrs["standard_error"] - 1e-4 / 3**.5) < 1e-12
    assert measured.attrs["degrees_of_freedom"] == 2, measured.attrs


def check_spec_of_a_drum(root):
    """A drum's mass only follows from its fill, and a spec has one of the two."""
    drum = {"name": "drum", "rig": {"kind": "drum", "diameter": "20 mm", "width": "8 mm", "speed": "60 rpm", "fill": 0.3,
                                    "start_turns": 0.2, "turns": 0.2}, "angle": {"value": "30 deg", "sd": "1 deg"}}
    material = {"density": 2500, "youngs_modulus": "5 MPa", "restitution": 0.5, "rolling_friction": 0.1}
    spec = {"experiments": [drum], "powder": {"material": material, "sizes": {"kind": "mono", "diameter": "1.5 mm"}},
            "parameters": {"sliding_friction": {"min": 0.1, "max": 0.9}}, "budget": {"simulations": 1},
            "confirm": {"candidates": 0}, "next": {"share": 0}}
    searched = json.loads(json.dumps(spec))
    searched["parameters"]["fill"] = {"min": 0.2, "max": 0.4}
    del searched["experiments"][0]["rig"]["fill"]
    for name, one in (("drum", spec), ("searched", searched)):
        again = talus.calibrate(one, out=root / name, progress=False).spec
        again["seed"] = 8
        assert len(talus.calibrate(again, out=root / (name + "_again"), progress=False).trials()) == 1


def check_program(campaign):
    """TALUS_PROGRAM is a file, or a name on the path."""
    program, path = os.environ["TALUS_PROGRAM"], os.environ["PATH"]
    os.environ.update(TALUS_PROGRAM="talus", PATH=os.path.dirname(program) + ":" + path)
    assert campaign.consider(sliding_friction=0.5)["values"] == {"sliding_friction": 0.5}
    os.environ["TALUS_PROGRAM"] = "no_talus"
    raises(FileNotFoundError, "no_talus: is no program", campaign.consider)
    os.environ.update(TALUS_PROGRAM=program, PATH=path)


def check_warnings(campaign):
    """What is doubtful is shown with the answer, warned of by what stands on it, and no part of an error."""
    words = "only 10 grains across the plate"
    assert any(words in text for text in campaign.warnings), campaign.warnings
    assert f"warning: {words}" in repr(campaign) and f"<b>warning:</b> {words}" in campaign._repr_html_()
    said = io.StringIO()
    with contextlib.redirect_stderr(said):
        campaign.resume()
    assert f"warning: {words}" in said.getvalue(), said.getvalue()
    stand_in = campaign.folder.parent / "stand_in"
    stand_in.write_text("#!/bin/sh\necho warning: doubtful >&2\n"
                        "case $3 in *0.5) echo {};; *) echo talus: broken >&2; exit 1;; esac\n")
    stand_in.chmod(0o755)
    program, os.environ["TALUS_PROGRAM"] = os.environ["TALUS_PROGRAM"], str(stand_in)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        campaign.consider(sliding_friction=0.5)
        try:
            campaign.consider(sliding_friction=0.6)
        except talus.Error as error:
            assert str(error) == "broken", error
    assert [(str(one.message), one.filename) for one in caught] == [("doubtful", __file__)] * 2, caught
    os.environ["TALUS_PROGRAM"] = program


def check_inference_data(campaign):
    """What ArviZ is given, by a stand-in that keeps it: the dependency is not a hard one."""
    (campaign.folder / "posterior.csv").write_text("sliding_friction\n0.5\n0.6\n")
    draws = campaign.posterior()
    assert draws.sliding_friction.tolist() == [0.5, 0.6] and draws.attrs["units"] == {"sliding_friction": ""}
    sys.modules["arviz"] = None
    raises(ImportError, "needs ArviZ", campaign.to_inference_data)
    stand_in = types.ModuleType("arviz")
    stand_in.InferenceData = lambda **groups: groups
    sys.modules["arviz"] = stand_in
    posterior = campaign.to_inference_data()["posterior"]
    del sys.modules["arviz"]
    assert posterior.sliding_friction.dims == ("chain", "draw")
    assert posterior.sliding_friction.values.tolist() == [[0.5, 0.6]]
    assert posterior.sliding_friction.attrs == {"units": "", "searched_min": 0.1, "searched_max": 0.9}


os.environ["TALUS_PROGRAM"] = sys.argv[1]
with tempfile.TemporaryDirectory() as scratch:
    check_campaign(pathlib.Path(scratch))
    check_film(pathlib.Path(scratch))
print("the module runs and reads campaigns")
