#!/usr/bin/env python3
"""two_at_once_test.py TALUS SOURCE_DIR: a folder that one process works on is left to it by every other, which says so and
ends with status 1."""
import fcntl
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

from quick_campaign import PILE, quick_spec

TALUS = sys.argv[1]
SOURCE = pathlib.Path(sys.argv[2]).resolve()
PROBLEM = {"parameters": [{"name": "x", "low": 0, "high": 1}], "evaluations": 3}
ANSWER = ("sh", "-c", """cat >/dev/null; echo '{"value": 1}'""")


def talus(*arguments):
    return subprocess.run([TALUS, *arguments], capture_output=True, text=True)


class TwoAtOnce(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.out = self.folder / "out"

    def write_campaign(self):
        (self.folder / "deck").mkdir()
        (self.folder / "deck/run.sh").write_text(PILE)
        (self.folder / "quick.json").write_text(json.dumps(quick_spec(SOURCE, "quick", ["sh", "run.sh"])))
        return self.folder / "quick.json"

    def assert_left_alone(self, lock, commands):
        with open(lock) as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            for command in commands:
                done = talus(*command)
                self.assertEqual((done.returncode, done.stdout), (1, ""), command)
                self.assertIn("another process", done.stderr)
                self.assertIn(str(self.out), done.stderr)

    # Each may find the folder empty before the other has begun: the lock decides.
    def test_of_two_campaigns_one_begins(self):
        spec = self.write_campaign()
        both = [subprocess.Popen([TALUS, "calibrate", spec, "--out", self.out, "--quiet"],
                                 stderr=subprocess.PIPE, text=True) for _ in range(2)]
        said = [process.communicate(timeout=600)[1] for process in both]
        self.assertIn(sorted(process.returncode for process in both), ([0, 1], [0, 2]), said)
        self.assertRegex("".join(said), "holds a campaign already|another process")
        self.assertEqual(talus("resume", self.out, "--quiet").returncode, 0)
        exported = talus("export", self.out)
        self.assertEqual(exported.returncode, 0, exported.stderr)
        trials = json.loads((self.out / "export/trials.json").read_text())["trials"]
        self.assertEqual([trial["id"] for trial in trials], list(range(1, 4 + 2 + 1)))

    def test_a_campaign_that_runs_is_neither_resumed_nor_given_a_further_test(self):
        spec = self.write_campaign()
        self.assertEqual(talus("calibrate", spec, "--out", self.out, "--quiet").returncode, 0)
        further = self.folder / "further.json"
        further.write_text(json.dumps({"name": "plate", "mass_fallen": {"value": "21 mg", "sd": "2 mg"}}))
        self.assert_left_alone(self.out / "campaign.lock", [
            ("resume", self.out, "--quiet"), ("resume", self.out, "--add-simulations", "2", "--quiet"),
            ("add-experiment", self.out, further, "--quiet")])

    def test_a_search_that_runs_is_not_searched_by_another(self):
        problem = self.folder / "problem.json"
        problem.write_text(json.dumps(PROBLEM))
        command = ("optimize", problem, "--out", self.out, "--quiet", "--", *ANSWER)
        self.assertEqual(talus(*command).returncode, 0)
        self.assert_left_alone(self.out / "optimize.lock", [command])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
