#!/usr/bin/python3
"""newcomer_test.py TALUS SOURCE_DIR TUBE_AND_DRUM: what somebody reads who sees the program for the first time. A miss is said wherever an
answer is; a campaign that leaves more than a point looks into further tests by itself; words and units are those of the bench. TUBE_AND_DRUM: what tube_and_drum.py has made."""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from quick_campaign import PILE, quick_spec

TALUS = sys.argv[1]
SOURCE = pathlib.Path(sys.argv[2]).resolve()
MADE = pathlib.Path(sys.argv[3])


def run(*arguments):
    ended = subprocess.run([TALUS, *map(str, arguments)], capture_output=True, text=True)
    assert ended.returncode == 0, (arguments, ended.stdout, ended.stderr)
    return ended.stdout


class Miss(unittest.TestCase):
    # One run has no noise floor: its share of the powder's area decides.
    def test_a_miss_is_said_on_terminal_result_card_and_page(self):
        with tempfile.TemporaryDirectory(prefix="talus_miss_") as scratch:
            folder = pathlib.Path(scratch)
            (folder / "deck").mkdir()
            (folder / "deck/run.sh").write_text(PILE)
            (folder / "deck/run.sh").chmod(0o755)
            # With one worker every run makes the same trials.
            spec = quick_spec(SOURCE, "pile", ["./run.sh"], budget={"simulations": 14}, workers=1)
            (folder / "pile.json").write_text(json.dumps(spec))
            terminal = run("calibrate", folder / "pile.json", "--out", folder / "run")
            self.assertRegex(terminal, r"verdict +The recommended set misses a measurement")
            self.assertRegex(terminal, r'warning: the recommended set misses the shape of "heap" by \d+ % of the powder\'s area')
            warnings = json.loads((folder / "run/result.json").read_text())["warnings"]
            self.assertEqual(warnings[0]["kind"], "misses")
            self.assertGreater(warnings[0]["share"], 0.1)
            self.assertEqual(warnings[-1]["kind"], "few_grains")  # the gravest first
            self.assertIn('Warning: the recommended set misses the shape of "heap"', run("card", folder / "run"))
            run("report", folder / "run")
            page = (folder / "run/report/report.html").read_text()
            data = json.loads(page.split('id="data">')[1].split("</script>")[0])
            self.assertIn('misses the shape of "heap"', data["warnings"][0])
            self.assertFalse(data["headline"]["fits"])
            self.assertIn("misses the shape", (folder / "run/report/summary.html").read_text())


class TubeAndDrum(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="talus_newcomer_")
        folder = pathlib.Path(cls.temporary.name)
        shutil.copytree(MADE, folder / "campaign")
        cls.terminal = (MADE / "terminal.txt").read_text()
        cls.out = folder / "campaign/run"
        cls.result = json.loads((cls.out / "result.json").read_text())

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_trial_lines_name_parameters_and_what_the_test_gives(self):
        self.assertRegex(self.terminal, r"trial \d+ \(design\) at sliding_friction [\d.]+, rolling_friction [\d.]+, mixer at "
                                        r"scale factor 1: angle [\d.]+°, ")
        self.assertRegex(self.terminal, r"heap at scale factor 1: [\d.]+ mm², mass fallen [\d.]+ mg, ")
        self.assertNotIn("not defined", self.terminal)

    # Without being asked, within the share of the core time that the spec allows.
    def test_a_campaign_that_leaves_a_curve_looks_into_further_tests(self):
        self.assertIn(self.result["verdict"]["kind"], ("curve", "region"))
        self.assertRegex(self.terminal, r"looks into further tests for at most \d+ s of core time in all \(the spec's next\.share\)")
        self.assertIn(f"`talus next {MADE / 'run'}` lists all", self.terminal)
        self.assertRegex(self.terminal, r"further tests +\S.*: expected to leave sliding_friction 0\.\d+, rolling_friction")
        table = json.loads((self.out / "next/next.json").read_text())
        tests = [c for c in table["candidates"] if c["kind"] == "test" and c["remaining"] is not None]
        self.assertTrue(tests)
        told = re.findall(r"(?:further tests)? {5,}(\S.*): expected to leave", self.terminal)
        self.assertEqual(told, [c["name"] for c in tests[:3]])

    # The figure is the mean heap's, which the model predicts: single runs lie farther off and are told as such only.
    def test_the_confirmed_figure_is_the_same_everywhere(self):
        confirmed = self.result["confirmed"][0]["experiments"][0]["mean_profile_sad_mm2"]
        self.assertIn(f", confirmed {confirmed:.4g} mm²", self.terminal)
        run("report", self.out)
        page = (self.out / "report/report.html").read_text()
        data = json.loads(page.split('id="data">')[1].split("</script>")[0])
        self.assertTrue(data["headline"]["fit"][0]["simulated"].startswith(f"{confirmed:.3g} mm² SAD as the mean of"))

    def test_words_and_numbers_are_those_of_the_bench(self):
        for text in (self.terminal, run("validate", self.out.parent / "spec.json"), run("status", self.out), run("next", self.out), run("card", self.out)):
            self.assertNotRegex(text, r"\dmg|_kg [-\d]|[-−]\d[\d.]* ?mg|\de-\d\d ?(kg|m)\b")
        answer = self.terminal[self.terminal.index("recommended set"):]
        self.assertRegex(answer, r"mixer, drum: diameter 16 mm, width 5 mm, speed 60 rpm")
        self.assertNotRegex(answer, r"mixer, [^\n]*(lift|plate)")
        self.assertLessEqual(len(re.findall(r"the budget of \d+ simulations", answer)), 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
