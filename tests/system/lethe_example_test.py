#!/usr/bin/env python3
"""lethe_example_test.py TALUS SOURCE_DIR: the decks of examples/lethe, filled in, are a parameter file that
nests and an insertion file with every grain, and what Lethe leaves, a PVTU file with its parts, is read. In
the place of Lethe, which no distribution has, stands a program that reads both and writes the heap in
Lethe's form."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from commented_json import read_json

# Takes the grains that were inserted, moves them onto the plate in a pile, and writes two parts.
FAKE = r'''#!/usr/bin/env python3
import re
import sys

depth, values = [], {}
for line in open(sys.argv[1]):
    line = line.split("#")[0].strip()
    if line.startswith("subsection "):
        depth.append(line[len("subsection "):])
    elif line == "end":
        depth.pop()
    elif line.startswith("set "):
        name, value = line[4:].split("=", 1)
        values["/".join(depth + [name.strip()])] = value.strip()
    elif line:
        sys.exit("not a line of a parameter file: " + line)
assert not depth, depth
assert "{{" not in open(sys.argv[1]).read()
particles = "lagrangian physical properties/particle type 0/"
rows = [row.strip().rstrip(";").split(";") for row in open(values["insertion info/list of input files"])]
assert [name.strip() for name in rows[0]][-1] == "diameters", rows[0]
grains = [list(map(float, row)) for row in rows[1:]]
assert len(grains) == int(values[particles + "number of particles"]), len(grains)
assert all(len(grain) == 10 for grain in grains)
assert max(grain[-1] for grain in grains) <= float(values[particles + "diameter"]) * 1.0001
for number in range(2):
    mesh = open(values["solid objects/solid surfaces/solid object %d/mesh/file name" % number]).read()
    nodes = int(re.search(r"\$Nodes\n(\d+)", mesh)[1])
    triangles = re.findall(r"^\d+ 2 2 1 1 (\d+) (\d+) (\d+)$", mesh, re.M)
    assert len(triangles) == int(re.search(r"\$Elements\n(\d+)", mesh)[1])
    assert {int(corner) for triangle in triangles for corner in triangle} == set(range(1, nodes + 1))
control = {key.split("/")[1]: value for key, value in values.items() if key.startswith("simulation control/")}
print("friction", values[particles + "friction coefficient particles"], "end", control["time end"])
layer = lambda i: ((i % 9 - 4) * 1e-3, (i // 9 % 9 - 4) * 1e-3, 0.5e-3 + i // 81 * 1e-3)
for step, shown in (("00000", grains[:10]), ("01000", grains)):
    half = len(shown) // 2
    for part, some in enumerate((shown[:half], shown[half:])):
        first = part * half
        points = " ".join("%g %g %g" % layer(first + i) for i in range(len(some)))
        sizes = " ".join("%g" % grain[-1] for grain in some)
        open("heap.%s.%05d.vtu" % (step, part), "w").write(
            '<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>'
            '<Piece NumberOfPoints="%d" NumberOfCells="0"><Points><DataArray type="Float32" '
            'NumberOfComponents="3" format="ascii">%s</DataArray></Points><PointData Scalars="scalars">'
            '<DataArray type="Float32" Name="diameter" format="ascii">%s</DataArray></PointData>'
            '</Piece></UnstructuredGrid></VTKFile>' % (len(some), points, sizes))
    open("heap.%s.pvtu" % step, "w").write(
        '<VTKFile type="PUnstructuredGrid" version="0.1" byte_order="LittleEndian">'
        '<PUnstructuredGrid GhostLevel="0"><PPointData Scalars="scalars"><PDataArray type="Float32" '
        'Name="diameter" format="ascii"/></PPointData><PPoints><PDataArray type="Float32" '
        'NumberOfComponents="3"/></PPoints>' + "".join('<Piece Source="heap.%s.%05d.vtu"/>' % (step, part)
                                                       for part in range(2)) +
        '</PUnstructuredGrid></VTKFile>')
'''


def main(root):
    talus, source = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    example = source / "examples/lethe"
    spec = read_json(example / "campaign.json")
    (root / "bin").mkdir()
    fake = root / "bin/lethe-particles"
    fake.write_text(FAKE)
    fake.chmod(0o755)
    os.environ["PATH"] = f"{root / 'bin'}:{os.environ['PATH']}"
    subprocess.run([talus, "validate", example / "campaign.json"], check=True, stdout=subprocess.DEVNULL)
    engine = {key: value for key, value in spec["engine"].items() if key != "kind"}
    case = {"engine": {**engine, "templates": str(example / "deck")},
            "powder": spec["powder"], "device": spec["device"], "rules": spec["rules"],
            "coarse_graining": spec["coarse_graining"], "rayleigh_fraction": 0.15,
            "frame": {"width_px": 160, "height_px": 120, "pixel_size": "100 um", "center_x_px": 80,
                      "baseline_px": 100, "plate_diameter": "10 mm"}}
    case["powder"]["material"].update(sliding_friction=0.4321, rolling_friction=0.1)
    (root / "case.json").write_text(json.dumps(case))
    subprocess.run([talus, "simulate", root / "case.json", "--out", root / "trial"], check=True,
                   stdout=subprocess.DEVNULL)
    result = json.loads((root / "trial/result.json").read_text())
    grains = len((root / "trial/particles.input").read_text().splitlines()) - 1
    assert grains > 500 and result["counts"]["in_file"] == grains, (grains, result)  # the last, whole
    assert result["counts"]["on_heap"] == grains, result
    log = re.search(r"friction (\S+) end (\S+)", (root / "trial/log.txt").read_text())
    # Settles, lifts by 1.2 of some 9 mm at 50 mm/s, and rests.
    assert float(log[1]) == 0.4321 and 0.3 < float(log[2]) < 1, log


with tempfile.TemporaryDirectory(prefix="talus_lethe_") as folder:
    main(pathlib.Path(folder))
