#!/usr/bin/env python3
"""python_test.py TALUS MODULE_DIR: the Python module drives strategies, simulates, draws and compares."""
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, sys.argv[2])
import numpy

import talus
from python_case import CASE, FRAME, raises


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
    # As in specs: min and max.
    named = [{"name": "friction", "min": 0.1, "max": 0.9}, {"name": "energy", "min": 1e-6, "max": 1e-3, "scale": "log"}]
    assert talus.Strategy(named, {"kind": "gp"}, seed=3).ask() == talus.Strategy(parameters, {"kind": "gp"}, seed=3).ask()
    raises(talus.ConfigError, "min and low", talus.Strategy, [{"name": "a", "min": 0, "low": 0, "max": 1}])
    assert repr(talus.Strategy(named)) == "<talus.Strategy of friction, energy>"
    strategy = talus.Strategy(parameters)
    raises(talus.ConfigError, "energy", strategy.tell, {"friction": 0.5}, 1.0)
    raises(talus.ConfigError, "needs a value", strategy.tell, {"friction": 0.5, "energy": 1e-4})
    raises(talus.ConfigError, "beyond 1e100", strategy.tell, {"friction": 0.5, "energy": 1e-4}, -1e160)
    for energy in (1.0, -1.0, float("nan")):
        raises(talus.ConfigError, "outside the searched range", strategy.tell, {"friction": 0.5, "energy": energy}, 1.0)
    raises(talus.ConfigError, "friction: 0.9000001 is outside the searched range, 0.1 to 0.9", strategy.tell,
           {"friction": 0.9000001, "energy": 1e-4}, 1.0)
    raises(ValueError, "frictoin", talus.Strategy, [{"name": "a", "low": 0, "high": 1}],
           {"frictoin": 1})
    check_refusals()


def check_refusals():
    """Every argument's kind, shape and range: words of ours, never a crash and never a silent answer."""
    one = [{"name": "a", "low": 0, "high": 1}]
    for bad in (None, 3, "a", {"name": "a"}):
        raises(talus.ConfigError, "parameters: must be a list", talus.Strategy, bad)
    raises(talus.ConfigError, "parameters[1]: must be a dictionary", talus.Strategy, [*one, "b"])
    for low, high in ((-1e308, 1e308), (0, 1e-320), (1, 1 + 1e-15)):
        raises(talus.ConfigError, "high: is", talus.Strategy, [{"name": "a", "low": low, "high": high}])
    for given, words in (({"min": 1, "max": 0}, "parameters[0].max: is 0, must be above min"),
                         ({"min": "low", "max": 1}, 'parameters[0].min: "low" does not start'),
                         ({"min": 1, "high": 0}, "parameters[0].high: is 0, must be above low"),
                         ({"min": 0, "max": 10**400}, "parameters[0].max: is beyond 1.8e308")):
        raises(talus.ConfigError, words, talus.Strategy, [{"name": "a", **given}])
    raises(talus.ConfigError, "options: typo: is not known", talus.Strategy, one, {"typo": 1})
    for seed in (-1, 2**64, 1.5, True):
        raises(talus.ConfigError, "seed", talus.Strategy, one, seed=seed)
    image = numpy.full((8, 9), 255, numpy.uint8)
    for bad in (numpy.nan, -1, 0, numpy.inf, True, 10**400):
        raises(talus.ConfigError, "pixel_area", talus.Strategy, one, target=image, pixel_area=bad)
    for bad, words in ((image[0], "two dimensions"), (image[:0], "is empty"), (image / 255, "of float64"),
                       (image == 0, "of bool"), (image.astype(int), "of int64"), ("image", "must be bytes")):
        raises(talus.ConfigError, "target: ", talus.Strategy, one, target=bad)
        raises(talus.ConfigError, words, talus.Strategy, one, target=bad)
        raises(talus.ConfigError, words, talus.Strategy(one, target=image).tell, {"a": .5}, image=bad)
        raises(talus.ConfigError, words, talus.compare, bad, numpy.zeros((80, 120), numpy.uint8), FRAME)
    raises(talus.ConfigError, "pixel_area: must be a number", talus.Strategy, one, target=image, pixel_area="4")
    strategy = talus.Strategy(one)
    for bad in (0, 9, 1.0, 2**40, "1", True, None):
        raises(talus.ConfigError, "count: must be a whole number from 1 to 8", strategy.ask, bad)
    for bad in ("no", 1, None):
        raises(talus.ConfigError, "failed: must be True or False", strategy.tell, {"a": .5}, failed=bad)
    strategy.tell({"a": .5}, failed=numpy.bool_(True))
    assert len(strategy.ask(numpy.int32(2))) == 2
    for bad in (0, 3601, 16.0, 2**40, "4", True, None):
        raises(talus.ConfigError, "num_views: must be a whole number", talus.project, numpy.zeros((0, 4)), FRAME, bad)
    foreign = os.fsdecode(b"\xff.png")
    for call in (lambda: talus.read_image(foreign), lambda: talus.simulate(foreign, "x"),
                 lambda: talus.simulate("x", foreign)):
        raises(talus.ConfigError, "is no name in UTF-8", call)
    for bad, words in (("", "is empty"), ("a\0b", r"'a\x00b' has a NUL byte"), (3, "must be a path; it is a int")):
        raises(talus.ConfigError, f"file: {words}", talus.read_image, bad)
        raises(talus.ConfigError, f"file: {words}", talus.simulate, bad, "x")
        raises(talus.ConfigError, f"folder: {words}", talus.simulate, "x", bad)
        raises(talus.ConfigError, f"folder: {words}", talus.Campaign, bad)
    raises(talus.ConfigError, "fresh: must be True or False", talus.simulate, "x", "y", "no")
    raises(talus.ConfigError, "no target", strategy.tell, {"a": .5}, 1.0, image=image)
    raises(talus.ConfigError, "values: must be a dictionary", strategy.tell, [.5], 1.0)
    raises(talus.ConfigError, "a: must be a number; it is a str", strategy.tell, {"a": "x"}, 1.0)
    raises(talus.ConfigError, "value: must be a number; it is a list", strategy.tell, {"a": .5}, [1])
    raises(talus.ConfigError, "value: must be a number; it is a bool", strategy.tell, {"a": .5}, True)
    raises(talus.ConfigError, "value: is beyond 1.8e308", strategy.tell, {"a": .5}, 10**400)
    raises(talus.ConfigError, "no parameters'; there are a", strategy.tell, {"a": .5, "b": 1}, 1.0)
    raises(AttributeError, "_core", talus.Strategy.__new__(talus.Strategy).ask)


def check_ends():
    """Asking and telling ends where nothing is left, and where nothing works; told is what was asked for."""
    levels = [{"name": "a", "levels": numpy.array([1., 2., 3.])}, {"name": "b", "fixed": numpy.int64(7)}]
    strategy = talus.Strategy(levels, {"kind": "gp", "exact": True}, seed=numpy.int64(3))
    told = 0
    while not strategy.stop_reason():
        for values in strategy.ask():
            strategy.tell(values, values["a"])
            told += 1
        assert told < 20
    assert strategy.stop_reason() == "the strategy has no more points" and strategy.answer()["values"]["a"] == 1
    raises(talus.ConfigError, "none of its levels; the nearest is 2", strategy.tell, {"a": 1.9, "b": 7}, 1.)
    raises(talus.ConfigError, "not what it is fixed at, 7", strategy.tell, {"a": 2, "b": 8}, 1.)
    broken = talus.Strategy([{"name": "a", "min": 0, "max": numpy.float32(1)}])
    assert broken.answer()["predicted_sd"] is None
    raises(talus.ConfigError, "has failed has none", broken.tell, {"a": .5}, 3., failed=True)
    while not broken.stop_reason():
        for values in broken.ask():
            broken.tell(values, failed=True)
    assert broken.stop_reason() == "the first 8 evaluations all failed"
    raises(talus.ConfigError, "parameters[0].max: is inf", talus.Strategy, [{"name": "a", "min": 0, "max": numpy.inf}])
    raises(talus.ConfigError, "parameters[0].min: is missing", talus.Strategy, [{"name": "a"}])
    raises(talus.ConfigError, "options: must be", talus.Strategy, levels, "gp")


def check_threads():
    """Others run while a heap is drawn or compared: of 60 ms, none of which Python's own thread could have, some are
    theirs."""
    spheres = numpy.column_stack([numpy.zeros((40000, 2)), numpy.full((40000, 2), 1e-3)])
    large = numpy.full((4000, 6000), 255, numpy.uint8)
    large[2000:, 1000:5000] = 0
    frame = {**FRAME, "width_px": 6000, "height_px": 4000, "center_x_px": 3000, "baseline_px": 3900, "pixel_size": 2e-6}
    for work in (lambda: talus.project(spheres, FRAME, 2000), lambda: talus.compare(large, large, frame)):
        ticks = []
        working = threading.Thread(target=work)
        working.start()
        while working.is_alive():
            ticks.append(time.monotonic())
            time.sleep(1e-3)
        assert len(ticks) > 10, ticks


def check_forked_processes():
    """A pool's process, forked after loops on several threads, draws and searches as its parent does."""
    code = """
import multiprocessing, numpy, talus
spheres = numpy.column_stack([numpy.zeros((4000, 2)), numpy.full((4000, 2), 1e-3)])
def drawn(_): return int(talus.project(spheres, %r).sum())
def found(_):
    strategy = talus.Strategy([{"name": "a", "min": 0, "max": 1}, {"name": "b", "min": 0, "max": 1}], {"kind": "gp"})
    for _ in range(25):
        for values in strategy.ask(): strategy.tell(values, (values["a"] - .3) ** 2 + values["b"])
    return strategy.answer()["values"]
expected = drawn(0), found(0)
with multiprocessing.get_context("fork").Pool(1) as pool:
    assert (pool.map_async(drawn, [0]).get(60)[0], pool.map_async(found, [0]).get(60)[0]) == expected
""" % FRAME
    told = os.environ | {"OMP_NUM_THREADS": "2", "PYTHONPATH": sys.argv[2]}
    subprocess.run([sys.executable, "-c", code], env=told, check=True)


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
    raises(talus.ConfigError, "learns from images", strategy.tell, {"height": 3}, 1.0)
    empty = talus.Strategy([{"name": "height", "low": 2, "high": 38}], seed=2, target=image(17))
    for _ in range(12):
        for values in empty.ask():
            empty.tell(values, image=image(0))
    raises(talus.ConfigError, "size of the target", strategy.tell, {"height": 3},
           image=numpy.zeros((5, 5), dtype=numpy.uint8))


def check_simulation(root):
    (root / "case.json").write_text(json.dumps(CASE))
    talus.simulate(root / "case.json", root / "heap")
    profile = talus.read_image(root / "heap/profile.png")
    assert profile.shape == (80, 120) and profile.min() == 0
    metrics = talus.compare(profile, profile, FRAME)
    assert metrics["sad_mm2"] == 0 and metrics["iou"] == 1
    check_comparison()
    raises(talus.ConfigError, "case.json", talus.simulate, str(root / "absent/case.json"), str(root / "x"))
    # Remedies name what `simulate` has, not the program's flags.
    (root / "other.json").write_text(json.dumps({**CASE, "seed": 2}))
    raises(talus.ConfigError, "choose another folder, or fresh=True to replace it", talus.simulate, root / "other.json",
           root / "heap")
    (root / "mine --out").mkdir()
    (root / "mine --out/notes.txt").write_text("mine")
    raises(talus.ConfigError, "mine --out: holds files that `talus simulate` has not written and could overwrite; name a "
           "new folder", talus.simulate, root / "case.json", root / "mine --out")
    check_interrupts(root)


def check_comparison():
    """A block of 20 x 15 px against one of 20 x 10: 100 px more, of 0.01 mm2 each; the reference comes second."""
    blocks = [numpy.full((80, 120), 255, numpy.uint8) for _ in range(2)]
    for block, height in zip(blocks, (15, 10)):
        block[70 - height:70, 50:70] = 0
    metrics = talus.compare(*blocks, FRAME)
    expected = {"sad_px": 100, "sad_mm2": 1, "sad_relative": 0.5, "nebp_px": 300, "nebp_mm2": 3, "iou": 2 / 3}
    assert all(abs(metrics[name] - value) < 1e-9 for name, value in expected.items()), metrics


def check_interrupts(root):
    """Ctrl-C is Python's own again after simulations, of which the short one takes none from the long one."""
    fine = {**CASE["powder"], "sizes": {"kind": "mono", "diameter": "0.3 mm"}}  # 10 s and more
    (root / "long.json").write_text(json.dumps({**CASE, "powder": fine}))
    ended = []

    def simulate():
        try:
            talus.simulate(root / "long.json", root / "long")
        except KeyboardInterrupt:
            ended.append("interrupted")

    simulating = threading.Thread(target=simulate)
    simulating.start()
    log = root / "long/log.txt"
    while not (log.exists() and log.stat().st_size):  # it says so when its first steps are done
        time.sleep(1e-2)
    talus.simulate(root / "case.json", root / "short")
    signal.raise_signal(signal.SIGINT)
    simulating.join()
    assert ended == ["interrupted"] and (root / "long/checkpoint.bin").exists(), ended
    raises(KeyboardInterrupt, "", signal.raise_signal, signal.SIGINT)


def check_projection():
    """One sphere of 2 mm: its silhouette has the area of a disc, within a pixel along its rim."""
    image = talus.project(numpy.array([[0, 0, 1e-3, 2e-3]]), FRAME)
    area = (image == 0).sum() * 1e-8
    assert abs(area - numpy.pi * 1e-6) < 2 * numpy.pi * 1e-3 * 1e-4, area
    raises(talus.ConfigError, "four columns", talus.project, numpy.zeros((2, 3)), FRAME)
    for bad in ([numpy.nan, 0, 0, 1e-3], [0, 0, 0, -1e-3], [0, 0, 0, numpy.inf]):
        raises(talus.ConfigError, "row 1", talus.project, numpy.array([[0, 0, 0, 1e-3], bad]), FRAME)
    raises(talus.ConfigError, "give metres", talus.project, numpy.array([[0, 0, 1, 2.]]), FRAME)
    for bad in (numpy.zeros((1, 4), complex), [["a"] * 4], None):
        raises(talus.ConfigError, "must be numbers", talus.project, bad, FRAME)
    one_of_two = numpy.ma.masked_array([[0, 0, 1e-3, 2e-3]] * 2, mask=[[True] * 4, [False] * 4])
    raises(talus.ConfigError, "spheres: is a masked array", talus.project, one_of_two, FRAME)
    assert (talus.project(one_of_two[1:], FRAME) == image).all()  # nothing of it is masked
    raises(talus.ConfigError, "heap: is a masked array", talus.compare, numpy.ma.masked_equal(image, 0), image, FRAME)
    assert (talus.project(numpy.array([[1e300, 0, -1e300, 1e-3]]), FRAME) == 255).all()  # far away
    raises(talus.ConfigError, "num_views", talus.project, numpy.zeros((0, 4)),
           {**FRAME, "width_px": 65500, "height_px": 3000}, 3600)
    empty = numpy.zeros((0, 0), numpy.uint8)
    raises(talus.ConfigError, "is empty", talus.compare, empty, empty, FRAME)
    raises(talus.ConfigError, "reference: has 7 x 5 px", talus.compare, image, numpy.zeros((5, 7), numpy.uint8), FRAME)
    raises(talus.ConfigError, "width", talus.project, numpy.zeros((0, 4)), {**FRAME, "width_px": -1})


def check_module():
    """All that is public is documented, and OpenMP's threads sleep, while the environment stays as it was."""
    for name in set(talus.__all__) - {"__version__"}:
        assert getattr(talus, name).__doc__, name
    told = {name: value for name, value in os.environ.items() if name != "OMP_WAIT_POLICY"}
    ended = subprocess.run([sys.executable, "-c", "import os, talus; assert 'OMP_WAIT_POLICY' not in os.environ"],
                           env=told | {"OMP_DISPLAY_ENV": "true", "PYTHONPATH": sys.argv[2]}, capture_output=True,
                           text=True)
    assert ended.returncode == 0 and "OMP_WAIT_POLICY = 'PASSIVE'" in ended.stderr, ended.stderr


def check_chance_buffers():
    """Arrays of any type, shape and order, full of chance: each is taken, or refused in words."""
    chance = numpy.random.default_rng(4)
    strategy = talus.Strategy([{"name": "a", "low": 0, "high": 1}], target=numpy.full((8, 9), 255, numpy.uint8))
    taken = 0
    for _ in range(400):
        kind = chance.choice(["u1", "?", "i2", ">i4", "f2", ">f8", "c16", "S3", "M8[s]", "V5"])
        shape = tuple(chance.integers(0, 9, chance.integers(0, 4))) if chance.random() < 0.7 else (8, 9)
        size = int(numpy.prod(shape)) * numpy.dtype(kind).itemsize
        array = numpy.frombuffer(chance.bytes(size), kind).reshape(shape)
        if array.ndim and chance.random() < 0.5:
            array = array[..., ::-1]  # its rows run backwards
        for call in (lambda: talus.project(array, FRAME), lambda: talus.compare(array, array, FRAME),
                     lambda: strategy.tell({"a": .5}, image=array)):
            try:
                call()
                taken += 1
            except talus.ConfigError:
                pass
            except (ValueError, TypeError) as error:  # in our words, not those of the binding
                assert "incompatible function arguments" not in str(error), error
    assert taken > 5, taken


check_ask_tell()
check_ends()
check_threads()
check_forked_processes()
check_images_as_evaluations()
check_projection()
check_module()
check_chance_buffers()
with tempfile.TemporaryDirectory() as scratch:
    check_simulation(pathlib.Path(scratch))
print("the module does what it says")
