# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors
"""What a run has written, as pandas data."""

import json
from pathlib import Path


class Results:
    """The output directory of a run; files are read when they are asked for."""

    def __init__(self, directory):
        """Throws FileNotFoundError where there is no summary.json."""
        self.directory = Path(directory)
        self.summary = json.loads((self.directory / "summary.json").read_text())

    def __repr__(self):
        stages = ", ".join(stage["name"] for stage in self.summary["stages"])
        return f"Results({str(self.directory)!r}: {stages}{'' if self.converged else ', not converged'})"

    @property
    def converged(self):
        """Whether all stages reached their end."""
        return self.summary["converged"]

    @property
    def checkpoint(self):
        """Path of the last state, for ``restart``."""
        return self.directory / "checkpoint"

    @property
    def fabric(self):
        """Measures of the last state by their names with units; empty where the scene is no fabric."""
        return self.summary.get("fabric") or {}

    @property
    def stages(self):
        """A row for each stage of the summary, nested entries with dots in their names."""
        import pandas
        return pandas.json_normalize(self.summary["stages"])

    def curve(self, stage=None):
        """Rows of the loading curve, of one stage or of all, without the columns that these do not have.

        ``stage`` is a name, for the last stage of that name, or a place in the summary's list.
        """
        table = self.read("loading_curve.csv")
        if stage is not None:
            names, place = self.place(stage)
            rows = table[table["stage"].str.replace(" (preview)", "", regex=False) == names[place]]
            # Each stage counts its increments anew. Those before a restart may have no rows here, those after have.
            part = (rows["increment"].diff() <= 0).cumsum()
            table = rows[part == part.max() - names[place + 1:].count(names[place])].reset_index(drop=True)
        return table.dropna(axis="columns", how="all")

    def error(self, stage=-1):
        """The estimated error of the loading curve of a stage, over its largest value; None where there is none.

        ``stage`` is as for curve.
        """
        _, place = self.place(stage)
        return (self.summary["stages"][place].get("estimated_error") or {}).get("total")

    def place(self, stage):
        """Names of all stages, and the place of one of them; throws KeyError where it is not there."""
        names = [entry["name"] for entry in self.summary["stages"]]
        places = dict(zip(names, range(len(names)))) if isinstance(stage, str) else range(len(names))
        try:
            return names, places[stage]
        except LookupError:
            raise KeyError(f"no stage {stage}; there are: {', '.join(names)}") from None

    def read(self, name):
        """A CSV file of the directory, such as trajectories.csv, reactions.csv or fabric.csv."""
        import pandas
        return pandas.read_csv(self.directory / name)


def table(study):
    """One row for each run of a sweep: its values, whether it converged, measures of the fabric, and the last row of its
    loading curve."""
    import pandas
    rows = []
    for values, results in study:
        row = dict(values, converged=isinstance(results, Results) and results.converged)
        if isinstance(results, Results):
            row.update(results.fabric)
            row.update(results.curve(-1).iloc[-1])
        rows.append(row)
    return pandas.DataFrame(rows)
