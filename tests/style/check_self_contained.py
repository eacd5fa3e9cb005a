#!/usr/bin/env python3
"""check_self_contained.py SOURCE_DIR: a file includes, itself or through what it includes, what it names of the standard
library, of other folders, and of its own. Files that are compiled together hide it where one does not; the builds
that compile each alone then fail."""
import collections
import pathlib
import re
import sys

LIBRARIES = ("base", "engine", "imaging", "surrogate", "optimizer")
FOLDERS = (*LIBRARIES, "experiments", "python", "tests", "bench")
HEADERS = {"function": "functional", "pair": "utility", "shared_ptr": "memory", "unique_ptr": "memory"}
HEADERS |= {name: name for name in (
    "array", "atomic", "chrono", "filesystem", "map", "mutex", "optional", "set", "span", "string", "string_view",
    "tuple", "unordered_map", "unordered_set", "variant", "vector")}
NAMESPACES = {name: f"{name}/" for name in LIBRARIES}
NAMESPACES |= {floor: f"experiments/{floor}/"
               for floor in ("rigs", "runners", "journal", "trials", "campaign", "analysis")}
# Their headers are parts of one another, made for a width of vectors that the including file sets.
IN_PARTS = ("engine/kernel/", "engine/laws/")
# A constant, a class or a function that a header declares outside of any class.
DECLARED = re.compile(
    r"^(?:inline constexpr [\w:<>, ]+? (k[A-Z]\w+)\b|(?:struct|class|enum class) ([A-Z]\w+)\b(?!;)"
    r"|(?! |using|return|namespace|template|static|typedef|#)[\w:<>,&*\[\] ]+?[ &*]([A-Z]\w*[a-z]\w*)\()", re.M)


def namespace_of(name: str, text: str) -> str:
    """A test is in the namespace of what it tests."""
    parts = name.split("/")
    own = re.search(r"^namespace talus::(\w+)", text, re.M)
    if own and parts[0] in ("tests", "bench"):
        return own[1]
    return parts[1] if parts[0] == "experiments" else parts[0]


def without_texts(source: str) -> str:
    """Nor with the names of tests, which are no others'."""
    source = re.sub(r'//.*|R"\((.|\n)*?\)"', "", source)
    return re.sub(r'"(\\.|[^"\\\n])*"', '""', re.sub(r"\bTEST(_[FP])?\(\w+, \w+\)", "", source))


def declares(text: str, name: str) -> bool:
    """Whether a file itself has a type, a function, a constant or an enumerator of this name."""
    return re.search(rf"(?:struct|class|using|typename) {name}\b|^[\w:<>,&*\[\] ]+?[ &*]{name}\("
                     rf"|constexpr [\w:<>, ]+? {name}\b|^\s*{name},?\s*$", text, re.M) is not None


class Tree:
    def __init__(self, root: pathlib.Path):
        sources = {path.relative_to(root).as_posix(): path.read_text()
                   for folder in FOLDERS for path in (root / folder).rglob("*.*") if path.suffix in (".h", ".cc")}
        self.texts = {name: without_texts(source) for name, source in sources.items()}
        self.words = {name: set(re.findall(r"\w+", text)) for name, text in self.texts.items()}
        self.includes = {name: re.findall(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', source, re.M)
                         for name, source in sources.items()}
        declared = collections.defaultdict(set)
        for name, text in self.texts.items():
            if name.endswith(".h"):
                for found in DECLARED.finditer(text):
                    declared[next(filter(None, found.groups()))].add(name)
        self.namespace = {name: namespace_of(name, text) for name, text in self.texts.items()}
        self.home = {word: next(iter(names)) for word, names in declared.items() if len(names) == 1}

    def reached(self, name: str) -> set:
        """All that `name` includes, itself or through files of the project."""
        seen, waiting = set(), [name]
        while waiting:
            for target in self.includes.get(waiting.pop(), []):
                if target not in seen:
                    seen.add(target)
                    waiting.append(target)
        return seen

    def wrong_in(self, name: str):
        text, known = self.texts[name], self.reached(name)
        for used in sorted(set(re.findall(r"\bstd::(\w+)", text)) & HEADERS.keys()):
            if HEADERS[used] not in known:
                yield f"{name}: std::{used} without <{HEADERS[used]}>"
        for used in sorted(set(re.findall(r"(?<![\w:])(\w+)::", text)) & NAMESPACES.keys()):
            if not any(target.startswith(NAMESPACES[used]) for target in known | {name}):
                yield f"{name}: {used}:: without a header of {NAMESPACES[used]}"
        if name.startswith(IN_PARTS):
            return
        said = set().union(*(self.words.get(target, set()) for target in known))
        for space, used in sorted(set(re.findall(r"(?<![\w.>:])(?:(\w+)::)?([A-Za-z]\w+)\b", text))):
            home = self.home.get(used)
            if home is None or home in known or home == name or used in said:
                continue
            if (space or self.namespace[name]) == self.namespace[home] and (space or not declares(text, used)):
                yield f"{name}: {used} without {home}"


def main() -> int:
    tree = Tree(pathlib.Path(sys.argv[1]))
    wrong = [line for name in sorted(tree.texts) for line in tree.wrong_in(name)]
    print("\n".join(wrong) or f"{len(tree.texts)} files include what they name")
    return 1 if wrong else 0


sys.exit(main())
