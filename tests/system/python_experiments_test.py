#!/usr/bin/env python3
"""python_experiments_test.py FOLDER MODULE_DIR: the Python module reads a campaign of two parameters and two experiments,
one of them without images, as its journal and result.json have it. FOLDER: what tube_and_drum.py has made."""
import html
import pathlib
import sqlite3
import sys

sys.path.insert(0, sys.argv[2])
import numpy

import talus
from python_case import raises


def check_two_experiments(folder):
    campaign = talus.Campaign(folder)
    table = campaign.trials()
    with sqlite3.connect(f"file:{folder}/journal.sqlite?mode=ro", uri=True) as journal:
        columns = "id, experiment, scale_factor, duration_s, cpu_s, num_particles, num_steps"
        rows = journal.execute(f"select {columns} from trials order by id").fetchall()
        points = {(trial, position): value for trial, position, value in
                  journal.execute("select trial, position, value from points")}
    names = ["sliding_friction", "rolling_friction"]
    assert campaign.parameters == names and campaign.experiments == ["heap", "mixer"]
    assert [(trial, campaign.experiments.index(row.experiment), row.scale_factor, row.duration_s, row.cpu_s,
             row.num_particles, row.num_steps) for trial, row in table.iterrows()] == rows
    for position, name in enumerate(names):
        assert table[name].tolist() == [points[row[0], position] for row in rows], name
    assert table.attrs["units"]["duration_s"] == table.attrs["units"]["cpu_s"] == "s"
    spec = campaign.spec
    assert all(campaign.ranges[name] == (spec["parameters"][name]["min"], spec["parameters"][name]["max"]) for name in names)
    draws = campaign.posterior()
    answer = {p["name"]: p for p in campaign.result["parameters"]}
    for name in names:  # equally likely draws lie about what is stated of each
        p = answer[name]
        assert draws[name].between(*campaign.ranges[name]).all()
        assert (draws[name].between(p["credible_90_low"], p["credible_90_high"])).mean() > .7, name
        assert f"  {name} {p['value']:.4g} (90 %: {p['credible_90_low']:.3g} to {p['credible_90_high']:.3g})\n" in repr(campaign)
        assert f"<td>{name}</td><td>{p['value']:.4g}</td>" in campaign._repr_html_()
    assert campaign.result["verdict"]["text"] in repr(campaign)
    assert html.escape(campaign.result["verdict"]["text"]) in campaign._repr_html_()
    heaps = table.index[(table.status == "ok") & (table.experiment == "heap")].tolist()
    assert campaign.profiles().trial.values.tolist() == campaign.profiles("heap").trial.values.tolist() == heaps
    assert numpy.array_equal(campaign.aehp(), campaign.aehp("heap"))
    raises(FileNotFoundError, "mixer: has no profiles", campaign.profiles, "mixer")
    raises(FileNotFoundError, "mixer: has no image", campaign.aehp, "mixer")
    assert all(str(folder) in text and " DIR" not in text for text in campaign.warnings if "`talus" in text)


check_two_experiments(pathlib.Path(sys.argv[1]) / "run")
