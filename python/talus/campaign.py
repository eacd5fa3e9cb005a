"""A campaign's folder as tables and arrays. Reads only, so the campaign may be running."""
import json
import pathlib
import sqlite3


class Campaign:
    """The campaign in a folder that `talus calibrate` has made."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        if not (self.folder / "journal.sqlite").exists():
            raise FileNotFoundError(f"{self.folder}: holds no campaign; `talus calibrate SPEC` begins one")

    def _query(self, text, *values):
        journal = sqlite3.connect(f"file:{self.folder.resolve()}/journal.sqlite?mode=ro", uri=True)
        try:
            return journal.execute(text, values).fetchall()
        finally:
            journal.close()

    @property
    def spec(self):
        """The spec as it was understood, all defaults filled in: a dictionary."""
        return json.loads(self._query("select spec_json from campaign")[0][0])

    @property
    def parameters(self):
        """Names of the calibrated parameters."""
        return [name for (name,) in self._query("select name from parameters order by position")]

    @property
    def experiments(self):
        """Names of the experiments."""
        return [name for (name,) in self._query("select name from experiments order by position")]

    @property
    def result(self):
        """result.json as a dictionary; None before the campaign has ended once."""
        file = self.folder / "result.json"
        return json.loads(file.read_text()) if file.exists() else None

    def trials(self):
        """One row a trial, by id: what it was, its parameters and its metrics [pandas.DataFrame]."""
        import pandas
        columns = ["trial", "kind", "status", "reason", "experiment", "scale_factor", "seed", "duration_s",
                   "cpu_s", "num_particles", "num_steps"]
        table = pandas.DataFrame(self._query(
            "select t.id, t.kind, t.status, t.reason, e.name, t.scale_factor, t.seed, t.duration_s, t.cpu_s,"
            " t.num_particles, t.num_steps from trials t join experiments e on e.position = t.experiment"
            " order by t.id"), columns=columns).set_index("trial")
        for position, name in enumerate(self.parameters):
            table[name] = pandas.Series(dict(self._query(
                "select trial, value from points where position = ?", position)), dtype=float)
        for (name,) in self._query("select distinct name from metrics order by name"):
            table[name] = pandas.Series(dict(self._query(
                "select trial, value from metrics where name = ?", name)), dtype=float)
        return table

    def posterior(self):
        """Equally likely draws of the parameters, SI, one a row [pandas.DataFrame]. Raises
        FileNotFoundError where the campaign has no posterior yet."""
        import pandas
        file = self.folder / "posterior.csv"
        if not file.exists():
            raise FileNotFoundError(f"{file}: is not there; campaigns with several grain sizes or "
                                    "experiments write it when they end")
        draws = pandas.read_csv(file)
        draws.columns = self.parameters
        return draws

    def profile(self, trial):
        """A trial's average numerical heap profile [array of bytes, rows and columns]."""
        return self._image(self.folder / "trials" / f"{trial:04}" / "profile.png")

    def profiles(self):
        """All profiles of the first experiment [xarray.DataArray: trial, row, column]."""
        import numpy
        import xarray
        first = self.experiments[0]
        table = self.trials()
        ids = [i for i in table.index[(table.status == "ok") & (table.experiment == first)]
               if (self.folder / "trials" / f"{i:04}" / "profile.png").exists()]
        return xarray.DataArray(numpy.stack([self.profile(i) for i in ids]),
                                coords={"trial": ids}, dims=("trial", "row", "column"))

    def aehp(self):
        """The first experiment's average profile [array of bytes, rows and columns]."""
        return self._image(self.folder / "aehp.png")

    @staticmethod
    def _image(file):
        from ._core import read_image
        return read_image(str(file))
