#!/usr/bin/env python3
"""check_includes.py SOURCE_DIR: includes follow the arrows between folders, no folder stands in a circle
with a neighbour or with one inside it, each folder and floor has one namespace, each third-party library
stays behind its fence, and JSON is printed in one place."""
import collections
import pathlib
import re
import sys

MAY_INCLUDE = {
    "base": {"base"},
    "engine": {"base", "engine"},
    "imaging": {"base", "imaging"},
    "surrogate": {"base", "surrogate"},
    "optimizer": {"base", "surrogate", "optimizer"},
    "experiments": {"base", "engine", "imaging", "surrogate", "optimizer", "experiments"},
    "python": {"base", "engine", "imaging", "surrogate", "optimizer", "experiments", "python"},
}
# experiments/ is a wing with floors: each includes only what stands below it.
FLOORS = {"rigs": 1, "runners": 2, "journal": 2, "trials": 3, "campaign": 4, "analysis": 5, "app": 6}
FENCES = [  # (include, files that may have it)
    (r"nlopt", r"(surrogate|optimizer)/nlopt_\w+\.cc$"),
    (r"ceres/", r"(surrogate|imaging)/[\w/]+\.cc$"),
    (r"sqlite3\.h", r"experiments/journal/\w+\.cc$"),
    (r"(pugixml|zlib)", r"imaging/formats/spheres/vtk_xml\w*\.cc$"),
    (r"(png|jpeglib|tiffio)\.h", r"imaging/formats/images/image_codec_\w+\.cc$"),
    (r"opencv2/", r"imaging/[\w/]+\.cc$"),
    (r"(hwy/|experimental/simd|immintrin)", r"engine/"),
    (r"Eigen/", r"(surrogate|optimizer|imaging|experiments)/"),
    (r"CLI/", r"experiments/"),
    (r"nlohmann/", r"(base/json_\w+\.h|json_file\.(h|cc)|\w+\.cc|\w*json\w*\.h)$"),
]
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')


def upward(name: str, target: str) -> bool:
    """Whether an include inside experiments/ does not lead to a lower floor or stay in its folder."""
    own, other = name.split("/")[1], target.split("/")[1]
    if own not in FLOORS or other not in FLOORS:
        return True
    return own != other and FLOORS[own] <= FLOORS[other]


def namespace_of(name: str) -> str:
    """The namespace of a folder, or of a floor of experiments/."""
    parts = name.split("/")
    return "talus::" + (parts[1] if parts[0] == "experiments" else parts[0])


def rooms(name: str, target: str):
    """The folder that both files are in, and the room of each in it: a sub-folder, or "" for the folder itself."""
    own, other = name.split("/")[:-1], target.split("/")[:-1]
    shared = 0
    while shared < min(len(own), len(other)) and own[shared] == other[shared]:
        shared += 1
    return "/".join(own[:shared]), (own[shared:] or [""])[0], (other[shared:] or [""])[0]


def circles(arrows) -> list:
    """Rooms of one folder from which includes lead back to themselves. `arrows`: {folder: {room: {room: example}}}."""
    found = []
    for folder, leads in sorted(arrows.items()):
        for room in sorted(leads):
            seen, open_rooms = {}, list(leads[room].items())
            while open_rooms:
                other, example = open_rooms.pop()
                if other not in seen:
                    seen[other] = example
                    open_rooms += leads.get(other, {}).items()
            if room in seen:
                found.append(f"{folder}/{room} stands in a circle of includes with its neighbours: {seen[room]}")
    return found


def main() -> int:
    root = pathlib.Path(sys.argv[1])
    wrong = []
    arrows = collections.defaultdict(lambda: collections.defaultdict(dict))
    single_nlopt = set()
    for folder, allowed in MAY_INCLUDE.items():
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in (".h", ".cc"):
                continue
            name = path.relative_to(root).as_posix()
            for number, line in enumerate(path.read_text().splitlines(), 1):
                opened = re.match(r"namespace (talus[\w:]*) \{", line)
                if opened and not (opened[1] + "::").startswith(namespace_of(name) + "::"):
                    wrong.append(f"{name}:{number}: its namespace is {namespace_of(name)}")
                if re.match(r"\s*#\s*pragma\s+omp", line) and name != "base/parallel_for.cc":
                    wrong.append(f"{name}:{number}: OpenMP, whose threads spin; see base/parallel_for.h")
                if re.search(r"\.dump\(", line) and not name.startswith("base/json/json_text"):
                    wrong.append(f"{name}:{number}: JSON is printed by base/json/json_text.h")
                found = INCLUDE.match(line)
                if not found:
                    continue
                target = found.group(1)
                first = target.split("/")[0]
                if first in MAY_INCLUDE and first not in allowed:
                    wrong.append(f"{name}:{number}: {folder} may not include {target}")
                if first == folder == "experiments" and upward(name, target):
                    wrong.append(f"{name}:{number}: {target} is not on a lower floor")
                if first == folder:
                    parent, own, other = rooms(name, target)
                    if own != other:
                        arrows[parent][own].setdefault(other, f"{name} includes {target}")
                for pattern, files in FENCES:
                    if re.match(pattern, target) and not re.search(files, name):
                        wrong.append(f"{name}:{number}: {target} outside its fence ({files})")
                if target.startswith("nlopt"):
                    single_nlopt.add(name)
    if len(single_nlopt) > 1:
        wrong.append(f"NLopt in more than one file: {sorted(single_nlopt)}")
    wrong += circles(arrows)
    print("\n".join(wrong) or "includes follow the arrows")
    return 1 if wrong else 0


sys.exit(main())
