#!/usr/bin/env python3
"""bench_scripts_test.py SOURCE_DIR: every script of bench/ finds what it imports and says what it takes. None of them does its
work here."""
import os
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
    def test_each_is_a_program_that_helps(self):
        scripts = sorted(filter(is_python, BENCH.rglob("*")))
        self.assertGreater(len(scripts), 25)
        with tempfile.TemporaryDirectory() as folder:
            for script in scripts:
                with self.subTest(script=str(script.relative_to(BENCH))):
                    ended = subprocess.run([sys.executable, "-B", script, "--help"], cwd=folder, capture_output=True,
                                           text=True, timeout=100)
                    self.assertEqual((ended.returncode, ended.stderr), (0, ""))
                    self.assertIn(script.name, ended.stdout)
                    self.assertTrue(os.access(script, os.X_OK), "is not executable: chmod +x")
                    # numpy is a package of Debian's, which another python3 on the path does not see.
                    self.assertEqual(script.read_text().splitlines()[0], "#!/usr/bin/python3")
            self.assertEqual(os.listdir(folder), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
