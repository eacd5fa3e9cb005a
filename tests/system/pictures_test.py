#!/usr/bin/python3
"""pictures_test.py TALUS SOURCE: the scripts that draw what the docs show."""
import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

TALUS = sys.argv[1]
SOURCE = pathlib.Path(sys.argv[2])
PAPER = (250, 250, 248)
PLATE = (120, 128, 138)


def script(name, *arguments):
    subprocess.run([SOURCE / "scripts" / name, *map(str, arguments)], check=True)


def pixels(file):
    """Rows of (red, green, blue) of a PNG whose rows are stored as they are."""
    data = file.read_bytes()
    width, height = struct.unpack(">II", data[16:24])
    start = data.index(b"IDAT") + 4
    (length,) = struct.unpack(">I", data[start - 8:start - 4])
    rows = zlib.decompress(data[start:start + length])
    assert len(rows) == height * (1 + 3 * width), len(rows)
    return [[tuple(rows[y * (1 + 3 * width) + 1 + 3 * x:][:3]) for x in range(width)] for y in range(height)]


def is_sand(pixel):
    return pixel[0] > pixel[1] > pixel[2] + 20


def simulate(folder, scene):
    """Three spheres of 2 mm at rest, none of which touches another."""
    file = folder / "scene.json"
    file.write_text(json.dumps(scene))
    subprocess.run([TALUS, "simulate", file, "--out", folder / "run"], check=True, stdout=subprocess.DEVNULL)
    return folder / "run"


def spheres(*centres):
    beads = {"name": "beads", "density": 2500, "youngs_modulus": "5 MPa", "poisson_ratio": 0.25, "restitution": 0.5}
    return {
        "materials": [beads], "gravity": [0, 0, 0], "stop": {"time": "0.1 ms"},
        "spheres": [{"position": centre, "diameter": "2 mm"} for centre in centres],
        "walls": [{"name": "floor", "shape": "rectangle", "position": [0, 0, "-4 mm"], "direction": [0, 0, 1],
                   "width": "20 mm", "height": "10 mm"},
                  {"name": "gate", "shape": "rectangle", "position": ["9 mm", 0, 0], "direction": [1, 0, 0],
                   "width": "8 mm", "height": "10 mm"}],
        "domain": {"low": ["-20 mm"] * 3, "high": ["20 mm"] * 3}}


def test_drawings_of_rigs_are_those_of_the_script(folder):
    script("draw_rigs", folder)
    drawn = sorted(folder.glob("rig_*.svg"))
    assert len(drawn) == 9, drawn
    for drawing in drawn:
        kept = SOURCE / "docs" / "images" / drawing.name
        assert drawing.read_bytes() == kept.read_bytes(), f"{kept} is not what scripts/draw_rigs draws"


def test_a_heap_stands_on_its_plate(folder):
    run = simulate(folder, spheres((0, 0, "1 mm"), ("3 mm", 0, "1 mm"), (0, "-3 mm", "1 mm")))
    script("render_heap", run / "final.vtp", folder / "heap.png", "--plate", 0.01, "--width", 230, "--elevation", 30)
    picture = pixels(folder / "heap.png")
    # The plate takes 1/1.15 of the width; 20 px to the millimetre. Above it is the height of 2 mm, by cos 30 degrees.
    scale = 20
    top = 1.06 * scale * (2 * math.cos(math.pi / 6) + 5 * math.sin(math.pi / 6))

    def at(x, y, z):
        return picture[round(top - scale * (z * math.cos(math.pi / 6) + y * math.sin(math.pi / 6)))][115 + scale * x]

    assert len(picture[0]) == 230
    assert is_sand(at(0, 0, 1)) and is_sand(at(3, 0, 1)) and is_sand(at(0, -3, 1))
    assert not is_sand(at(-3, 0, 1)), at(-3, 0, 1)
    assert at(-3, 0, 0) == PLATE and picture[0][0] == PAPER


def test_a_scene_has_its_walls_and_may_be_turned(folder):
    run = simulate(folder, spheres((0, 0, 0), ("5 mm", 0, 0), (0, 0, "3 mm")))
    script("render_scene", run, folder / "scene.png", "--width", 240)
    script("render_scene", run, folder / "open.png", "--width", 240, "--without", "gate")
    script("render_scene", run, folder / "turned.png", "--width", 240, "--turn", 90)
    whole, without, turned = (pixels(folder / name) for name in ("scene.png", "open.png", "turned.png"))
    scale = 0.88 * 240 / 20  # px to the millimetre: from -10 to 10 mm between margins of 6 %

    # The lowest point is the edge of the gate, and without it the floor.
    for picture, lowest in ((whole, -5), (without, -4)):
        def at(x, z):
            return picture[round(len(picture) - 0.06 * 240 - scale * (z - lowest))][round(120 + scale * x)]

        def has_line(x, z):  # of 1.5 px, somewhere within a pixel
            return any(max(at(x + i / scale, z + j / scale)) < 200 for i in (-1, 0, 1) for j in (-1, 0, 1))

        assert is_sand(at(0, 0)) and is_sand(at(5, 0)) and is_sand(at(0, 3))
        assert at(-5, 0) == PAPER and has_line(-5, -4)
        assert has_line(9, 2) == (picture is whole)
    assert len(turned) > len(turned[0]) and len(whole) < len(whole[0])


for test in [value for name, value in sorted(globals().items()) if name.startswith("test_")]:
    with tempfile.TemporaryDirectory() as place:
        test(pathlib.Path(place))
    print("ok", test.__name__)
