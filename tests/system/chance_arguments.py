"""The command line of the tests that kill and damage campaigns at random."""
import argparse
import pathlib


def chance_arguments(what, usual, *flags):
    """TALUS SOURCE_DIR [--WHAT N] [--seed S] and `flags`; another seed, other moments or places."""
    parser = argparse.ArgumentParser()
    for folder in ("talus", "source"):
        parser.add_argument(folder, type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument(f"--{what}", type=int, default=usual)
    parser.add_argument("--seed", type=int, default=1)
    for flag in flags:
        parser.add_argument(flag, action="store_true")
    return parser.parse_args()
