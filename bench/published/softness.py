#!/usr/bin/python3
"""softness.py TALUS FOLDER [--powder NAME]… [--variant NAME]… [--first-seed N] [--last-seed N] [--workers N]

How soft is soft enough? Heaps of Ti6Al4V at f = 12, poured, with grains (and walls) of the published Young's modulus Y,
26.25 MPa, and of Y/4, Y/10, Y/30 and Y/100; those of Bond 1 and 10 also with gamma times (Y_used/Y)^(2/5), which is said to
keep the speed below which grains stick to each other.

Each is compared with Y at the same seeds (paired_heaps.py). 30 seeds of all: 20 core minutes.
"""
import paired_heaps

SHARES = (4, 10, 30, 100)
CORRECTION = 2 / 5


def softened(share, corrected=False):
    def change(case):
        material = case["powder"]["material"]
        material["youngs_modulus"] = 26.25e6 / share
        if corrected:
            material["surface_energy"] *= share**-CORRECTION
    return change


def variants(powder):
    yield "Y", softened(1)
    for share in SHARES:
        yield f"Y/{share}", softened(share)
    if powder.startswith("Bond"):
        for share in SHARES[:-1]:
            yield f"Y/{share}, gamma too", softened(share, True)


if __name__ == "__main__":
    paired_heaps.main(__doc__, variants)
