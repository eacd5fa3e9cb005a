#!/usr/bin/env python3
"""photographs_notebook_test.py TALUS SOURCE_DIR MODULE_DIR: the notebook from photographs to a posterior runs from
its first cell to its last, as Jupyter runs it, and leaves what it shows."""
import ast
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PYTHON = "/usr/bin/python3"  # Debian's, which sees Debian's modules
NEEDED = ("pandas", "xarray", "matplotlib")
NOTEBOOK = "examples/notebooks/photographs_to_posterior.ipynb"

def run_cells(notebook):
    """Every code cell in one namespace; what its last expression is, is shown."""
    space = {"__name__": "__main__"}
    for number, cell in enumerate(json.loads(notebook.read_text())["cells"]):
        if cell["cell_type"] != "code":
            continue
        tree = ast.parse("".join(cell["source"]), f"cell {number}")
        last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, f"cell {number}", "exec"), space)
        if last is not None:
            shown = eval(compile(ast.Expression(last.value), f"cell {number}", "eval"), space)
            print(shown._repr_html_() if hasattr(shown, "_repr_html_") else shown)

def main(talus, source, module, root):
    for needed in NEEDED:
        if subprocess.run([PYTHON, "-c", "import " + needed], stderr=subprocess.DEVNULL).returncode:
            print(needed + " is not installed for " + PYTHON)
            return 77
    folder = root / "examples/notebooks"
    folder.mkdir(parents=True)
    notebook = folder / "photographs_to_posterior.ipynb"
    shutil.copy(source / NOTEBOOK, notebook)
    (root / "examples/photos").symlink_to(source / "examples/photos")
    environment = {**os.environ, "TALUS_PROGRAM": str(talus), "PYTHONPATH": str(module), "MPLBACKEND": "Agg",
                   "MPLCONFIGDIR": str(root)}
    ended = subprocess.run([PYTHON, __file__, "--cells", notebook], cwd=folder, env=environment, text=True,
                           capture_output=True)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    print(ended.stdout)
    for picture in ("profiles.png", "posterior.png"):
        assert (folder / picture).read_bytes().startswith(b"\x89PNG"), picture
    said = ended.stdout
    assert "<b>powder A, a first look</b>, finished" in said  # the campaign, as HTML
    level = re.search(r"credible level (\d\.\d+)", said)
    assert level and float(level[1]) < 0.99, said
    assert "wide plate" in said
    return 0

if __name__ == "__main__":
    if sys.argv[1] == "--cells":
        run_cells(pathlib.Path(sys.argv[2]))
    else:
        with tempfile.TemporaryDirectory(prefix="talus_notebook_") as scratch:
            sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), pathlib.Path(sys.argv[3]).resolve(),
                          pathlib.Path(scratch)))
