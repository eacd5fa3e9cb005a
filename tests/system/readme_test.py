#!/usr/bin/env python3
"""readme_test.py TALUS SOURCE_DIR: what the README tells a newcomer to type is there, and stands where they look first."""
import pathlib
import re
import subprocess
import sys
import unittest

TALUS = sys.argv[1]
SOURCE = pathlib.Path(sys.argv[2]).resolve()
README = (SOURCE / "README.md").read_text()
FIRST_SCREEN = "\n".join(README.splitlines()[:32])


def help_of(*verb):
    return subprocess.run([TALUS, "help", *verb], capture_output=True, text=True, check=True).stdout


class Readme(unittest.TestCase):
    def test_first_screen_has_the_four_commands_before_anything_of_the_project(self):
        commands = re.findall(r"^    talus (\w+)", FIRST_SCREEN, re.MULTILINE)
        self.assertEqual(commands, ["init", "validate", "calibrate", "report"])
        self.assertLess(README.index("    talus init"), README.index("scripts/demo"))
        self.assertLess(README.index("scripts/demo"), README.index("## What is in it"))

    def test_first_screen_says_how_to_get_the_program_and_to_take_the_photographs(self):
        for words in ("without compiling", "Linux-x86_64.tar.gz", "light from behind", "three heaps or more", "a folder each"):
            self.assertIn(words, " ".join(FIRST_SCREEN.split()))

    def test_every_verb_and_flag_is_one_of_the_program(self):
        verbs = set(re.findall(r"^  (\w+) ", help_of(), re.MULTILINE))
        used = re.findall(r"^    talus (\w[\w-]*)(.*)", README, re.MULTILINE) + re.findall(r"`talus (\w[\w-]*)([^`]*)`", README)
        self.assertGreater(len(used), 20)
        for verb, rest in used:
            if verb == "help":
                continue
            self.assertTrue(f"\n  {verb} " in help_of(), verb)
            for flag in re.findall(r"--[a-z][a-z-]*", rest.split("#")[0]):
                self.assertIn(flag, help_of(verb), (verb, flag))
        self.assertIn("report", verbs)

    def test_every_file_that_it_names_is_there(self):
        for path in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", README) + re.findall(r"\b(scripts/\w+)", README):
            self.assertTrue((SOURCE / path).exists(), path)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
