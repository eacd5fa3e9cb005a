#!/usr/bin/python3
"""tube_and_drum.py TALUS FOLDER: runs the campaign of two tests that several tests look at, in FOLDER/run, what the
terminal said in FOLDER/terminal.txt."""
import pathlib
import shutil
import sys

from quick_campaign import tube_and_drum

talus, folder = sys.argv[1], pathlib.Path(sys.argv[2])
shutil.rmtree(folder, ignore_errors=True)
(folder / "terminal.txt").write_text(tube_and_drum(talus, folder))
