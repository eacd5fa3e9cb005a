#!/usr/bin/env python3
"""check_headers.py SOURCE_DIR: a header includes, itself or through its own includes, what it names of the
standard library and of other folders. Files that are compiled together hide it where one does not; the builds
that compile each alone then fail."""
import pathlib
import re
import sys

FOLDERS = ("base", "engine", "imaging", "surrogate", "optimizer", "experiments", "python")
HEADERS = {"function": "functional", "pair": "utility", "shared_ptr": "memory", "unique_ptr": "memory"}
HEADERS |= {name: name for name in (
    "array", "atomic", "chrono", "filesystem", "map", "mutex", "optional", "set", "span", "string", "string_view",
    "tuple", "unordered_map", "unordered_set", "variant", "vector")}
NAMESPACES = {name: f"{name}/" for name in FOLDERS if name not in ("experiments", "python")}
NAMESPACES |= {floor: f"experiments/{floor}/"
               for floor in ("rigs", "runners", "journal", "trials", "campaign", "analysis")}


def reached(name: str, includes: dict) -> set:
    """All that `name` includes, itself or through headers of the project."""
    seen, waiting = set(), [name]
    while waiting:
        for target in includes.get(waiting.pop(), []):
            if target not in seen:
                seen.add(target)
                waiting.append(target)
    return seen


def main() -> int:
    root = pathlib.Path(sys.argv[1])
    texts = {path.relative_to(root).as_posix(): re.sub(r"//.*", "", path.read_text())
             for folder in FOLDERS for path in (root / folder).rglob("*.h")}
    includes = {name: re.findall(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', text, re.M) for name, text in texts.items()}
    wrong = []
    for name, text in sorted(texts.items()):
        known = reached(name, includes)
        for used in sorted(set(re.findall(r"\bstd::(\w+)", text)) & HEADERS.keys()):
            if HEADERS[used] not in known:
                wrong.append(f"{name}: std::{used} without <{HEADERS[used]}>")
        for used in sorted(set(re.findall(r"(?<![\w:])(\w+)::", text)) & NAMESPACES.keys()):
            if not any(target.startswith(NAMESPACES[used]) for target in known | {name}):
                wrong.append(f"{name}: {used}:: without a header of {NAMESPACES[used]}")
    print("\n".join(wrong) or f"{len(texts)} headers include what they name")
    return 1 if wrong else 0


sys.exit(main())
