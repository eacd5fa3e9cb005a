"""A campaign's folder as tables and arrays, and what can be asked of it."""
import html
import json
import numbers
import os
import pathlib
import re
import shlex
import sqlite3
import sys

from . import program
from ._core import ConfigError, Error, decode_image, is_worked_on
from .plain import path_text, plain, truth, whole


def calibrate(spec, out=None, hold_out=None, progress=True):
    """Runs the campaign of a spec, a file or a dictionary as its JSON has it, to its end, and returns it.

    `out` is its folder, by default the spec's name without ending. A dictionary is kept beside it as OUT.json, which
    its relative paths are meant from. `progress`: a function that is called
    with each event (a dictionary, as `talus calibrate --json` has them a line), True for a line on
    standard error and, at the end, the answer's warnings; False for silence. Ctrl-C ends it cleanly; Campaign.resume goes on."""
    tell = program.teller(progress)
    if out is not None:
        out = path_text(out, "out")
    if isinstance(spec, dict):
        if out is None:
            raise ConfigError("out: is needed for a spec that is no file")
        folder = pathlib.Path(os.path.abspath(out))
        file = folder.with_name(folder.name + ".json")
        is_new = _write_spec(spec, file)
    else:
        file = pathlib.Path(path_text(spec, "spec"))
        folder = pathlib.Path(out) if out is not None else pathlib.Path(file.stem)
        is_new = False
    try:
        program.run(["calibrate", program.path(file), "--out", program.path(folder)] +
                    (["--hold-out", hold_out] if hold_out is not None else []), tell)
    except BaseException as error:
        if not is_new or (folder / "journal.sqlite").exists():
            raise
        file.unlink()  # nothing has begun: it must not stand in the way of one that is in order
        if isinstance(error, ConfigError):  # of a file that nobody has written
            raise ConfigError(re.sub(re.escape(str(file)) + r":\d+:\d+:", "spec:", str(error))) from None
        raise
    return Campaign(folder)._warned(progress)


def _write_spec(spec, file):
    """The dictionary as a file, which may be there already only if it says the same. Returns whether it is new."""
    text = json.dumps(plain(spec, "spec"), indent=1)
    is_new = not file.exists()
    if not is_new and file.read_text() != text:
        raise ConfigError(f"{file}: is there already and says something else; name another `out`, or take it away")
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)
    return is_new


def _stated(value):
    """Without what nobody has stated, at any depth: nulls and empty texts and lists, which a spec does not take."""
    if isinstance(value, list):
        return [_stated(item) for item in value]
    if isinstance(value, dict):
        return {key: _stated(item) for key, item in value.items() if item is not None and item not in ("", [])}
    return value


def _taken_again(spec):
    """A spec with all its defaults, as specs may have them: not beside what takes their place."""
    spec = _stated(spec)
    experiments = spec.get("experiments") or [spec["experiment"]]
    if not any(images in one for one in experiments for images in ("photos", "runs", "map", "film")):
        spec.pop("objective", None)  # of images
    powder = spec.get("powder", {})
    searches_fill = "fill" in spec.get("parameters", {})

    def is_filled(one):
        rig = one.get("rig", {})
        return "fill" in rig or searches_fill and rig.get("kind") == "drum"

    if "mass" in powder and all(map(is_filled, experiments)):
        powder.pop("mass")  # which only followed from the fills
    grains = spec.get("coarse_graining", {})
    if "scale_factors" in grains:
        grains.pop("scale_factor", None)
    spec.get("engine", {}).pop("templates_hash", None)  # filled in when a campaign begins
    spec.pop("num_added", None)  # when a test is added
    for parameter in spec.get("parameters", {}).values():
        if isinstance(parameter, dict):
            parameter.pop("added_at", None)  # and when a parameter is added
    return spec


class Campaign:
    """The campaign in a folder that `talus calibrate` has made. It may be running: only resume, next
    and report write there."""

    def __init__(self, folder):
        self.folder = pathlib.Path(path_text(folder, "folder")).absolute()
        if not (self.folder / "journal.sqlite").exists():
            raise FileNotFoundError(f"{self.folder}: holds no campaign; `talus calibrate SPEC` begins one")

    def _query(self, text, *values):
        file = self.folder.resolve() / "journal.sqlite"
        # SQLite makes files beside it, which an archived folder may not take.
        is_archived = not os.access(file.parent, os.W_OK) and not file.with_name(file.name + "-wal").exists()
        try:
            journal = sqlite3.connect(file.as_uri() + "?mode=ro" + ("&immutable=1" if is_archived else ""), uri=True)
            try:
                return journal.execute(text, values).fetchall()
            finally:
                journal.close()
        except sqlite3.Error as error:
            raise Error(f"{file}: cannot be read: {error}") from error

    @property
    def name(self):
        return self._query("select name from campaign")[0][0]

    @property
    def state(self):
        """"running", "finished" or "interrupted"."""
        def said():
            return self._query("select state from campaign")[0][0]

        state = said()
        if state != "running" or is_worked_on(self.folder):
            return state
        state = said()  # it may have ended meanwhile
        return "interrupted" if state == "running" else state

    @property
    def spec(self):
        """The spec as it was understood, all defaults filled in: a dictionary that calibrate takes, changed or not."""
        return _taken_again(json.loads(self._query("select spec_json from campaign")[0][0]))

    @property
    def parameters(self):
        """Names of the calibrated parameters."""
        return [name for (name,) in self._query("select name from parameters order by position")]

    @property
    def units(self):
        """SI unit of each parameter, "" of a pure number: a dictionary."""
        return dict(self._query("select name, unit from parameters order by position"))

    @property
    def ranges(self):
        """What is searched of each parameter: a dictionary of (min, max)."""
        return {name: (low, high) for name, low, high in
                self._query("select name, low, high from parameters order by position")}

    @property
    def experiments(self):
        """Names of the experiments."""
        return [name for (name,) in self._query("select name from experiments order by position")]

    @property
    def result(self):
        """result.json as a dictionary; None before the campaign has ended, and from when it goes on until
        it has ended again."""
        try:
            return json.loads((self.folder / "result.json").read_text())
        except FileNotFoundError:
            return None

    @property
    def warnings(self):
        """What to know before trusting the result, in words, the gravest first: a list, empty before there is one."""
        def named(text):
            return re.sub(r"(talus [a-z-]+ )DIR\b", lambda found: found[1] + shlex.quote(str(self.folder)), text)

        return [named(warning["text"]) for warning in (self.result or {}).get("warnings", [])]

    def _warned(self, progress):
        if progress is True:
            for text in self.warnings:
                print(f"warning: {text}", file=sys.stderr)
        return self

    def trials(self):
        """One row a trial, by id: what it was, its parameters and its metrics [pandas.DataFrame]. Units
        of the columns stand in attrs["units"], "" of a pure number, the searched ranges in attrs["ranges"]."""
        import pandas
        columns = ["trial", "kind", "status", "reason", "experiment", "scale_factor", "seed", "duration_s",
                   "cpu_s", "num_particles", "num_steps"]
        table = pandas.DataFrame(self._query(
            "select t.id, t.kind, t.status, t.reason, e.name, t.scale_factor, t.seed, t.duration_s, t.cpu_s,"
            " t.num_particles, t.num_steps from trials t join experiments e on e.position = t.experiment"
            " order by t.id"), columns=columns).set_index("trial")
        units = {"duration_s": "s", "cpu_s": "s", **self.units}
        for position, name in enumerate(self.parameters):
            table[name] = pandas.Series(dict(self._query(
                "select trial, value from points where position = ?", position)), dtype=float)
        for name, unit in self._query("select name, max(unit) from metrics group by name order by name"):
            column = name + "_of_engine" if name in table else name  # a deck may echo what it was given
            table[column] = pandas.Series(dict(self._query(
                "select trial, value from metrics where name = ?", name)), dtype=float)
            units[column] = "" if unit == "-" else unit
        table.attrs = {"units": units, "ranges": self.ranges}
        return table

    def posterior(self):
        """Equally likely draws of the parameters, SI, one a row [pandas.DataFrame], with attrs["units"]
        and attrs["ranges"]. Raises FileNotFoundError where the campaign has no posterior yet."""
        import pandas
        file = self.folder / "posterior.csv"
        if not file.exists():
            raise FileNotFoundError(f"{file}: is not there; a campaign writes its posterior when it ends "
                                    "with enough trials for one")
        draws = pandas.read_csv(file, float_precision="round_trip")
        parameters = self.parameters
        if len(draws.columns) != len(parameters):
            raise FileNotFoundError(f"{file}: is of other parameters, which the campaign had before; it writes "
                                    "its posterior anew when it ends")
        draws.columns = parameters
        draws.attrs = {"units": self.units, "ranges": self.ranges}
        return draws

    def datasets(self):
        """The groups of to_inference_data() as xarray datasets: "posterior" (chain, draw) and
        "observed_data", the numbers that were measured, with standard_error and its degrees_of_freedom (0: it was
        stated) in attrs."""
        import xarray
        draws = self.posterior()
        posterior = xarray.Dataset({name: (("chain", "draw"), draws[name].to_numpy()[None, :],
                                           {"units": self.units[name], "searched_min": self.ranges[name][0],
                                            "searched_max": self.ranges[name][1]})
                                    for name in self.parameters},
                                   coords={"chain": [0], "draw": range(len(draws))},
                                   attrs={"campaign": self.name, "created_by": "talus"})
        groups = {"posterior": posterior}
        numbers = self._query("select e.name, s.name, s.value, s.standard_error, s.degrees_of_freedom"
                              " from experiment_scalars s join experiments e on e.position = s.experiment order by s.experiment, s.position")
        if numbers:
            groups["observed_data"] = xarray.Dataset(
                {f"{experiment}: {name}": ((), value, {"standard_error": error, "degrees_of_freedom": degrees})
                 for experiment, name, value, error, degrees in numbers})
        return groups

    def to_inference_data(self):
        """The posterior for ArviZ, which must be installed: an InferenceData, of ArviZ 1 a DataTree."""
        try:
            import arviz
        except ImportError as error:
            raise ImportError("to_inference_data() needs ArviZ (pip install arviz); datasets() gives the same as "
                              "xarray datasets") from error
        groups = self.datasets()
        if hasattr(arviz, "InferenceData"):
            return arviz.InferenceData(**groups)
        import xarray
        return xarray.DataTree.from_dict(groups)

    def _frame(self, experiment):
        """Name, position and frame of an experiment; None: the first."""
        names = self.experiments
        name = names[0] if experiment is None else experiment
        if name not in names:
            raise ConfigError(f"{name}: is no experiment of {self.folder}; it has {', '.join(names)}")
        position = names.index(name)
        frame = self._query("select frame_json from experiments where position = ?", position)[0][0]
        return name, position, json.loads(frame) if frame else {}

    def _on_plate(self, images, frame, lead):
        """Images of a frame with coordinates: x from the plate's centre, z above the plate [m]; a film's strip as its
        pictures, whose frame the attributes are."""
        import numpy
        import xarray
        images = numpy.asarray(images)
        height, width = images.shape[-2:]
        count = frame.get("pictures") or 1
        if count > 1:
            width //= count
            images = numpy.moveaxis(images.reshape(*images.shape[:-1], count, width), -2, -3)
            lead = {**lead, "picture": range(1, count + 1)}
            frame = {key: value for key, value in frame.items() if key != "pictures"} | {"width_px": width}
        pixel = frame["pixel_size"]
        x = (numpy.arange(width) + .5 - frame["center_x_px"]) * pixel
        z = (frame["baseline_px"] - numpy.arange(height) - .5) * pixel
        array = xarray.DataArray(images, coords={**lead, "z": z, "x": x}, dims=(*lead, "z", "x"),
                                 attrs={"long_name": "0 powder, 255 none", **frame})
        array.x.attrs = {"units": "m", "long_name": "distance from the plate's centre"}
        array.z.attrs = {"units": "m", "long_name": "height above the plate"}
        return array

    def profile(self, trial):
        """A trial's average numerical heap profile [array of bytes, rows and columns]."""
        found = self._query("select png from profiles where trial = ?", whole(trial, "trial", 1, 10**9))
        if not found:
            raise FileNotFoundError(f"trial {trial} of {self.folder}: has no profile")
        return decode_image(found[0][0])

    def profiles(self, experiment=None):
        """All profiles of an experiment, by default the first [xarray.DataArray: trial, z, x], with x from
        the plate's centre and z above it in metres; of a film [trial, picture, z, x]."""
        import numpy
        name, _, frame = self._frame(experiment)
        table = self.trials()
        known = {trial for (trial,) in self._query("select trial from profiles")}
        ids = [i for i in table.index[(table.status == "ok") & (table.experiment == name)] if i in known]
        if not ids:
            raise FileNotFoundError(f"{name}: has no profiles")
        return self._on_plate(numpy.stack([self.profile(i) for i in ids]), frame, {"trial": ids})

    def aehp(self, experiment=None):
        """An experiment's average profile, by default the first's [xarray.DataArray: z, x]; of a film its pictures
        [picture, z, x], from 1."""
        name, position, frame = self._frame(experiment)
        png = self._query("select aehp_png from experiments where position = ?", position)[0][0]
        if not png:
            raise FileNotFoundError(f"{name}: has no image, only numbers")
        return self._on_plate(decode_image(png), frame, {})

    def consider(self, **values):
        """Where a parameter set stands, as `talus consider` says it: a dictionary with its credible_level,
        what is expected at each experiment, and the nearest trials."""
        known = self.parameters
        for name, value in values.items():
            if name not in known:
                raise ConfigError(f"{name}: is no parameter of {self.folder}; it has {', '.join(known)}")
            if not isinstance(value, (numbers.Real, str)):
                raise ConfigError(f"{name}: must be a number or a text with a unit; it is a {type(value).__name__}")
        return program.ask("consider", self.folder, *(f"{name}={value}" for name, value in values.items()))

    def next(self, candidates=None, simulate=False, budget=None):
        """What to do next, what leaves least first [pandas.DataFrame]: the share of the ranges' volume that
        is expected to remain, bits, cost, and the width of each range that it leaves (in shares of what is searched; now: attrs["width_90"]).
        `simulate` runs the few simulations that tests need to be judged, in `budget` core seconds, or
        as long as a text with a unit says, such as "2 min"."""
        import pandas
        simulate = truth(simulate, "simulate")
        if budget is not None and not simulate:
            raise ConfigError("budget: is for simulate=True")
        if isinstance(budget, numbers.Real):
            budget = f"{budget} s"
        files = [] if candidates is None else [program.path(path_text(candidates, "candidates"))]
        table = program.ask("next", self.folder, *files, *(["--simulate"] if simulate else []),
                            *([] if budget is None else ["--budget", budget]))
        rows = [{**{key: row[key] for key in ("name", "kind", "what", "remaining", "bits", "num_simulations", "core_time_s")},
                 **{f"width_{name}": (row["width_90"] or {}).get(name) for name in self.parameters}}
                for row in table["candidates"]]
        frame = pandas.DataFrame(rows).set_index("name")
        frame.attrs = {"width_90": table["width_90"], "units": {"core_time_s": "s"}}
        return frame

    def resume(self, add_simulations=None, progress=True):
        """Goes on, or extends a finished campaign; `progress` as of calibrate."""
        tell = program.teller(progress)
        program.run(["resume", self.folder] +
                    (["--add-simulations", add_simulations] if add_simulations is not None else []), tell)
        return self._warned(progress)

    def report(self):
        """Writes the report and returns its path."""
        program.call("report", program.path(self.folder))
        return self.folder / "report" / "report.html"

    def _rows(self):
        """Name, value and range of each parameter, for people."""
        result = self.result
        if result is None:
            return [(name, "", "") for name in self.parameters]
        return [(p["name"], f"{p['value']:.4g} {p['unit']}".strip(),
                 "" if p["credible_90_low"] is None else
                 f"{p['credible_90_low']:.3g} to {p['credible_90_high']:.3g}" +
                 (" by itself, not asked for" if p.get("nuisance") else "")) for p in result["parameters"]]

    def _said(self):
        result = self.result
        if result is None:
            return "no answer yet"
        return result["verdict"]["text"] if result.get("verdict") else ""

    def __repr__(self):
        count = self._query("select count(*) from trials")[0][0]
        lines = [f"<talus.Campaign \"{self.name}\", {self.state}, {count} trials, in {self.folder}"]
        lines += [f"  {name}" + (f" {value}" if value else "") + (f" (90 %: {span})" if span else "")
                  for name, value, span in self._rows()]
        said = self._said()
        lines += [*(["  " + said] if said else []), *(f"  warning: {text}" for text in self.warnings)]
        return "\n".join(lines) + ">"

    def _repr_html_(self):
        count = self._query("select count(*) from trials")[0][0]
        said = self._said()
        rows = "".join("<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in row) + "</tr>" for row in self._rows())
        return (f"<p><b>{html.escape(self.name)}</b>, {html.escape(self.state)}, {count} trials, in "
                f"<code>{html.escape(str(self.folder))}</code></p><table><thead><tr><th>parameter</th><th>recommended</th>"
                f"<th>90&nbsp;%, for all together</th></tr></thead><tbody>{rows}</tbody></table>"
                + (f"<p>{html.escape(said)}</p>" if said else "") +
                "".join(f"<p><b>warning:</b> {html.escape(text)}</p>" for text in self.warnings))
