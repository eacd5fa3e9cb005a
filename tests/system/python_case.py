"""What the tests of the Python module share: a small heap's case, and `raises`."""
FRAME = {"width_px": 120, "height_px": 80, "pixel_size": 1e-4, "center_x_px": 60, "baseline_px": 70,
         "plate_diameter": 0.01}
CASE = {"powder": {"sizes": {"kind": "mono", "diameter": "1 mm"}, "mass": "0.3 g",
                   "material": {"density": 2500, "youngs_modulus": "1 MPa"}}, "frame": FRAME}


def raises(error, words, call, *arguments, **keys):
    try:
        call(*arguments, **keys)
    except error as caught:
        assert words in str(caught), caught
    else:
        raise AssertionError(f"no {error.__name__} from {call}")
