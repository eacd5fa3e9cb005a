#!/usr/bin/env python3
"""foreign_campaign_test.py TALUS SOURCE_DIR: campaigns of a deck of one's own, a shell script that draws a cone: what
they say of a deck that is wrong, how it is mended, and what is left of our own engine's words and conventions."""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

TALUS = sys.argv[1]
SOURCE = pathlib.Path(sys.argv[2]).resolve()
CONE = """awk -v mu={{ sliding_friction }} -v mr={{ rolling_friction }} 'BEGIN {
  print "x,y,z,r"
  for (x = -4; x <= 4; ++x) for (y = -4; y <= 4; ++y) if (x * x + y * y <= 16)
    for (z = 0.5; z <= 1 + (4 - sqrt(x * x + y * y)) * (0.4 + mu + 0.3 * mr); ++z)
      print x * 1e-3 "," y * 1e-3 "," z * 1e-3 ",5.1e-4"
}' >heap.csv
"""
FAILS = "# {{ sliding_friction }} {{ rolling_friction }}\necho 'seed {{ seed }}'; echo 'ERROR: lost atoms'; exit 3\n"
NUMBERS = ("echo \"tapped_density_kg_per_m3,$(awk 'BEGIN {print 1400 + 100 * {{ sliding_friction }} + "
           "50 * {{ rolling_friction }}}')\" >scalars.csv\n")
HEAP = {"photos": str(SOURCE / "examples/photos/powder_a"), "pattern": "run01_view{view}.jpg",
        "plate_diameter": "10 mm", "pixel_size": "100 um"}
TAPPED = {"name": "taps", "rig": {"kind": "tapped_density", "diameter": "10 mm"},
          "tapped_density": {"value": "1450 kg/m^3", "sd": "5 kg/m^3"}}


class ForeignCampaign(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp(prefix="talus foreign "))  # a blank, as users' folders have
        self.addCleanup(shutil.rmtree, self.root)

    def write(self, deck, name="a", experiment=None, **more):
        folder = self.root / name
        (folder / "deck").mkdir(parents=True, exist_ok=True)
        (folder / "deck/run.sh").write_text(deck)
        spec = {"engine": {"kind": "command", "templates": "deck", "command": ["sh", "run.sh"], "result": "heap.csv"},
                "experiment": HEAP, "device": {"plate": "disc"},
                "powder": {"material": {"density": 2500}, "sizes": {"kind": "mono", "diameter": "1 mm"}, "mass": "0.3 g"},
                "parameters": {"sliding_friction": {"min": 0.1, "max": 0.9},
                               "rolling_friction": {"min": 0.02, "max": 0.6}},
                "budget": {"simulations": 16}, "confirm": {"candidates": 1, "replicates": 1}, "workers": 1} | more
        if experiment:
            del spec["experiment"]
            spec |= {"experiments": [experiment], "filling": {"kind": "pour"}}
            del spec["device"]
        (folder / "campaign.json").write_text(json.dumps(spec))
        return folder

    def talus(self, *arguments, status=0):
        done = subprocess.run([TALUS, *map(str, arguments)], capture_output=True, text=True)
        self.assertEqual(done.returncode, status, done.stdout[-3000:] + done.stderr[-3000:])
        return done.stdout + done.stderr

    def calibrate(self, folder, *more, status=0):
        return self.talus("calibrate", folder / "campaign.json", "--out", folder / "run", *more, status=status)

    def test_a_wrong_deck_is_told_and_mended(self):
        folder = self.write(FAILS)
        self.calibrate(folder, status=1)
        said = self.talus("status", folder / "run")
        self.assertIn("ended without a result; mend the cause, and `talus resume", said)
        self.assertIn("    8 × exit status 3: seed ", said)
        self.assertIn("\n        ERROR: lost atoms (the numbers differ)\n", said)
        self.assertNotIn("time left", said)
        self.write(CONE)
        self.talus("resume", folder / "run")
        said = self.talus("status", folder / "run")
        self.assertIn("failed            0\n", said)
        # From now on something is known by this deck.
        (folder / "deck/run.sh").write_text(CONE + "true\n")
        said = self.talus("resume", folder / "run", "--add-simulations", 1, status=2)
        self.assertIn("are not those that", said)
        self.assertIn("trials of the campaign succeeded with", said)

    def test_a_deck_of_which_few_trials_have_failed_is_mended_too(self):
        folder = self.write(FAILS, budget={"simulations": 3})
        self.calibrate(folder, status=1)
        spec = json.loads((folder / "campaign.json").read_text())
        spec["engine"]["result"] = "cone.csv"
        (folder / "campaign.json").write_text(json.dumps(spec | {"budget": {"simulations": 16}}))
        (folder / "deck/run.sh").write_text(CONE.replace("heap.csv", "cone.csv"))
        said = self.talus("resume", folder / "run")
        self.assertIn("run again", said)
        self.assertIn("failed            0\n", self.talus("status", folder / "run"))

    def test_a_deck_whose_numbers_have_no_value_is_mended_too(self):
        empty = '# {{ sliding_friction }} {{ rolling_friction }}\necho "tapped_density_kg_per_m3," >scalars.csv\n'
        folder = self.write(empty, experiment=TAPPED)
        self.calibrate(folder, status=1)
        self.assertIn('none of the first 8 trials defines "tapped_density_kg_per_m3"', self.talus("status", folder / "run"))
        self.write(NUMBERS, experiment=TAPPED)
        self.assertIn("told nothing: run again", self.talus("resume", folder / "run"))
        self.assertTrue((folder / "run/result.json").exists())

    def test_card_and_answer_are_of_the_deck(self):
        folder = self.write(CONE)
        said = self.calibrate(folder)
        self.assertIn('the deck of "sh run.sh" and its laws', said)
        self.assertNotIn("epsd", said)
        recommended = {p["name"]: p["value"] for p in json.loads((folder / "run/result.json").read_text())["parameters"]}
        card = self.talus("card", folder / "run", "--format", "lammps")
        self.assertIn("nothing is converted", card)
        self.assertNotIn("pair_coeff", card)
        placeholders = json.loads(self.talus("card", folder / "run", "--format", "json"))["placeholders"]
        self.assertEqual({name: float(value) for name, value in placeholders.items()}, recommended)
        self.assertIn("Grains", self.talus("card", self.own_case()))  # of our own engine as before
        listed = self.talus("next", folder / "run", "--simulate")
        self.assertIn("the engine's templates have no ", listed)
        self.assertFalse(list((folder / "run/next").glob("*/trials")), listed)
        self.moved(folder)

    def own_case(self):
        path = self.root / "own.json"
        path.write_text(json.dumps({"powder": {"material": {"density": 2500}, "mass": "0.3 g",
                                               "sizes": {"kind": "mono", "diameter": "1 mm"}}}))
        return path

    def moved(self, folder):
        (self.root / "b").mkdir()
        folder.rename(self.root / "b/a")
        case = self.root / "b/a/run/trials/0001/case.json"
        self.assertIn("is done", self.talus("simulate", case, "--out", self.root / "again"))

    def test_trials_of_another_engine_are_not_reused(self):
        folder = self.write(CONE)
        self.calibrate(folder)
        spec = json.loads((folder / "campaign.json").read_text())
        del spec["engine"]
        (folder / "own.json").write_text(json.dumps(spec))
        said = self.talus("calibrate", folder / "own.json", "--out", folder / "own", "--reuse", folder / "run", status=2)
        self.assertIn('it was run by another engine, "sh run.sh"', said)
        said = self.talus("compare", folder / "run", folder / "run/.", status=2)
        self.assertIn("is named twice", said)

    def test_numbers_only(self):
        folder = self.write(NUMBERS.replace("scalars", "numbers"), experiment=TAPPED)
        self.calibrate(folder, status=1)
        said = self.talus("status", folder / "run")
        self.assertIn("left neither scalars.json nor scalars.csv", said)
        (folder / "deck/run.sh").write_text(NUMBERS.replace("tapped_", "taped_"))
        said = self.talus("resume", folder / "run", status=1)
        self.assertIn('leaves no "tapped_density_kg_per_m3"', said)
        said = self.talus("status", folder / "run")
        self.assertIn("because           an error ended it: trial ", said)
        self.assertIn("an error ended it: trial ", (folder / "run/campaign.log").read_text())
        (folder / "deck/run.sh").write_text(NUMBERS)
        self.talus("resume", folder / "run")
        before = len(list((folder / "run/trials").iterdir()))
        said = self.talus("compare", folder / "run", "--objective", "sad", status=2)
        self.assertIn("--objective: is of an image", said)
        self.assertEqual(len(list((folder / "run/trials").iterdir())), before)

    def test_validate_names_the_engine_and_what_it_may_take(self):
        folder = self.write(CONE, trial_time_cap="90 s", runner={"kind": "slurm"})
        said = self.talus("validate", folder / "campaign.json")
        self.assertIn("engine            sh run.sh, templates in ", said)
        self.assertIn("16 simulations", said)
        self.assertIn("is 2 min on Slurm", said)

    def test_grains_that_are_not_the_specs(self):
        folder = self.write(CONE.replace("5.1e-4", "1e-3"))
        said = self.calibrate(folder)
        self.assertEqual(said.count("the median by volume"), 1, said)
        slip = self.write(CONE.replace("5.1e-4", "5e-5"), "slip")
        self.assertIn("is engine.length_unit right", self.calibrate(slip, status=1))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
