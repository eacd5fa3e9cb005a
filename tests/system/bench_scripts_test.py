#!/usr/bin/env python3
"""bench_scripts_test.py SOURCE_DIR: every script of bench/ finds what it imports. None of them does its work here."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

BENCH = pathlib.Path(sys.argv[1]) / "bench"


def is_python(path):
    if not path.is_file():
        return False
    with open(path, "rb") as file:
        first = file.readline()
    return first.startswith(b"#!") and b"python3" in first


class BenchScripts(unittest.TestCase):
    def test_each_finds_what_it_imports(self):
        scripts = sorted(filter(is_python, BENCH.rglob("*")))
        self.assertGreater(len(scripts), 25)
        with tempfile.TemporaryDirectory() as folder:
            for script in scripts:
                with self.subTest(script=str(script.relative_to(BENCH))):
                    # Those that take no flags fail with it: by then they have imported all.
                    told = subprocess.run([sys.executable, "-B", script, "--help"], cwd=folder, capture_output=True,
                                          text=True, timeout=100).stderr
                    self.assertNotRegex(told, r"(Import|ModuleNotFound|Name|Syntax)Error")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
