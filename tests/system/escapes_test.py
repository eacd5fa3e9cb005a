#!/usr/bin/env python3
"""escapes_test.py TALUS SOURCE_DIR: what a foreign engine prints, and what files are called, is shown and
kept, but never obeyed: not by a terminal, a browser or a reader of JSON."""
import json
import os
import pathlib
import pty
import re
import subprocess
import sys
import tempfile
import unittest

from quick_campaign import quick_spec

TALUS = sys.argv[1]
SOURCE = pathlib.Path(sys.argv[2]).resolve()

# Sets a title, clears the screen, returns, deletes, CSI as one byte and as one character, no UTF-8, turns
# the direction of writing, ends a script, NUL. The command's own bytes, as its shell's printf writes them.
EVIL = (r"\033]0;owned\007 \033[2J \r \177 \2332J \302\2332J \377\376 \342\200\256gnp "
        r"</script><script>alert(1)</script><img src=x onerror=alert(2)> \000 end")
SHOWN = r"\x1b]0;owned\x07 \x1b[2J \x0d \x7f \x9b2J \xc2\x9b2J \xff\xfe \xe2\x80\xaegnp "
NAME = "evil\x1b]0;owned\x07\x7f"
# A pile whose height follows the friction; half of all trials fail.
ENGINE = f"""printf '{EVIL}\\n'
awk 'BEGIN {{
  if ({{{{ sliding_friction }}}} > 0.5) exit 3
  print "x_m,y_m,z_m,diameter_m"
  for (i = -8; i <= 8; ++i) for (j = -8; j <= 8; ++j)
    for (k = 0; k < 12 * {{{{ sliding_friction }}}} - (i * i + j * j) / 12; ++k)
      printf "%g,%g,%g,6e-4\\n", i * 5.9e-4, j * 5.9e-4, 3e-4 + k * 5.9e-4
}}' >heap.csv
"""
# What a terminal may obey, but tab and line feed: C0, DEL, C1, what turns the direction of writing.
CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")
OURS = re.compile("\r\x1b\\[K|\r\n")  # of a line of progress


def talus(*arguments, **more):
    return subprocess.run([TALUS, *map(str, arguments)], capture_output=True, timeout=600, **more)


def at_a_terminal(*arguments):
    """All that talus writes to the terminal that it runs at."""
    ours, theirs = pty.openpty()
    process = subprocess.Popen([TALUS, *map(str, arguments)], stdout=theirs, stderr=theirs,
                               stdin=subprocess.DEVNULL)
    os.close(theirs)
    seen = b""
    while True:
        try:
            seen += os.read(ours, 65536)
        except OSError:  # the other end is closed
            break
    os.close(ours)
    process.wait(timeout=600)
    return seen


def write_campaign(folder):
    (folder / "deck").mkdir()
    (folder / "deck/run.sh").write_text(ENGINE)
    spec = quick_spec(SOURCE, "evil <img src=y onerror=alert(3)>", ["sh", "run.sh"],
                      strategy={"kind": "sobol", "num_points": 6}, budget={"simulations": 6})
    (folder / "spec.json").write_text(json.dumps(spec))


class Escapes(unittest.TestCase):
    def assert_tame(self, written, of):
        text = written.decode("utf-8", errors="strict")
        found = CONTROL.search(text)
        self.assertIsNone(found, f"{of}: {text[max(0, found.start() - 60):][:120]!r}" if found else "")
        return text


class Campaign(Escapes):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name) / NAME
        cls.folder.mkdir()
        write_campaign(cls.folder)
        cls.out = cls.folder / NAME
        cls.done = talus("calibrate", cls.folder / "spec.json", "--out", cls.out)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_the_end_of_a_log_is_shown_in_letters(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        self.assertIn(SHOWN, self.assert_tame(self.done.stderr, "errors"))
        self.assertIn(r"evil\x1b]0;owned\x07", self.assert_tame(self.done.stdout, "output"))
        self.assertIn(SHOWN, self.assert_tame((self.out / "campaign.log").read_bytes(), "campaign.log"))

    def test_every_verb_shows_it_tamely(self):
        for verb, *more in (["status"], ["compare"], ["report"], ["export"], ["card"],
                            ["card", "--format", "json"], ["consider", "sliding_friction=0.3"],
                            ["resume"], ["resume", "--add-simulations", "1"]):
            done = talus(verb, self.out, *more)
            self.assertEqual(done.returncode, 0, (verb, done.stderr))
            self.assert_tame(done.stdout + done.stderr, verb)
        for arguments in (["validate", NAME], ["status", NAME], ["next", self.out / NAME],
                          ["predict", self.out, NAME],
                          ["calibrate", self.folder / "spec.json", "--out", self.folder],
                          ["consider", self.out, NAME + "=1"], ["card", NAME], [NAME]):
            done = talus(*arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(r"\x1b]0;", self.assert_tame(done.stderr, arguments))

    def test_a_terminal_gets_no_sequence_but_our_own(self):
        out = self.folder / "at a terminal"
        seen = at_a_terminal("calibrate", self.folder / "spec.json", "--out", out)
        self.assertIn(b"\r\x1b[K", seen)  # it was taken for a terminal
        self.assertIn(SHOWN, self.assert_tame(OURS.sub("\n", seen.decode()).encode(), "terminal"))
        for verb in ("status", "compare", "report"):
            self.assert_tame(at_a_terminal(verb, out).replace(b"\r\n", b"\n"), verb)

    def test_json_stays_json(self):
        done = talus("calibrate", self.folder / "spec.json", "--out", self.folder / "json", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        events = [json.loads(line) for line in self.assert_tame(done.stdout, "json").splitlines()]
        failed = [e for e in events if e["event"] == "trial" and e["status"] == "failed"]
        self.assertTrue(failed)
        for trial in failed:
            self.assertIn(SHOWN, trial["reason"])

    def test_its_files_can_be_shown_as_they_are(self):
        for verb in ("report", "export", "compare"):
            self.assertEqual(talus(verb, self.out).returncode, 0)
        read = [path for path in self.out.rglob("*") if path.is_file() and "trials" != path.parent.name
                and path.suffix in (".json", ".csv", ".html", ".svg") and "trials/" not in str(path)]
        self.assertGreater(len(read), 8)
        for path in read:
            if path.name != "campaign.json":  # the user's own text, as it came
                self.assert_tame(path.read_bytes(), path.name)
        self.assertIn(SHOWN, (self.out / "export/trials.csv").read_text())
        reasons = [t["reason"] for t in json.loads((self.out / "export/trials.json").read_text())["trials"]
                   if t["status"] == "failed"]
        self.assertTrue(all(SHOWN in reason for reason in reasons) and reasons)

    def test_a_browser_runs_nothing_of_it(self):
        self.assertEqual(talus("report", self.out).returncode, 0)
        page = (self.out / "report/report.html").read_text()
        self.assertIn("alert(1)", page)  # it is there, as a text
        for code in ("<script>alert", "<img src=x", "<img src=y", "</script>\\u003cscript"):
            self.assertNotIn(code, page)


class Others(Escapes):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def test_a_command_of_optimize_is_quoted_tamely(self):
        problem = {"parameters": [{"name": "x", "low": 0, "high": 1}], "evaluations": 6}
        (self.folder / "p.json").write_text(json.dumps(problem))
        (self.folder / "fails.sh").write_text(f"printf '{EVIL}\\n' >&2; exit 4\n")
        (self.folder / "talks.sh").write_text(f"printf '{EVIL}\\n'\n")
        for script in ("fails.sh", "talks.sh"):
            out = self.folder / f"{script}.out"
            done = talus("optimize", self.folder / "p.json", "--out", out, "--", "sh",
                         self.folder / script)
            text = self.assert_tame(done.stdout + done.stderr, script)
            self.assertIn("owned", text)
            evaluations = (out / "evaluations.jsonl").read_bytes().splitlines()
            self.assertTrue(evaluations)
            for line in evaluations:
                self.assertIn("owned", json.loads(self.assert_tame(line, script))["failed"])
            for line in done.stderr.decode().splitlines():
                if line.startswith("{"):
                    json.loads(line)

    def test_a_failed_simulation_of_another_engine_is_told_tamely(self):
        case = json.loads(re.sub(r'("(?:[^"\\]|\\.)*")|//[^\n]*', lambda m: m[1] or "",
                                 (SOURCE / "examples/scenes/heap_case.json").read_text()))
        case["engine"] = {"templates": "deck", "command": ["sh", "run.sh"], "result": "heap.csv"}
        (self.folder / "deck").mkdir()
        (self.folder / "deck/run.sh").write_text(f"printf '{EVIL}\\n'; exit 3 # {{{{ sliding_friction }}}}"
                                                 " {{ rolling_friction }}\n")
        (self.folder / "case.json").write_text(json.dumps(case))
        done = talus("simulate", self.folder / "case.json", "--out", self.folder / "out")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn(SHOWN, self.assert_tame(done.stderr, "simulate"))
        self.assert_tame((self.folder / "out/result.json").read_bytes(), "result.json")

    def test_names_of_photographs_are_shown_tamely(self):
        photo = (SOURCE / "examples/photos/powder_a/run01_view01.jpg").read_bytes()
        for name in (b"run01\x1b[2J_view01.jpg", b"run01_l\xe4_view01.jpg"):  # the other is Latin-1
            folder = self.folder / f"{len(name)}"
            folder.mkdir()
            (pathlib.Path(os.fsdecode(os.fsencode(folder) + b"/" + name))).write_bytes(photo)
            done = talus("measure", folder, "--pattern", "*view{view}.jpg", "--plate-diameter", "10mm",
                         "--out", self.folder / f"out{len(name)}")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assert_tame(done.stdout + done.stderr, name)
            json.loads(self.assert_tame((self.folder / f"out{len(name)}/measure.json").read_bytes(), name))

    # JSON is UTF-8: a path in such a folder could be written into no copy of the spec.
    def test_a_spec_in_a_folder_that_is_not_utf_8_is_refused_in_words(self):
        folder = pathlib.Path(os.fsdecode(os.fsencode(self.folder) + b"/l\xe4"))
        folder.mkdir()
        write_campaign(folder)
        for arguments in (["validate", folder / "spec.json"],
                          ["calibrate", folder / "spec.json", "--out", self.folder / "out"]):
            done = talus(*arguments)
            self.assertEqual(done.returncode, 2, done.stderr)
            text = self.assert_tame(done.stderr, arguments)
            self.assertIn("engine.templates", text)
            self.assertIn(r"l\xe4", text)
            self.assertIn("is not UTF-8; rename that folder", text)
            self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
