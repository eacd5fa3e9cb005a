#!/usr/bin/env python3
"""measure_test.py TALUS SOURCE_DIR: `talus measure` as a user calls it, in each of its forms."""
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

TALUS = sys.argv[1]
PHOTOS = pathlib.Path(sys.argv[2]) / "examples/photos/powder_a"


def run(*arguments):
    return subprocess.run([TALUS, "measure", *map(str, arguments)], capture_output=True, text=True)


class Measure(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.aehp = cls.folder / "aehp"
        cls.done = run(PHOTOS, "--plate-diameter", "10mm", "--out", cls.aehp)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_photographs_give_profile_plate_angles_noise_floor_and_overlays(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        self.assertIn("noise floor", self.done.stdout)
        with open(self.aehp / "views.csv", newline="") as table:
            views = list(csv.DictReader(table))
        self.assertEqual(len(views), 80)
        for view in views:  # the plate is drawn 338 px wide in every photograph
            self.assertAlmostEqual(float(view["plate_width_px"]), 338, delta=0.5)
        self.assertEqual(len(list((self.aehp / "overlays").glob("*.png"))), 80)
        metrics = json.loads((self.aehp / "measure.json").read_text())["metrics"]
        # Five runs of a heap whose angle scatters by a degree or so: degrees, not radians.
        self.assertTrue(0.05 < metrics["repose_angle_2_mean_deg"]["standard_error"] < 2, metrics)

    def test_a_photograph_of_another_name_is_refused_and_not_taken_for_a_view(self):
        folder = self.folder / "strays"
        folder.mkdir()
        stray = shutil.copy(PHOTOS / "run03_view00.jpg", folder / "extra.jpg")
        photos = [shutil.copy(PHOTOS / name, folder) for name in ("run01_view00.jpg", "run02_view00.jpg")]
        for pattern in ([], ["--pattern", "run{run}_view{view}.jpg"]):
            done = run(*photos, stray, "--plate-diameter", "10mm", *pattern)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn("extra.jpg: does not fit the pattern", done.stderr)
        done = run(*photos, stray, "--plate-diameter", "10mm", "--pattern", "*")
        self.assertIn("1 heap (1), 3 photographs", done.stdout, done.stderr)

    def test_spheres_are_compared_in_the_frame_of_the_photographs(self):
        # One layer of touching grains: far less powder than in the photographs, so the SAD is close to
        # what is missing.
        spheres = self.folder / "layer.csv"
        lines = ["x_m,y_m,z_m,diameter_m"]
        for i in range(-12, 13):
            for j in range(-12, 13):
                if i * i + j * j <= 144:
                    lines.append(f"{i * 4e-4},{j * 4e-4},2e-4,4e-4")
        spheres.write_text("\n".join(lines) + "\n")
        out = self.folder / "layer"
        done = run(spheres, "--like", self.aehp, "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(next(out.rglob("metrics.csv")), newline="") as table:
            metrics = {row["metric"]: row["value"] for row in csv.DictReader(table)}
        photographed = json.loads((self.aehp / "measure.json").read_text())["metrics"]
        missing = photographed["nebp_mm2"]["value"] - float(metrics["nebp_mm2"])
        self.assertGreater(missing, 10)
        # Powder where the photographs have none (the outermost grains overhang) counts twice.
        self.assertAlmostEqual(float(metrics["sad_mm2"]), missing, delta=0.02 * missing)

    def test_spheres_in_millimetres_are_not_read_in_metres(self):
        spheres = self.folder / "millimetres.csv"
        spheres.write_text("x_m,y_m,z_m,diameter_m\n0,0,0.2,0.4\n0.4,0,0.2,0.4\n")
        done = run(spheres, "--like", self.aehp)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("has a sphere of 0.4 m, which is wider than the plate of 0.01 m; give its unit", done.stderr)

    def test_spheres_are_not_compared_with_a_drum(self):
        spheres, drum = self.folder / "one.csv", self.folder / "drum"
        spheres.write_text("x_m,y_m,z_m,diameter_m\n0,0,2e-4,4e-4\n")
        drum.mkdir()
        (drum / "drum.json").write_text("{}")
        done = run(spheres, "--like", drum)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("drum: is a measured drum; spheres are compared with heaps only", done.stderr)

    def test_bad_input_ends_with_status_2_names_it_and_writes_nothing(self):
        out = self.folder / "nothing"
        for arguments, named in [
            ((self.folder / "absent", "--plate-diameter", "10mm"), "absent"),
            ((PHOTOS, "--plate-diameter", "10kg"), "10kg"),
            ((PHOTOS,), "plate-diameter"),
            ((PHOTOS, "--plate-diameter", "10mm", "--threshold", "2"), "threshold"),
        ]:
            done = run(*arguments, "--out", out)
            self.assertEqual(done.returncode, 2, (arguments, done.stdout, done.stderr))
            self.assertIn(named, done.stderr)
            self.assertFalse(out.exists(), arguments)


    def test_overlays_are_those_of_the_last_call(self):
        photos, out = self.folder / "few", self.folder / "again"
        photos.mkdir()
        for view in range(3):
            shutil.copy(PHOTOS / f"run01_view{view:02}.jpg", photos)
        self.assertEqual(run(photos, "--plate-diameter", "10mm", "--out", out).returncode, 0)
        (photos / "run01_view02.jpg").unlink()
        (out / "overlays/fault_few_other.png").touch()
        self.assertEqual(run(photos, "--plate-diameter", "10mm", "--out", out).returncode, 0)
        self.assertEqual({picture.name for picture in (out / "overlays").iterdir()},
                         {"run_01_run01_view00.png", "run_01_run01_view01.png"})

    def test_a_map_has_no_overlays_to_look_at(self):
        out = self.folder / "map"
        done = run(self.aehp / "aehp.png", "--map", "--plate-diameter", "10mm", "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("overlays", done.stdout)
        self.assertFalse((out / "overlays").exists())

    def test_pictures_of_faults_are_offered_where_there_are_some(self):
        offer = "with --out DIR what was found in each is drawn"
        absent = run(self.folder / "absent.jpg", "--plate-diameter", "10mm")
        self.assertNotIn(offer, absent.stderr)
        self.assertNotIn("most photographs", absent.stderr)
        no_plate = self.folder / "no_plate"
        no_plate.mkdir()
        shutil.copy(self.aehp / "aehp.png", no_plate / "run1_view1.png")  # powder without its plate
        self.assertIn(offer, run(no_plate, "--plate-diameter", "10mm").stderr)


class Names(unittest.TestCase):
    """Photographs as people have them: three heaps with the names that a camera gives."""
    RUNS, VIEWS = 3, 6

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def copy(self, name):
        for run in range(self.RUNS):
            for view in range(self.VIEWS):
                path = self.folder / "photos" / name(run, view)
                path.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(PHOTOS / f"run{run + 1:02}_view{view:02}.jpg", path)
        return self.folder / "photos"

    def test_a_folder_a_heap_is_read_by_measure_init_and_spec_alike(self):
        photos = self.copy(lambda run, view: f"heap {run}/IMG_20260131_1{run}0{view}11.jpg")
        read = '3 heaps (heap 0, heap 1, heap 2), 18 photographs, read by the pattern "{run}/*"'
        measured = run(photos, "--plate-diameter", "10 mm")
        self.assertEqual(measured.returncode, 0, measured.stderr)
        self.assertIn(read, measured.stdout)
        self.assertNotIn("warning", measured.stdout)
        spec = self.folder / "spec.json"
        drafted = subprocess.run(
            [TALUS, "init", photos, "--out", spec, "--plate-diameter", "10 mm", "--tube-diameter", "10 mm", "--mass",
             "1.6 g", "--lift-velocity", "50 mm/s", "--density", "4386 kg/m3", "--grain-diameter", "0.4 mm"],
            capture_output=True, text=True)
        self.assertEqual(drafted.returncode, 0, drafted.stderr)
        self.assertIn(read, drafted.stdout)
        text = spec.read_text()
        self.assertIn('"pattern": "{run}/*",', text)
        spec.write_text(text.replace('"pattern": "{run}/*",', ""))  # photos alone are enough
        validated = subprocess.run([TALUS, "validate", spec], capture_output=True, text=True)
        self.assertEqual(validated.returncode, 0, validated.stderr)
        self.assertIn(read, validated.stdout)

    # Heaps were taken for days, and the days that the outer folders name were lost.
    def test_a_folder_a_heap_is_a_heap_of_its_mass_and_day(self):
        def measure(name, *folders):
            photos = self.copy(name)
            done = run(*[photos / folder for folder in folders], "--choose-mass", "--plate-diameter", "10mm")
            shutil.rmtree(photos)
            return done

        masses = ["1.0g_day1", "1.0g_day1", "1000mg_day2"]
        done = measure(lambda run, view: f"{masses[run]}/r{run}/IMG_{view}.jpg", "1.0g_day1", "1000mg_day2")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"\n  1 +3 .*day1: .* \(2\)  day2: .* \(1\)")
        done = measure(lambda run, view: f"1.0g/{run}/IMG_{view}.jpg", "1.0g")
        self.assertRegex(done.stdout, r"\n  1 +3 .* 1: .* \(3\)")
        done = measure(lambda run, view: f"1.0g/day{run}/IMG_{view}.jpg", "1.0g")
        self.assertRegex(done.stdout, r"day0: .* \(1\)  day1: .* \(1\)  day2")
        done = measure(lambda run, view: f"1.0g/monday/r{run}/IMG_{view}.jpg", "1.0g")
        self.assertRegex(done.stdout, r"\n  1 +3 .* monday: .* \(3\)")
        done = measure(lambda run, view: f"1.0g/{run}/IMG_{view}.jpg", "1.0g", "../photos/1.0g")
        self.assertEqual(done.returncode, 2)
        self.assertIn("named twice", done.stderr)

    # By the folders' names 1.5g stood before 1g.
    def test_the_table_of_a_mass_study_goes_by_mass(self):
        masses = ["1.5g", "1g", "2.0g"]
        photos = self.copy(lambda run, view: f"{masses[run]}/IMG_{view}.jpg")
        out = self.folder / "study"
        done = run(*[photos / mass for mass in masses], "--choose-mass", "--plate-diameter", "10mm", "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        with (out / "mass_study.csv").open() as rows:
            found = [float(row["mass_kg"]) for row in csv.DictReader(rows)]
        self.assertEqual(found, [1e-3, 1.5e-3, 2e-3])
        # What an earlier call has left among them is no mass.
        for _ in range(2):
            done = run(photos, "--choose-mass", "--plate-diameter", "10mm", "--out", photos / "study")
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_several_heaps_in_one_folder_are_never_silently_one(self):
        named = {
            "time": (lambda run, view: f"IMG_20260131_1{run}0{view}11.jpg", "taken 55 min after IMG_20260131_100511.jpg"),
            "plate": (lambda run, view: f"DSC{100 + run * self.VIEWS + view}.JPG", "the plate stands")}
        for name, says in named.values():
            photos = self.copy(name)
            done = run(photos, "--plate-diameter", "10 mm")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("all are taken for views of one heap, as their names tell no heaps apart", done.stdout)
            self.assertRegex(done.stdout, "begins another heap, it seems: .*the 18 photographs of run 1 look like 3 heaps")
            self.assertIn(says, done.stdout)
            shutil.rmtree(photos)


unittest.main(argv=sys.argv[:1])
