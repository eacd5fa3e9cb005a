"""The spec of a campaign that ends in seconds: one run of powder A's photographs, one parameter, and a
command in the folder `deck` for an engine."""


def quick_spec(source, name, command, **more):
    """`source`: the project's folder; `more`: further keys, or others in place of these."""
    return {
        "name": name,
        "experiment": {"photos": str(source / "examples/photos/powder_a"),
                       "pattern": "run01_view{view}.jpg", "plate_diameter": "10 mm",
                       "pixel_size": "200 um"},
        "powder": {"material": {"density": "4386 kg/m^3", "youngs_modulus": "26.25 MPa",
                                "poisson_ratio": 0.342, "restitution": 0.9},
                   "sizes": {"kind": "mono", "diameter": "0.6 mm"}, "mass": "1.6 g"},
        "device": {"tube_inner_diameter": "10 mm", "plate_diameter": "10 mm"},
        "parameters": {"sliding_friction": {"min": 0.1, "max": 0.9}},
        "engine": {"kind": "command", "templates": "deck", "command": command, "result": "heap.csv"},
        "budget": {"simulations": 4}, "noise": {"replicates": 2},
        "confirm": {"candidates": 1, "replicates": 2}, "seed": 1, **more,
    }
