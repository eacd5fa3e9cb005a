#!/usr/bin/env python3
"""command_line_test.py TALUS SOURCE_DIR: help, misspelt words, man pages, completion, readers that go away, and progress
for scripts."""
import functools
import json
import os
import pathlib
import pty
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from commented_json import read_json
from quick_campaign import PILE, quick_spec

TALUS = sys.argv[1]
SOURCE = pathlib.Path(sys.argv[2]).resolve()


def write_campaign(folder):
    deck = folder / "deck"
    deck.mkdir()
    (deck / "run.sh").write_text(PILE)
    (deck / "run.sh").chmod(0o755)
    spec = quick_spec(SOURCE, "quick", ["./run.sh"])
    (folder / "quick.json").write_text(json.dumps(spec))
    return folder / "quick.json"


def talus(*arguments):
    return subprocess.run([TALUS, *arguments], capture_output=True, text=True)


@functools.cache
def verbs():
    script = talus("completion", "bash").stdout
    line = next(line for line in script.splitlines() if "compgen -W 'init" in line)
    return [word for word in line.split("'")[1].split() if not word.startswith("-")]


class CommandLine(unittest.TestCase):
    def test_help_of_a_verb_is_what_the_verb_itself_says(self):
        self.assertGreater(len(verbs()), 10)
        for verb in verbs():
            helped, itself = talus("help", verb), talus(verb, "--help")
            self.assertEqual(helped.returncode, 0, verb)
            self.assertEqual(helped.stdout, itself.stdout)
            self.assertIn("Usage: talus " + verb, helped.stdout)
            # Options that take several words would take what stands behind them.
            self.assertNotRegex(helped.stdout, r"\[OPTIONS\] \S")

    def test_help_without_a_verb_lists_all(self):
        helped = talus("help")
        self.assertEqual((helped.returncode, helped.stdout), (0, talus("--help").stdout))
        for verb in verbs():
            self.assertIn(f"\n  {verb} ", helped.stdout)

    def test_a_misspelt_verb_or_flag_is_met_with_the_nearest(self):
        for arguments, meant in [(["calibrte", "x.json"], "calibrate"), (["help", "mesure"], "measure"),
                                 (["measure", "x", "--treshold=0.5"], "--threshold"),
                                 (["resume", "x", "--ad-simulations", "3"], "--add-simulations")]:
            done = talus(*arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(f'did you mean "{meant}"?', done.stderr)
        self.assertNotIn("did you mean", talus("qqqqqqqq").stderr)

    def test_init_refuses_a_name_that_no_spec_can_hold(self):
        with tempfile.TemporaryDirectory() as folder:
            photos = os.fsencode(folder) + b"/m\xfcll"
            os.mkdir(photos)
            shutil.copy(SOURCE / "examples/photos/powder_a/run01_view00.jpg", photos + b"/run01_view00.jpg")
            done = talus("init", photos, "--out", f"{folder}/spec.json", "--plate-diameter", "10mm", "--tube-diameter",
                         "10mm", "--lift-velocity", "1mm/s", "--mass", "1g", "--density", "4g/cm^3", "--grain-diameter",
                         "0.4mm")
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn("is not UTF-8", done.stderr)
            self.assertFalse(os.path.exists(f"{folder}/spec.json"))

    def test_every_man_page_is_set_without_a_warning(self):
        for arguments in [[]] + [[verb] for verb in verbs()]:
            page = talus("man", *arguments)
            self.assertEqual(page.returncode, 0)
            set_page = subprocess.run(["groff", "-man", "-ww", "-Tutf8", "-K", "utf8"], input=page.stdout,
                                      capture_output=True, text=True)
            self.assertEqual((set_page.returncode, set_page.stderr), (0, ""), arguments)
            self.assertIn("talus", set_page.stdout)

    def complete(self, *words):
        script = ('source <("$0" completion bash); COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); '
                  '_talus; echo "${COMPREPLY[@]}"')
        done = subprocess.run(["bash", "-c", script, TALUS, *words], capture_output=True, text=True)
        self.assertEqual(done.stderr, "")
        return done.stdout.split()

    def test_bash_completes_verbs_flags_and_the_words_they_take(self):
        self.assertEqual(self.complete("talus", "cal"), ["calibrate"])
        self.assertIn("--plate-diameter", self.complete("talus", "measure", "--p"))
        self.assertEqual(self.complete("talus", "measure", "x", "--powder", "br"), ["bright"])
        self.assertEqual(self.complete("talus", "help", "sta"), ["status"])
        self.assertEqual(self.complete("talus", "completion", ""), ["bash", "zsh", "fish"])

    def test_the_other_shells_can_read_their_scripts(self):
        for shell in ("zsh", "fish"):
            script = talus("completion", shell).stdout
            self.assertIn("--powder" if shell == "zsh" else "-l powder", script)
            if shutil.which(shell):
                done = subprocess.run([shell, "-n"], input=script, capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stderr), (0, ""), shell)

    def test_a_reader_that_has_gone_is_no_reason_to_die(self):
        reader, writer = os.pipe()
        os.close(reader)
        done = subprocess.run([TALUS, "help"], stdout=writer, restore_signals=True)
        os.close(writer)
        self.assertEqual(done.returncode, 0)


class Progress(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.spec = write_campaign(self.folder)

    def test_json_is_one_event_a_line_and_ends_with_the_result(self):
        done = talus("calibrate", str(self.spec), "--out", str(self.folder / "out"), "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        events = [json.loads(line) for line in done.stdout.splitlines()]
        trials = [event for event in events if event["event"] == "trial"]
        self.assertEqual(len(trials), 4 + 2)  # simulations and confirming ones
        for trial in trials:
            self.assertEqual((trial["status"], trial["unit"]), ("ok", "mm²"))
            self.assertGreater(trial["objective"], 0)
        self.assertTrue(trials[0]["best"])
        budgets = {event["budget"] for event in events if event["event"] == "progress"}
        self.assertEqual(budgets, {4})
        self.assertEqual(events[-1]["event"], "result")
        self.assertEqual(events[-1]["result"],
                         json.loads((self.folder / "out/result.json").read_text()))

    def test_quiet_says_nothing_and_does_the_same(self):
        done = talus("calibrate", str(self.spec), "--out", str(self.folder / "out"), "--quiet")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        self.assertTrue((self.folder / "out/result.json").exists())
        card = json.loads(talus("card", str(self.folder / "out"), "--format", "json").stdout)
        result = json.loads((self.folder / "out/result.json").read_text())
        value = result["parameters"][0]["value"]
        self.assertEqual(card["parameters"][0]["value"], value)
        self.assertEqual(float(card["placeholders"]["sliding_friction"]), value)  # of another engine's deck
        self.assertEqual(float(card["given_with_them"]["scale_factor"]), result["conditions"]["scale_factor"])
        both = talus("resume", str(self.folder / "out"), "--quiet", "--json")
        self.assertEqual(both.returncode, 2)

    def test_a_project_that_is_moved_goes_on_with_its_templates(self):
        home = self.folder / "one"
        home.mkdir()
        self.spec = write_campaign(home)
        self.assertEqual(talus("calibrate", str(self.spec), "--out", str(home / "out"), "--quiet").returncode, 0)
        for place, more in (("two", ()), ("three/four", ("--add-simulations", "1"))):
            moved = self.folder / place
            moved.parent.mkdir(exist_ok=True)
            home = home.rename(moved)
            done = talus("resume", str(home / "out"), *more)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual("it has ended" in done.stderr, not more, done.stderr)  # moving searches no further

    def test_the_cost_is_known_before_the_photographs_are_taken(self):
        spec = json.loads(self.spec.read_text())
        spec["experiment"]["photos"] = str(self.folder / "not taken yet")
        self.spec.write_text(json.dumps(spec))
        done = talus("validate", str(self.spec))
        self.assertEqual(done.returncode, 2)
        self.assertIn("not taken yet", done.stderr)
        self.assertIn("--without-experiment", done.stderr)
        done = talus("validate", str(self.spec), "--without-experiment")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("sliding_friction in 0.1 … 0.9", done.stdout)

    # The alarm of the result is of the finest grains, too: coarser ones guide the search only.
    def test_few_grains_are_a_warning_at_the_finest_scale_factor_only(self):
        done = talus("validate", str(SOURCE / "examples/demo/campaign.json"), "--without-experiment")
        grains = [line for line in done.stdout.splitlines() if "grains across the plate" in line]
        self.assertEqual(len(grains), 1, done.stdout)
        self.assertIn("heap at scale factor 1: only 25 grains across the plate at their true size", grains[0])

    def test_a_spec_to_start_from_is_written_and_valid(self):
        out = self.folder / "started.json"
        known = {"--plate-diameter": "10 mm", "--tube-diameter": "10 mm", "--lift-velocity": "50 mm/s",
                 "--mass": "1.602 g", "--density": "4386 kg/m^3", "--grain-diameter": "0.1 mm"}
        photos = str(SOURCE / "examples/photos/powder_a")
        done = talus("init", photos, "--out", str(out))
        self.assertEqual(done.returncode, 2)  # no terminal to ask on: every missing one is named
        for flag in known:
            self.assertIn(flag, done.stderr)
        self.assertFalse(out.exists())
        flags = [word for pair in known.items() for word in pair]
        for more in ([], ["--cohesive"]):
            out.unlink(missing_ok=True)
            done = talus("init", photos, "--out", str(out), *flags, *more)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("//", out.read_text())
            for page in re.findall(r"docs/\w+\.md", out.read_text()):  # where its comments point to
                self.assertTrue((SOURCE / page).exists(), page)
            self.assertIn("size tables in docs/scene.md", out.read_text())
            self.assertIn('"scale_factors": [8, 3]', out.read_text())  # 12.5 and 33 grains across
            searched = out.read_text().split('"parameters"')[1]
            self.assertEqual("surface_energy" in searched, bool(more))
            self.assertIn('"restitution": {"min": 0.3, "max": 0.95, "nuisance": true}', searched)
            self.assertIn('"rolling_damping": {"min": 0.05, "max": 1, "scale": "log", "nuisance": true}', searched)
            self.assertEqual('"filling": {"kind": "pour"}' in out.read_text(), bool(more))
            # (25 um (1.6e-3 J/m²)² / ((38.5 GPa)² (0.4 nm)³))^(1/3) = 0.088: DMT
            self.assertEqual('"adhesion": "dmt"' in out.read_text(), bool(more))
            self.assertEqual("Tabor's number of such grains of 70 GPa is 0.08" in out.read_text(), bool(more))
            done = talus("validate", str(out), "--without-experiment")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
        done = talus("init", photos, "--out", str(out), *flags)
        self.assertEqual(done.returncode, 2)
        self.assertIn("is there already", done.stderr)
        out.unlink()
        done = talus("init", photos, "--out", str(out), *flags, "--restitution", "0.8", "--rolling-damping", "0.2")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn('"restitution": 0.8,\n      "rolling_damping": 0.2\n    }', out.read_text())
        self.assertNotIn("nuisance", out.read_text())
        out.unlink()
        done = talus("init", photos, "--out", str(out), *flags, "--restitution", "1.2")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--restitution: is 1.2, must be in (0, 1]", done.stderr)
        done = talus("init", photos, "--out", str(out), *flags, "--rolling-damping", "-1")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--rolling-damping: is -1, must be positive", done.stderr)
        # Nothing is written, so no line of a file is named.
        done = talus("init", photos, "--out", str(out), *[word.replace("1.602 g", "1.602 kg") for word in flags])
        self.assertEqual(done.returncode, 2)
        self.assertTrue(done.stderr.startswith('--mass: is 1.602 ("1.602 kg"), in kg'), done.stderr)
        self.assertIn('write "1.602 g" for grams', done.stderr)

    # Their names say which heap each is of; once they made one heap of eighty views.
    def test_photographs_one_by_one_are_runs(self):
        out = self.folder / "one_by_one.json"
        photos = [str(path) for path in sorted((SOURCE / "examples/photos/powder_a").glob("*.jpg"))]
        done = talus("init", *photos, "--out", str(out), "--plate-diameter", "10 mm", "--tube-diameter", "10 mm",
                     "--lift-velocity", "50 mm/s", "--mass", "1.602 g", "--density", "4386 kg/m3",
                     "--grain-diameter", "100 microns")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("5 heaps (01, 02, 03, 04, 05), 80 photographs", done.stdout)
        self.assertEqual(out.read_text().count('"name": "0'), 5)
        self.assertIn('"name": "powder_a"', out.read_text())  # that of the folder, not of the first photograph
        self.assertEqual(talus("validate", str(out), "--without-experiment").returncode, 0)

    # The last dot of a folder's name was taken for that of an ending.
    def test_a_folder_with_a_dot_gives_its_whole_name(self):
        folder = self.folder / "Ti64_v1.2"
        folder.symlink_to(SOURCE / "examples/photos/powder_a")
        for photos in (f"{folder}", f"{folder}/"):
            out = self.folder / "dotted.json"
            out.unlink(missing_ok=True)
            done = talus("init", photos, "--out", str(out), "--plate-diameter", "10 mm", "--tube-diameter", "10 mm",
                         "--lift-velocity", "50 mm/s", "--mass", "1.602 g", "--density", "4386 kg/m3",
                         "--grain-diameter", "100 microns")
            self.assertEqual((done.returncode, done.stderr), (0, ""), photos)
            self.assertIn('"name": "Ti64_v1.2"', out.read_text(), photos)

    # As a user at a terminal: it asks for what no flag has said, and again after a wrong answer.
    def test_init_asks_on_a_terminal(self):
        out = self.folder / "asked.json"
        answers = {"a further test": ["tilt", "tapped_density", ""], "  mass": [""], "  diameter": ["12", "12 mm"],
                   "  tapped_density": ["1480 kg/m^3"],
                   "inner diameter of the tube": ["10 mm"], "speed at which": ["fast", "50 mm/s"],
                   "mass filled": ["1.6 kilo", "", "1.602", "1.602 g"], "density": ["4.386 kg/m3", "4386 kg/m^3"],
                   "median diameter": ["0.1 mm"], "coefficient of restitution": [""],
                   "rolling damping": [""]}
        asked = []
        ours, theirs = pty.openpty()
        init = subprocess.Popen(
            [TALUS, "init", str(SOURCE / "examples/photos/powder_a"), "--out", str(out),
             "--plate-diameter", "10 mm"], stdin=theirs, stderr=theirs, stdout=subprocess.DEVNULL,
            env={name: value for name, value in os.environ.items() if name != "OMP_WAIT_POLICY"})
        os.close(theirs)
        seen = ""
        while True:
            try:
                seen += os.read(ours, 1000).decode()
            except OSError:  # the other end is closed
                break
            if not seen.endswith("): "):
                continue
            question = seen.splitlines()[-1]
            if not asked:  # by now the program has told OpenMP's threads to wait asleep
                environment = pathlib.Path(f"/proc/{init.pid}/environ").read_bytes().split(b"\0")
                self.assertIn(b"OMP_WAIT_POLICY=passive", environment)
            asked.append(question)
            key = next(key for key in answers if question.startswith(key))
            os.write(ours, (answers[key].pop(0) + "\n").encode())
            seen = ""
        os.close(ours)
        self.assertEqual(init.wait(timeout=600), 0)
        self.assertEqual([len(left) for left in answers.values()], [0] * 11)
        self.assertEqual(len(asked), 19)  # seven questions, five asked again; the tests and one test's own three, one again
        self.assertFalse(any(question.startswith("diameter of the plate") for question in asked))
        self.assertIn('"mass": "1.602 g"', out.read_text())
        self.assertIn('"nuisance": true', out.read_text())  # nobody knows the restitution and the damping
        self.assertIn('"rig": {"kind": "tapped_density", "diameter": "12 mm"}', out.read_text())
        self.assertIn('"tapped_density": {"value": "1480 kg/m^3", "sd": "7.4 kg/m^3"}', out.read_text())
        done = talus("validate", str(out), "--without-experiment")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    # Every rig can stand beside the photographed heap, and the spec that init writes of it is in order.
    def test_init_knows_every_rig(self):
        flags = ["--plate-diameter", "10 mm", "--tube-diameter", "10 mm", "--lift-velocity", "50 mm/s",
                 "--mass", "1.602 g", "--density", "4386 kg/m^3", "--grain-diameter", "0.4 mm"]
        photos = str(SOURCE / "examples/photos/powder_a")
        tests = {"tapped_density": "diameter=8mm,tapped_density=2600kg/m^3", "drum": "diameter=30mm,angle=35deg±1deg",
                 "tilting_box": "angle=33deg", "column_collapse": "runout=12mm,height=9mm±0.5mm",
                 "draw_down": "angle=33deg", "orifice_flow": "discharge_rate=3g/s",
                 "funnel_heap": "angle_of_repose_triangle=30deg",
                 "shear_cell": "diameter=10mm,internal_friction_angle=33deg,cohesion=120Pa±40Pa"}
        for name, answers in tests.items():
            out = self.folder / f"{name}.json"
            done = talus("init", photos, "--out", str(out), *flags, "--test", f"{name}:{answers}")
            self.assertEqual((done.returncode, done.stderr), (0, ""), name)
            self.assertIn(f'"kind": "{name}"', out.read_text())
        self.assertIn('"sd": "13kg/m^3"', (self.folder / "tapped_density.json").read_text())

    # Numbers of other tests are enough: no photographs, no plate, no tube.
    def test_init_writes_a_spec_of_tests_without_photographs(self):
        out = self.folder / "numbers.json"
        flags = ["--mass", "20 g", "--density", "2500 kg/m^3", "--grain-diameter", "0.4 mm"]
        done = talus("init", "--out", str(out), *flags, "--test", "tilting_box:mass=5g,angle=33deg",
                     "--test", "lifted_tube:mass=1.6g,angle_of_repose_triangle=30deg±1deg")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertNotIn("photos", out.read_text())
        self.assertIn('"mass": "5g"', out.read_text())
        done = talus("validate", str(out))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("numbers only", done.stdout)

    # Only what is of photographs needs them: a lifted tube is made with the plate and tube of the flags.
    def test_init_makes_a_lifted_tube_with_the_flags_of_plate_and_tube(self):
        text = self.started("--plate-diameter", "20mm", "--tube-diameter", "15mm", "--lift-velocity", "5mm/s",
                            "--test", "lifted_tube:angle_of_repose_triangle=28deg")
        for entry in ('"plate_diameter": "20mm"', '"tube_inner_diameter": "15mm"', '"lift_velocity": "5mm/s"'):
            self.assertIn(entry, text)

    def test_init_takes_every_measurement_of_a_number(self):
        text = self.started("--test", "drum: angle = 30 deg, angle = 31 deg")
        self.assertIn('"angle": {"values": ["30 deg", "31 deg"]}', text)

    # Once it took only what it asks for at a terminal.
    def test_init_takes_every_number_and_option_of_a_rig(self):
        tests = {"lifted_tube:angle_of_repose_1=30deg,angle_of_repose_2=31deg±1deg,bulk_density=1500kg/m^3":
                 '"angle_of_repose_2": {"value": "31deg", "sd": "1deg"}',
                 "tapped_density:poured_density=1400kg/m^3,taps.count=50": '"taps": {"count": 50}',
                 "shear_cell:stresses=1kPa,stresses=2kPa,internal_friction_angle=30deg,travel=25mm":
                 '"stresses": ["1kPa", "2kPa"]',
                 "spreading:mass=50mg,spreader=comb,teeth=2,width=8mm,gap=4mm,length=20mm,packing_fraction=0.4": '"teeth": 2',
                 "drum:angle=30deg,fill=0.3,start_turns=0.25,camera.frames=20,camera.interval=10ms":
                 '"camera": {"frames": 20, "interval": "10ms"}',
                 "funnel_heap:follows=true,rig_height=4mm,angle_of_repose_3=30deg": '"follows": true',
                 "orifice_flow:flows=1": '"flows": {"value": "1", "sd": "0.25"}',
                 "orifice_flow:flows=1,flows=1,flows=1": '"flows": {"values": ["1", "1", "1"]}'}
        for test, entry in tests.items():
            self.assertIn(entry, self.started("--test", test), test)

    # Coarse grains go by what is filled in: a mass that no test takes counted, and a drum's fill did not.
    def test_init_chooses_the_scale_factor_by_what_is_filled_in(self):
        chosen = []
        for mass, drum in (("1 g", "fill=0.4"), ("500 g", "fill=0.4"), ("1 g", "mass=20.6g")):
            out = self.folder / f"fill{len(chosen)}.json"
            done = talus("init", "--out", str(out), "--mass", mass, "--density", "2500 kg/m^3", "--grain-diameter",
                         "0.4 mm", "--test", f"drum:{drum},diameter=60mm,width=14mm,angle=30deg")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            chosen.append(re.search(r'"scale_factors": \[(.*?)\]', out.read_text())[1])
        self.assertEqual(chosen[0], chosen[1])
        self.assertLess(abs(float(chosen[0]) - float(chosen[2])), 0.6)
        self.assertGreater(float(chosen[0]), 2)

    # The factor of the larger filling alone left 6.67 grains across the tube's plate, which the spec is refused for.
    def test_init_leaves_enough_grains_across_the_plate_of_a_lifted_tube(self):
        out = self.folder / "tube_and_cup.json"
        for plate, factor in ((None, "5"), ("15mm", "8")):
            out.unlink(missing_ok=True)
            tube = "lifted_tube:angle_of_repose_triangle=32deg" + (f",plate_diameter={plate}" if plate else "")
            done = talus("init", "--out", str(out), "--mass", "1.5g", "--density", "2500kg/m^3", "--grain-diameter", "0.15mm",
                         "--test", tube, "--test", "tapped_density:mass=50g,diameter=30mm,tapped_density=1500kg/m^3")
            self.assertEqual((done.returncode, done.stderr), (0, ""), tube)
            self.assertIn(f'"scale_factors": [{factor}]', out.read_text(), tube)

    # Its usual error was written without the unit that the value has, and refused.
    def test_init_gives_a_cohesion_its_usual_error(self):
        text = self.started("--test", "shear_cell:cohesion=0.1kPa,internal_friction_angle=30deg")
        self.assertIn('"cohesion": {"value": "0.1kPa", "sd": "50 Pa"}', text)

    # A funnel and its heap both have a height; of the two the funnel's was taken without a word.
    def test_init_tells_the_height_of_a_funnel_from_its_heaps(self):
        text = self.started("--test", "funnel_heap:rig_height=40mm,measured_height=9mm±1mm")
        self.assertIn('"height": "40mm"', text.split('"rig"')[1].split("}")[0])
        self.assertIn('"height": {"value": "9mm", "sd": "1mm"}', text)

    # A unit that the value or its error has is that of both.
    def test_init_takes_the_unit_of_a_value_for_its_error(self):
        for answer in ("1.48g/mL±0.01", "1.48±0.01g/mL", "1.48g/mL ± 0.01g/mL", "1.48 +- 0.01 g/mL"):
            text = self.started("--test", f"tapped_density:tapped_density={answer}")
            entry = json.loads(re.search(r'"tapped_density": ({"value".*?})', text)[1])
            self.assertEqual([word.replace(" ", "") for word in entry.values()], ["1.48g/mL", "0.01g/mL"], answer)

    # 55 % ± 2 was an error of 200 %, by which the share counted for nothing, and 55 ± 2 % was refused.
    def test_init_takes_the_percent_of_a_share_for_its_error(self):
        spreading = "spreading:mass=50mg,width=8mm,gap=4mm,length=20mm,"
        for answer, value, error in (("packing_fraction=55%±2", "55%", "2%"), ("packing_fraction=55±2%", "55%", "2%"),
                                     ("packing_fraction=0.55±2%", "0.55", "2%"), ("packing_fraction=0.55±0.02", "0.55", "0.02"),
                                     ("packing_fraction=50%", "50%", "1.5%"), ("coverage=95%", "95%", "2%"),
                                     ("coverage=0.95", "0.95", "0.02")):
            text = self.started("--test", spreading + answer)
            entry = json.loads(re.search(r'"(?:packing_fraction|coverage)": ({"value".*?})', text)[1])
            self.assertEqual([word.replace(" ", "") for word in entry.values()], [value, error], answer)

    def test_init_fills_and_names_each_test_as_it_must_be(self):
        text = self.started("--cohesive", "--test", "drum:angle=30deg", "--test", "drum:angle=33deg,speed=20rpm",
                            "--test", "drum:angle=35deg,name=fast,speed=25rpm", "--test", "tilting_box:angle=33deg")
        self.assertEqual(text.count('"filling": {"kind": "dense"}'), 3)  # a closed drum is not poured into
        self.assertEqual(re.findall(r'{"name": "(.*?)"', text), ["drum", "drum 2", "fast", "tilting box"])

    def test_init_takes_a_share_in_percent(self):
        self.assertIn('"restitution": "90%"', self.started("--restitution", "90%", "--test", "drum:angle=30deg"))

    # A drum of 5 rad/s instead of 5 rpm shows where it can be believed.
    def test_validate_says_what_each_test_is_simulated_with(self):
        self.started("--test", "drum:angle=30deg,speed=5rpm", "--test", "shear_cell:mass=10g,cohesion=120Pa±40Pa")
        said = talus("validate", str(self.folder / "started.json")).stdout
        self.assertIn("  rig               drum: drum: diameter 60 mm, width 14 mm, speed 5 rpm, mass 5 g\n", said)
        self.assertIn("  rig               shear cell: shear cell: stresses 1 kPa, 2 kPa and 4 kPa, diameter 25 mm", said)

    # Its fill says how full a drum is; a mass that another test takes stands beside it.
    def test_init_gives_no_mass_that_no_test_takes(self):
        drum = "drum:angle=30deg,fill=0.3"
        self.assertNotIn('"mass"', self.started("--test", drum))
        self.assertIn('"mass": "5g"', self.started("--test", drum, "--test", "tilting_box:angle=33deg"))

    # What nothing measures is no objective.
    def test_numbers_alone_have_no_objective(self):
        text = self.started("--test", "drum:angle=30deg,angle=31deg")
        self.assertNotIn("objective", text)
        spec = self.folder / "started.json"
        done = talus("validate", str(spec))
        self.assertIn("; meeting 1 number\n", done.stdout)
        spec.write_text(text.replace('"seed": 1', '"seed": 1, "trial_time_cap": "1 s"'))
        self.assertRegex(talus("validate", str(spec)).stdout,
                         r"warning: drum at scale factor 1: a trial takes about .*, and fails at the trial_time_cap of 1 s")
        for objective in ("aor2", "sad"):
            spec.write_text(text.replace('"seed": 1', f'"seed": 1, "objective": "{objective}"'))
            done = talus("validate", str(spec))
            self.assertEqual(done.returncode, 2)
            self.assertIn(f'objective: "{objective}" is of an image', done.stderr)

    # The spec that init writes of numbers alone, which it has read as any campaign would.
    def started(self, *flags):
        out = self.folder / "started.json"
        out.unlink(missing_ok=True)
        done = talus("init", "--out", str(out), "--mass", "5g", "--density", "2500kg/m^3", "--grain-diameter", "1mm", *flags)
        self.assertEqual((done.returncode, done.stderr), (0, ""), flags)
        return out.read_text()

    # Without a plate's width it is that of `measure`.
    def test_a_heap_on_a_table_is_as_wide_as_it_is_measured(self):
        grey = [[b"\xff" if y < 150 and abs(x - 200) > y - 60 else b"\0" for x in range(400)] for y in range(200)]
        photo = self.folder / "table" / "run1_view1.pgm"
        photo.parent.mkdir()
        photo.write_bytes(b"P5 400 200 255\n" + b"".join(b"".join(row) for row in grey))
        out = self.folder / "table.json"
        flags = ["--tube-diameter", "10 mm", "--lift-velocity", "50 mm/s", "--mass", "1.6 g", "--density", "4386 kg/m^3",
                 "--grain-diameter", "0.4 mm", "--scale", "0,190-100,190=10mm"]
        done = talus("init", str(photo.parent), "--out", str(out), *flags)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("the table counts over 20 mm", done.stdout)  # 1.1 times the 18 mm of the heap
        self.assertEqual(out.read_text().count('"plate_diameter": "20 mm"'), 2)

    def test_a_spec_for_a_heap_on_a_table_names_its_scale(self):
        out = self.folder / "table.json"
        flags = ["--plate-diameter", "40 mm", "--tube-diameter", "10 mm", "--lift-velocity", "50 mm/s",
                 "--mass", "1.602 g", "--density", "4386 kg/m^3", "--grain-diameter", "0.4 mm"]
        photos = str(SOURCE / "examples/photos/powder_a")
        done = talus("init", photos, "--out", str(out), *flags, "--scale", "104,310-884,312=30mm")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn('"scale": "104,310-884,312=30mm"', out.read_text())
        self.assertEqual(talus("validate", str(out), "--without-experiment").returncode, 0)
        out.unlink()
        done = talus("init", photos, "--out", str(out), *flags, "--scale", "30mm")
        self.assertEqual(done.returncode, 2)
        self.assertIn("write two points", done.stderr)

    def test_every_kind_of_input_file_is_validated(self):
        for name, says in [("scenes/heap_case.json", "rig               lifted tube: tube inner diameter 10 mm"),
                           ("rigs/tilting_box.json", "rate 20 deg/s"), ("rigs/drum.json", "s of a core\n"),
                           ("scenes/bouncing_pair.json", "spheres           2"),
                           ("optimize/bowl.json", "is a problem for `talus optimize`")]:
            done = talus("validate", str(SOURCE / "examples" / name))
            self.assertEqual((done.returncode, done.stderr), (0, ""), name)
            self.assertIn(says, done.stdout)
        problem = self.folder / "problem.json"
        problem.write_text('{"parameters": [{"name": "a", "low": 0, "high": 1}]}')
        self.assertIn("is a problem for `talus optimize`", talus("validate", str(problem)).stdout)
        scene = read_json(SOURCE / "examples/scenes/bouncing_pair.json")
        (self.folder / "fast.json").write_text(json.dumps({**scene, "rayleigh_fraction": 0.3}))
        done = talus("validate", str(self.folder / "fast.json"))
        self.assertIn("warning: the time step is 0.3 of the Rayleigh time", done.stdout + done.stderr)
        (self.folder / "record.json").write_text('{"name": "a", "spec_path": "/there/spec.json"}')
        done = talus("validate", str(self.folder / "record.json"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("is the record of a campaign, which needs no checking; its spec is /there/spec.json", done.stderr)
        plan = self.folder / "plan.json"
        plan.write_text(json.dumps({k: v for k, v in json.loads(self.spec.read_text()).items()
                                    if k in ("powder", "device", "parameters")}))
        done = talus("validate", str(plan))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertRegex(done.stdout, r"is a plan for `talus design` in order\n  candidates        \d+\n"
                                      r"    heap: \d+ grains of .* mm, .* of a core\n(    .*\n)*"
                                      r"  time              32 simulations of each, about .* of core time in all\n")

    def test_a_table_of_candidates_may_come_from_a_spreadsheet(self):
        (self.folder / "runs.csv").write_bytes(b"\xef\xbb\xbfa,b\n1,2\n3,4\n")  # with a byte order mark
        problem = self.folder / "problem.json"
        problem.write_text(json.dumps({"parameters": [{"name": name, "low": 0, "high": 5} for name in "ab"],
                                       "candidates": "runs.csv", "evaluations": 2}))
        done = talus("validate", str(problem))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("is a problem for `talus optimize`", done.stdout)
        self.assertIn(f"  candidates        2 of 2 rows of {self.folder}/runs.csv\n", done.stdout)
        (self.folder / "runs.csv").write_text("a,b\n1,2\n3,4\n3,4\n3,9\n")
        self.assertIn("candidates        2 of 4 rows of", talus("validate", str(problem)).stdout)
        for change, says in [({"parameters": [{"name": "c", "low": 0, "high": 5}]}, 'has no column "c"'),
                             ({"candidates": "none.csv"}, "none.csv: cannot be read"),
                             ({"target": {"profile": "none.png"}}, "none.png: cannot be read")]:
            (self.folder / "wrong.json").write_text(json.dumps({**json.loads(problem.read_text()), **change}))
            done = talus("validate", str(self.folder / "wrong.json"))
            self.assertEqual((done.returncode, done.stdout), (2, ""), change)
            self.assertIn(says, done.stderr)
        done = talus("optimize", str(problem), "--out", str(self.folder / "table"), "--",
                     "python3", "-c", "import json, sys; print(json.dumps({'value': json.load(sys.stdin)['a']}))")
        self.assertEqual(done.returncode, 0, done.stderr)
        values = [json.loads(line)["value"] for line in done.stderr.splitlines()]
        self.assertEqual(sorted(values), [1, 3])  # the table's rows

    # The report is watched from the second trial on, which ends when the page has been read; it must end
    # by itself with the campaign, and only its pages of the running campaign may load themselves again.
    def test_a_watched_report_follows_the_campaign_to_its_end(self):
        out = self.folder / "out"
        read = self.folder / "read"
        wait = f"case $PWD in */0001) ;; *) until [ -e {read} ]; do sleep 0.05; done ;; esac\nawk"
        (self.folder / "deck/run.sh").write_text(PILE.replace("awk", wait, 1))
        campaign = subprocess.Popen([TALUS, "calibrate", self.spec, "--out", out, "--quiet"])
        self.addCleanup(campaign.kill)
        while not list(out.glob("trials/0002")):
            self.assertIsNone(campaign.poll())
            time.sleep(0.05)
        watch = subprocess.Popen([TALUS, "report", out, "--watch"], stdout=subprocess.PIPE, text=True)
        self.addCleanup(watch.kill)
        self.assertIn("report.html", watch.stdout.readline())
        self.assertIn('http-equiv="refresh"', (out / "report/report.html").read_text())
        read.touch()
        self.assertEqual((campaign.wait(timeout=600), watch.wait(timeout=600)), (0, 0))
        page = (out / "report/report.html").read_text()
        self.assertNotIn('http-equiv="refresh"', page)
        data = json.loads(page.split('id="data">')[1].split("</script>")[0])
        self.assertEqual(data["campaign"]["state"], "finished")
        self.assertIn("chose 4 simulations at scale factor", data["methods"])
        self.assertIn("sliding friction", data["methods"])
        names = {version["name"] for version in data["versions"]}
        self.assertLessEqual({"its commit", "its compiler", "machine", "hash of the spec"}, names)
        watch.stdout.close()

    # The hint is pasted into a shell, whatever the folder is called.
    def test_an_interrupted_campaign_names_its_folder_as_a_shell_takes_it(self):
        out = self.folder / "spec ä"
        wait = "case $PWD in */0001) ;; *) sleep 3 ;; esac\nawk"
        (self.folder / "deck/run.sh").write_text(PILE.replace("awk", wait, 1))
        campaign = subprocess.Popen([TALUS, "calibrate", self.spec, "--out", out, "--quiet"],
                                    stderr=subprocess.PIPE, text=True)
        self.addCleanup(campaign.kill)
        while not list(out.glob("trials/0002")):
            self.assertIsNone(campaign.poll())
            time.sleep(0.05)
        campaign.send_signal(signal.SIGINT)
        said = campaign.communicate(timeout=600)[1]
        self.assertEqual(campaign.returncode, 130)
        self.assertIn(f"`talus resume '{out}'` goes on", said)

    def test_a_campaign_outlives_the_reader_of_its_progress(self):
        reader, writer = os.pipe()
        os.close(reader)
        done = subprocess.run([TALUS, "calibrate", self.spec, "--out", self.folder / "out"],
                              stdout=writer, stderr=writer)
        os.close(writer)
        self.assertEqual(done.returncode, 0)
        self.assertTrue((self.folder / "out/result.json").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
