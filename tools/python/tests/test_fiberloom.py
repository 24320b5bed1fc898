# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors
"""The module against the program: run, failure, sweep from a checkpoint, tables and curves."""

import os
import shutil

import pytest

import fiberloom
from fiberloom.runs import text

pandas = pytest.importorskip("pandas")

SMALL = {"Fabric/Warp/Tows": 2, "Fabric/Warp/Fibers per tow": 3, "Fabric/Warp/Elements per fiber": 6, "Accuracy": "draft",
         "Output/Pictures": False, "Biaxial/Largest strain": .005}
SCENE = "prm/plain_weave.prm"


@pytest.fixture(scope="module")
def woven(tmp_path_factory):
    return fiberloom.run(SCENE, {**SMALL, "Stages": ["weave", "relax"]}, output=tmp_path_factory.mktemp("woven"))


def test_run_tells_what_it_wrote(woven):
    assert woven.converged and woven.checkpoint.exists()
    assert list(woven.stages["name"]) == ["weave", "relax"]
    assert woven.curve("relax")["thickness[mm]"].iloc[-1] == pytest.approx(woven.fabric["thickness[mm]"], rel=.1)


def test_bad_input_is_told(woven):
    with pytest.raises(fiberloom.RunFailed) as failure:
        fiberloom.run(SCENE, {"Fabric/Pattern": "plaid"}, output=woven.directory)
    assert failure.value.status == 1 and "plaid" in failure.value.message
    assert failure.value.results is None


def test_results_of_another_run_are_not_taken_for_those_of_one_that_failed(woven, tmp_path, monkeypatch):
    shutil.copy(woven.directory / "summary.json", tmp_path)
    killed = tmp_path / "killed"
    killed.write_text("#!/bin/sh\nkill -9 $$\n")
    killed.chmod(0o755)
    with monkeypatch.context() as replaced, pytest.raises(fiberloom.RunFailed) as failure:
        replaced.setenv("FIBERLOOM", str(killed))
        fiberloom.run(SCENE, SMALL, output=tmp_path)
    assert (failure.value.status, failure.value.results) == (-9, None)
    with pytest.raises(fiberloom.RunFailed, match="^stopped on request: ") as failure:
        fiberloom.run(SCENE, {**SMALL, "Maximal wall time": .1}, output=tmp_path)
    assert failure.value.status == 3 and failure.value.results.summary["run"] != woven.summary["run"]


def test_ranks_give_the_same_curve(woven, tmp_path, monkeypatch):
    for name in [name for name in os.environ if name.startswith("OMPI_")]:
        monkeypatch.delenv(name)  # the module has to set what is needed
    one, two = (fiberloom.run(SCENE, {**SMALL, "Stages": "weave, relax"}, output=tmp_path / str(ranks), ranks=ranks) for ranks in (1, 2))
    assert (one.summary["ranks"], two.summary["ranks"]) == (1, 2)
    assert two.fabric["thickness[mm]"] == pytest.approx(one.fabric["thickness[mm]"], rel=1e-3)


def test_ranks_are_told_of_bad_input(tmp_path):
    with pytest.raises(fiberloom.RunFailed, match="^bad input: fiberloom: .*plaid") as failure:
        fiberloom.run(SCENE, {"Fabric/Pattern": "plaid"}, output=tmp_path, ranks=2)
    assert failure.value.status == 1


def test_mpirun_that_cannot_start_is_no_bad_input(tmp_path, monkeypatch):
    monkeypatch.setenv("OMPI_MCA_rmaps_base_oversubscribe", "0")
    with pytest.raises(fiberloom.RunFailed, match="^status 1: ") as failure:
        fiberloom.run(SCENE, SMALL, output=tmp_path, ranks=1000)
    assert "slots" in failure.value.message


def test_sweep_goes_on_from_one_weave(woven, tmp_path):
    coefficients = [.1, .4]
    study = fiberloom.sweep(SCENE, {"Contact/Friction coefficient": coefficients}, settings=SMALL, restart=woven.checkpoint,
                            output=tmp_path)
    table = fiberloom.table(study)
    assert list(table["Contact/Friction coefficient"]) == coefficients and table["converged"].all()
    assert table["force_warp[N]"].iloc[0] < table["force_warp[N]"].iloc[1]
    assert study[0][1].curve("biaxial")["strain_warp"].iloc[-1] == pytest.approx(.005)


def test_curves_are_drawn(woven, tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    results = fiberloom.run(SCENE, {**SMALL, "Solver/Error estimate": True}, restart=woven.checkpoint, output=tmp_path)
    axes = fiberloom.plot(results, "strain_warp", "force_warp[N]")
    curve = results.curve("biaxial")
    assert list(axes.lines[0].get_ydata()) == list(curve["force_warp[N]"])
    band, = axes.collections
    least, most = curve["force_warp[N]"].min(), curve["force_warp[N]"].max()
    assert results.error("biaxial") > 0
    assert band.get_paths()[0].get_extents().height == pytest.approx(most - least + 2 * results.error("biaxial") * most)


def test_stages_of_one_name_are_told_apart(tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    results = fiberloom.run("prm/crossed_fibers.prm", {"Stages": "load, load", "Output/Pictures": False}, output=tmp_path)
    first, last = results.curve(0), results.curve("load")
    assert len(first) + len(last) == len(results.curve())
    assert [curve["load"].iloc[row] for curve in (first, last) for row in (0, -1)] == [0, 1, 0, 1]
    errors = [entry["estimated_error"]["total"] for entry in results.summary["stages"]]
    assert [results.error(0), results.error("load"), results.error()] == errors + errors[-1:] and errors[0] != errors[1]
    assert len(fiberloom.plot(results, "load", "upper_force_z[N]").lines[0].get_xdata()) == len(last)
    with pytest.raises(KeyError, match="no stage weave; there are: load, load"):
        results.curve("weave")
    with pytest.raises(KeyError, match="no stage 2"):
        results.error(2)


def test_a_preview_has_curves(tmp_path):
    study = fiberloom.sweep(SCENE, {"Accuracy": ["preview"]}, settings={**SMALL, "Stages": "weave"}, output=tmp_path)
    assert len(study[0][1].curve("weave")) > 0
    assert fiberloom.table(study)["stage"].tolist() == ["weave (preview)"]


def test_values_are_written_as_the_program_reads_them():
    numpy = pytest.importorskip("numpy")
    values = True, numpy.bool_(False), numpy.float64(.3), numpy.array([1, 2]), ["weave", "relax"], (numpy.bool_(True), 2)
    assert [text(value) for value in values] == ["true", "false", "0.3", "1, 2", "weave, relax", "true, 2"]
