#!/usr/bin/env python3
"""one_error_test.py TALUS SOURCE_DIR: a value that cannot be read is one error. What depends on it would only speak of
the default that stands in its place."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

TALUS = sys.argv[1]
SOURCE = pathlib.Path(sys.argv[2])


def example(name):
    text = (SOURCE / "examples" / name).read_text()
    return json.loads(re.sub(r'("(?:[^"\\]|\\.)*")|//[^\n]*', lambda m: m[1] or "", text))


def quantities(value, steps=()):
    """The place of every value with a unit, as the steps to it."""
    if isinstance(value, str) and re.match(r"[\d.]+ [a-zA-Z]", value):
        yield steps
    for key, inner in value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ():
        yield from quantities(inner, steps + (key,))


def with_value(root, steps, value):
    root = json.loads(json.dumps(root))
    at = root
    for step in steps[:-1]:
        at = at[step]
    at[steps[-1]] = value
    return root


class OneError(unittest.TestCase):
    def check(self, good, verb, least):
        places = list(quantities(good))
        self.assertGreaterEqual(len(places), least)
        faults = []
        with tempfile.TemporaryDirectory() as name:
            path = pathlib.Path(name) / "spec.json"
            for steps in places:
                for bad in ("12 parsec", "1,5 mm", "much", [1]):
                    path.write_text(json.dumps(with_value(good, steps, bad), indent=1))
                    done = subprocess.run([TALUS, *verb, path], capture_output=True, text=True, cwd=name)
                    where = re.sub(r"\.(\d+)", r"[\1]", ".".join(map(str, steps)))
                    lines = done.stderr.strip().splitlines()
                    if done.returncode != 2 or len(lines) != 1 or where + ":" not in lines[0]:
                        faults.append(f"{where} = {bad!r}: {done.returncode}\n{done.stderr}")
        self.assertEqual(faults, [], "\n".join(faults))

    def test_of_a_campaign_with_one_test(self):
        good = example("demo/campaign.json")
        good["experiment"]["photos"] = str(SOURCE / "examples/photos/powder_a")
        self.check(good, ["validate", "--without-experiment"], 11)

    def test_of_a_campaign_with_two_tests_and_masses_of_their_own(self):
        good = example("demo/two_tests.json")
        for experiment in good["experiments"]:
            experiment["photos"] = str(SOURCE / "examples/photos/powder_a")
            experiment["mass"] = "1.602 g"
        del good["powder"]["mass"]
        self.check(good, ["validate", "--without-experiment"], 18)

    def test_of_a_case(self):
        self.check(example("scenes/heap_case.json"), ["simulate", "--out", "new"], 8)


unittest.main(argv=sys.argv[:1])
