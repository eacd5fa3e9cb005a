#!/usr/bin/python3
"""film_and_paraview_test.py TALUS SCREENSHOTS: films of lifts, and a campaign's heap with plate and tube for ParaView,
which opens it where it is installed and leaves a picture in the folder SCREENSHOTS."""
import base64
import contextlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import types

FRAME = {"width_px": 120, "height_px": 80, "pixel_size": 1e-4, "center_x_px": 60, "baseline_px": 70,
         "plate_diameter": 0.01}
CASE = {"powder": {"sizes": {"kind": "mono", "diameter": "1 mm"}, "mass": "0.3 g",
                   "material": {"density": 2500, "youngs_modulus": "1 MPa"}}, "device": {"lift_velocity": "5 cm/s"}, "frame": FRAME}


def run(talus, *arguments, status=0):
    ended = subprocess.run([talus, *map(str, arguments)], capture_output=True, text=True)
    assert ended.returncode == status, (arguments, ended.stdout, ended.stderr)
    return ended.stdout + ended.stderr


def frames_of(gif):
    """Image blocks of a GIF, by its own structure."""
    at, count = 13 + 3 * 256, 0
    while gif[at] != 0x3b:
        if gif[at] == 0x2c:
            count += 1
            at += 11
        else:
            at += 2
        while gif[at]:
            at += gif[at] + 1
        at += 1
    return count


def check_film(talus, root):
    (root / "case.json").write_text(json.dumps(CASE))
    film, folder = root / "heap.gif", root / "frames"
    run(talus, "simulate", root / "case.json", "--out", root / "heap", "--film", film, "--quiet")
    gif = film.read_bytes()
    assert gif.startswith(b"GIF89a") and 5 < frames_of(gif) <= 160, frames_of(gif)
    plain = json.loads((root / "heap/result.json").read_text())
    # Filmed anew, though it is done already, and with the same result.
    run(talus, "simulate", root / "case.json", "--out", root / "heap", "--film", folder, "--quiet")
    pictures = sorted(folder.glob("*.png"))
    assert len(pictures) >= 80 and pictures[0].name == "0001.png"  # so that every second one has gone, once or more
    sizes = [picture.stat().st_size for picture in pictures[:2]]
    assert sizes[0] > 0.7 * sizes[1], sizes  # the first one has lost its powder
    again = json.loads((root / "heap/result.json").read_text())
    for result in (plain, again):
        result.pop("timing"), result.pop("checksum_xxh3", None)
    assert plain == again
    said = run(talus, "simulate", root / "case.json", "--out", root / "other", "--film", root / "heap.mp4", status=2)
    assert "ffmpeg" in said, said
    # Before anything is simulated: no place for a file, and a folder of somebody's own.
    (root / "mine").mkdir()
    (root / "mine/0001.png").write_text("mine")
    for place, why in [(root / "nowhere/heap.gif", "there is no folder"), (root / "mine", "holds files")]:
        said = run(talus, "simulate", root / "case.json", "--out", root / "other", "--film", place, status=2)
        assert why in said and not (root / "other").exists(), said
    assert (root / "mine/0001.png").read_text() == "mine"
    # A film is made anew, another's picture left alone.
    (root / "mine/cat.gif").write_bytes(b"GIF89a cat;")
    said = run(talus, "simulate", root / "case.json", "--out", root / "other", "--film", root / "mine/cat.gif", status=2)
    assert "has not written" in said and (root / "mine/cat.gif").read_bytes() == b"GIF89a cat;", said
    run(talus, "simulate", root / "case.json", "--out", root / "heap", "--film", film, "--quiet")
    assert film.read_bytes() == gif
    # Another case's result was replaced, which nobody had asked for.
    (root / "another.json").write_text(json.dumps(CASE | {"seed": 77}))
    said = run(talus, "simulate", root / "another.json", "--out", root / "heap", "--film", folder, status=2)
    assert "holds the result of another input" in said and film.read_bytes() == gif, said
    assert json.loads((root / "heap/result.json").read_text())["input_hash"] == plain["input_hash"]
    (root / "scene.json").write_text('{"materials": [{}]}')
    said = run(talus, "simulate", root / "scene.json", "--out", root / "scene", "--film", film, status=2)
    assert "--film is for the case of a bulk test" in said, said


def check_poured_film(talus, root):
    """As high as that of the dense filling, and written beside the heap where the case asks for it."""
    height = {}
    for kind in ("dense", "pour"):
        case = CASE | {"filling": {"kind": kind}, "outputs": {"film": True}}
        (root / f"{kind}.json").write_text(json.dumps(case))
        run(talus, "simulate", root / f"{kind}.json", "--out", root / kind, "--quiet")
        gif = (root / kind / "film.gif").read_bytes()
        assert 5 < frames_of(gif) <= 48, frames_of(gif)
        height[kind] = int.from_bytes(gif[8:10], "little")
    assert height["pour"] >= 0.9 * height["dense"], height


class Recorded:
    """Stands in for ParaView's objects: takes any property and any call."""

    def __init__(self, kind, **keys):
        self.kind = kind
        self.__dict__.update(keys)

    def __getattr__(self, name):
        return lambda *arguments, **keys: Recorded(name)


def open_state(state):
    """What the state asks ParaView for."""
    made = []
    simple = types.ModuleType("paraview.simple")

    def record(kind):
        def make(*arguments, **keys):
            made.append(Recorded(kind, arguments=arguments, **keys))
            return made[-1]
        return make
    names = ("GetActiveViewOrCreate XMLPolyDataReader Elevation Glyph Show ColorBy GetColorTransferFunction "
             "GetScalarBar ResetCamera Render").split()
    simple.__dict__.update({name: record(name) for name in names}, __all__=names)
    sys.modules.update({"paraview": types.ModuleType("paraview"), "paraview.simple": simple})
    exec(compile(state.read_text(), str(state), "exec"), {})
    return made


# What ParaView itself makes of the state, and a picture of it.
IN_PARAVIEW = '''
import json, sys
from paraview.simple import *
state, picture, found = sys.argv[1:4]
exec(compile(open(state).read(), state, "exec"), {})
view = GetActiveView()
seen = {}
for (name, _), source in GetSources().items():
    source.UpdatePipeline()
    data = source.GetDataInformation()
    seen[name] = {"points": data.GetNumberOfPoints(), "bounds": data.GetBounds(),
                  "shown": bool(GetRepresentation(source, view).Visibility)}
seen["heap"]["heights_mm"] = FindSource("height").PointData["Elevation"].GetRange()
SaveScreenshot(picture, view, ImageResolution=[900, 600])
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.util.numpy_support import vtk_to_numpy
reader = vtkPNGReader()
reader.SetFileName(picture)
reader.Update()
pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(int)
seen["coloured"] = int((pixels.max(axis=1) - pixels.min(axis=1) > 60).sum())
json.dump(seen, open(found, "w"))
'''


@contextlib.contextmanager
def a_screen():
    """An environment with a virtual display: a DISPLAY that is set may be nobody's. xvfb-run may take one that is just
    ending."""
    number, told = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(told), "-screen", "0", "1280x1024x24", "-nolisten", "tcp"],
                              pass_fds=[told], stderr=subprocess.DEVNULL)
    os.close(told)
    try:
        with open(number) as display:
            yield {**os.environ, "DISPLAY": ":" + display.readline().strip()}
    finally:
        server.terminate()
        server.wait()


def check_paraview(out, num_grains, shots):
    """The state opened by ParaView: every grain is there, on its plate, and coloured by its height."""
    missing = [program for program in ("pvbatch", "Xvfb") if shutil.which(program) is None]
    if missing or subprocess.run(["/usr/bin/python3", "-c", "import paraview"], stderr=subprocess.DEVNULL).returncode:
        print("the state was not opened by ParaView: " + (", ".join(missing) or "its Python module") + " is not installed")
        return
    (out / "tried.py").write_text(IN_PARAVIEW)
    shots.mkdir(parents=True, exist_ok=True)
    picture = shots / "paraview.png"
    with a_screen() as environment:
        ended = subprocess.run(["pvbatch", out / "tried.py", out / "state.py", picture, out / "seen.json"],
                               env=environment, capture_output=True, text=True, timeout=600)
    if "bad X server connection" in ended.stderr:
        print("the state was not opened by ParaView: it did not get the screen")
        return
    assert ended.returncode == 0, ended.stdout + ended.stderr
    seen = json.loads((out / "seen.json").read_text())
    assert seen["heap"]["points"] == num_grains, seen
    assert all(seen[name]["shown"] for name in ("grains", "plate", "tube")), seen
    grains, plate, tube = (seen[name]["bounds"] for name in ("grains", "plate", "tube"))
    # Glyphs are some-sided balls of 1 mm: they end a little before the grains do, and stand on the plate.
    assert -1e-4 < grains[4] < 2e-4 and grains[5] <= tube[4] + 1e-4, seen
    assert abs(plate[5]) < 1e-12 and plate[0] - 1e-3 < grains[0] and grains[1] < plate[1] + 1e-3, seen
    assert 0 < seen["heap"]["heights_mm"][0] < seen["heap"]["heights_mm"][1] <= 1e3 * grains[5] + 0.1, seen
    # The heap is some 10 mm of the 12 mm that the picture shows, and a third as high.
    assert seen["coloured"] > 0.03 * 900 * 600, seen
    print(f"ParaView opened the state; its picture is {picture}")


def read_with_vtk(file):
    """Points, polygons and bounds, where VTK is here; else nothing."""
    try:
        from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    except ImportError:
        return None
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(file))
    reader.Update()
    data = reader.GetOutput()
    return data.GetNumberOfPoints(), data.GetNumberOfPolys(), data.GetBounds()


def check_vtk(talus, root, shots):
    spec = {"experiment": {"map": str(root / "heap/profile.png"), "plate_diameter": "10 mm", "frame": FRAME},
            "powder": CASE["powder"], "device": CASE["device"],
            "parameters": {"sliding_friction": {"min": 0.1, "max": 0.9}},
            "strategy": {"kind": "sobol", "num_points": 3}, "budget": {"simulations": 3}, "confirm": {"candidates": 1, "replicates": 1, "ends": False}}
    (root / "spec.json").write_text(json.dumps(spec))
    run(talus, "calibrate", root / "spec.json", "--out", root / "run", "--quiet")
    films = list(root.glob("run/trials/*/film.gif"))
    assert len(films) == 1, films  # of the trial that confirms
    run(talus, "report", root / "run")
    page = (root / "run/report/report.html").read_text()
    assert base64.b64encode(films[0].read_bytes()).decode() in page
    run(talus, "export", root / "run", "--vtk")
    out = root / "run/vtk"
    assert sorted(file.name for file in out.glob("*.vtp")) == ["heap.vtp", "plate.vtp", "tube.vtp"]
    made = open_state(out / "state.py")
    readers = [m for m in made if m.kind == "XMLPolyDataReader"]
    assert [pathlib.Path(m.FileName[0]).name for m in readers] == ["heap.vtp", "tube.vtp", "plate.vtp"]
    assert all(pathlib.Path(m.FileName[0]).exists() for m in readers)
    grains = next(m for m in made if m.kind == "Glyph")
    assert grains.ScaleArray == ["POINTS", "diameter_m"] and grains.ScaleFactor == 1 and grains.GlyphMode == "All Points"
    assert sum(m.kind == "Show" for m in made) == 3
    plate = read_with_vtk(out / "plate.vtp")
    if plate is not None:
        points, polygons, bounds = plate
        assert points == 128 and polygons == 66  # two ends and 64 sides of the solid plate
        assert abs(bounds[1] - 5e-3) < 1e-5 and abs(bounds[5]) < 1e-12, bounds  # its top is z = 0
    num_grains = int(re.search(rb'NumberOfPoints="(\d+)"', (out / "heap.vtp").read_bytes()).group(1))
    assert num_grains > 100, num_grains
    check_paraview(out, num_grains, shots)
    run(talus, "export", root / "run", "--vtk", "--trial", 2, "--out", root / "second")
    said = run(talus, "export", root / "run", "--vtk", "--trial", 99, "--out", root / "third", status=2)
    assert "--trial names another trial" in said, said
    said = run(talus, "export", root / "run", "--trial", 1, status=2)
    assert "--vtk" in said, said


def heights_of(wall):
    """Lowest and highest z of a wall's .vtp, which is text."""
    numbers = re.search(r'NumberOfComponents="3" format="ascii">(.*?)<', wall.read_text(), re.S).group(1).split()
    heights = [float(word) for word in numbers[2::3]]
    return min(heights), max(heights)


def check_rim(talus, root):
    """A heap is drawn where it lies: what it shows begins at the rim's top, as in its photograph."""
    rig = {"kind": "funnel_heap", "plate_diameter": "10 mm", "rim_height": "2 mm", "outlet": "5 mm", "height": "10 mm"}
    heap = {"name": "heap", "rig": rig, "filling": {"kind": "pour"}, "mass_on_plate": {"value": "150 mg", "sd": "10 mg"}}
    spec = {"experiments": [heap], "powder": {**CASE["powder"], "mass": "0.4 g"},
            "parameters": {"sliding_friction": {"min": 0.1, "max": 0.9}},
            "budget": {"simulations": 2}, "confirm": {"candidates": 0}}
    (root / "rim.json").write_text(json.dumps(spec))
    run(talus, "calibrate", root / "rim.json", "--out", root / "rim", "--quiet")
    run(talus, "export", root / "rim", "--vtk")
    plate, rim = (heights_of(root / "rim/vtk" / name) for name in ("plate.vtp", "rim.vtp"))
    assert abs(plate[1] + 2e-3) < 1e-9 and abs(rim[0] + 2e-3) < 1e-9 and abs(rim[1]) < 1e-9, (plate, rim)
    top = float(re.search(r"HighPoint = \[0.0, 0.0, (.*)\]", (root / "rim/vtk/state.py").read_text()).group(1))
    assert 0 < top < 4e-3, top


with tempfile.TemporaryDirectory(prefix="talus_film_") as scratch:
    check_film(sys.argv[1], pathlib.Path(scratch))
    check_poured_film(sys.argv[1], pathlib.Path(scratch))
    check_vtk(sys.argv[1], pathlib.Path(scratch), pathlib.Path(sys.argv[2]))
    check_rim(sys.argv[1], pathlib.Path(scratch))
print("the film plays and ParaView has its state")
