#!/usr/bin/env python3
"""hard_limits_test.py TALUS SOURCE_DIR: output that cannot be written, files that may not grow, and searches in which
nothing succeeds end with status 1 and words, never with 0 and never by a signal."""
import json
import pathlib
import resource
import subprocess
import sys
import tempfile
import unittest

from quick_campaign import PILE, quick_spec

TALUS = sys.argv[1]
SOURCE = pathlib.Path(sys.argv[2]).resolve()
PROBLEM = SOURCE / "examples/optimize/bowl.json"
CASE = SOURCE / "examples/scenes/bouncing_pair.json"


def optimize(command, evaluations=6):
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump({"parameters": [{"name": "x", "low": 0, "high": 1}], "evaluations": evaluations}, file)
        file.flush()
        return subprocess.run([TALUS, "optimize", file.name, "--", "sh", "-c", command],
                              capture_output=True, text=True)


class HardLimits(unittest.TestCase):
    def assert_not_taken(self, commands):
        for arguments in commands:
            with open("/dev/full", "w") as full:
                done = subprocess.run([TALUS, *arguments], stdout=full, stderr=subprocess.PIPE, text=True)
            self.assertEqual(done.returncode, 1, arguments)
            self.assertIn("standard output cannot be written", done.stderr)

    def test_an_answer_that_a_full_device_does_not_take_is_a_failure(self):
        self.assert_not_taken((["--version"], ["help", "card"],
                               ["validate", SOURCE / "examples/demo/two_tests.json"]))

    def test_so_is_what_a_campaign_says(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "deck").mkdir()
            (root / "deck/run.sh").write_text(PILE)
            (root / "quick.json").write_text(json.dumps(
                quick_spec(SOURCE, "quick", ["sh", "run.sh"], budget={"simulations": 8})))
            done = subprocess.run([TALUS, "calibrate", root / "quick.json", "--out", root / "out", "--quiet"],
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assert_not_taken((["status", root / "out"], ["card", root / "out"], ["next", root / "out"],
                                   ["consider", root / "out", "sliding_friction=0.5"]))

    def test_a_reader_that_has_gone_is_no_failure(self):
        process = subprocess.Popen([TALUS, "help", "card"], stdout=subprocess.PIPE)
        process.stdout.close()
        self.assertEqual(process.wait(), 0)

    def test_a_file_that_may_not_grow_is_told_of(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([TALUS, "simulate", CASE, "--out", pathlib.Path(folder) / "run"],
                                  capture_output=True, text=True,
                                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (64, 64)))
        self.assertEqual(done.returncode, 1)
        self.assertIn("File too large", done.stderr)

    def test_a_search_in_which_all_failed_recommends_nothing(self):
        done = optimize("exit 3")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("the first 6 evaluations have all failed, the last: exit status 3", done.stderr)

    def test_values_that_no_search_can_work_with_are_failures(self):
        for value in ("1e308", "-1e308", "2e100"):
            done = optimize(f"""echo '{{"value": {value}}}'""", evaluations=9)
            self.assertEqual(done.returncode, 1, value)
            self.assertIn("beyond 1e100", done.stderr)

    def test_the_largest_value_is_worked_with(self):
        done = optimize("""case $(cat) in *:0.[0-4]*) echo '{"value": 1e100}' ;; *) echo '{"value": -1e100}' ;; esac""")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreaterEqual(json.loads(done.stdout)["recommended"]["x"], 0.5)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
