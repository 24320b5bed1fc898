# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Measures what accuracy costs.

    accuracy.py PROGRAM [--work DIRECTORY] [--write FILE] [--keep] [SCENE ...]
    accuracy.py PROGRAM --levels [--work DIRECTORY] [SCENE ...]

On the scenes of scenes.py each knob is turned alone, the others at their base value, some
are turned together, and draft, standard and fine are run. For each run it prints the error
against the reference of the scene, how far the numbers are from those with the finest value
of the same knob, the program's estimate, CPU seconds of the process and Newton iterations. The
scene `unseen` runs the ten of unseen.py with an error asked for in per cent, `ways` the fabrics
of ways.py by ways that should not matter, and `estimates` compares what runs say of their error
with the error that they have.

--write puts tables into the blocks of a document that are marked for them, pictures into
../pictures/accuracy/ beside it, and what finest runs gave into references.json here. --keep takes
runs from the work directory that were made by the same version with the same values in force.
Where a scene names settings that should not matter, its reference and what is said of its levels are
means over these; the table of levels has the worst of them.
--levels only holds the levels to their errors by references.json, with the first of such settings;
status 1 if one falls short.
"""

import argparse
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, ".."), os.path.join(HERE, "..", "verification")]

import estimates
import unseen
import ways
from documents import markdown_table, replace_block
from plot import front, picture
from scenes import LEVELS, SCENES, SHORT, error, mean
from verify import Result, cpu_of_children

PRM = os.path.join(HERE, "..", "..", "prm")
REFERENCES = os.path.join(HERE, "references.json")
QUIET = ("Output/Pictures=false", "Output/Fields every=0", "Output/Slices=none", "Output/Checkpoint every=1000")
LIMIT = 1800  # seconds of a run
LEAST = 1e-6  # an error below it is shown as this one
TABLES = {"unseen": lambda run: unseen.judge(run, percent), "ways": ways.judge,
          "estimates": lambda run: estimates.judge(run, percent)}
STUDIES = list(SCENES) + list(TABLES)


class Runs:
    """Runs of the program, each done once."""

    def __init__(self, program, work, keep):
        self.program, self.work, self.keep, self.done = program, work, keep, {}
        self.version = self.ask("--version")

    def ask(self, *words):
        done = subprocess.run([self.program, *words], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{' '.join(words)}: status {done.returncode}: {done.stderr.strip()}")
        return done.stdout

    def key(self, words):
        """Of a run: its words, or the values in force and the version where earlier runs are looked for."""
        if not self.keep:
            return "".join(words)
        in_force = self.ask("--print-parameters", *words).splitlines()
        return self.version + "\n".join(line for line in in_force if not line.startswith("set Accuracy "))

    def __call__(self, file, settings, ranks=1, checkpoint=None):
        if isinstance(settings, dict):
            settings = assignments(settings)
        words = [os.path.join(PRM, file + ".prm")]
        for setting in QUIET + tuple(settings):
            words += ["--set", setting]
        how = ([] if ranks == 1 else ["mpirun", "-np", f"{ranks}", "--oversubscribe"]), ([] if checkpoint is None else ["--restart", checkpoint])
        key = hashlib.sha256((self.key(words) + "".join(sum(how, []))).encode()).hexdigest()[:16]
        if key not in self.done:
            self.done[key] = self.kept(key) or self.run(words, key, *how)
        return self.done[key]

    def kept(self, key):
        note = os.path.join(self.work, key, "cpu_seconds")
        if not self.keep or not os.path.exists(note):
            return None
        with open(note) as text:
            return Result(os.path.dirname(note), float(text.read()))

    def run(self, words, key, launcher, more):
        directory = os.path.join(self.work, key)
        shutil.rmtree(directory, ignore_errors=True)
        words = [*launcher, self.program, *words, *more, "--output-directory", directory]
        before = cpu_of_children()
        done = subprocess.run(words, capture_output=True, text=True, timeout=LIMIT)
        if done.returncode != 0:
            sys.exit(f"{' '.join(words)}: status {done.returncode}: {done.stderr.strip()}")
        result = Result(directory, cpu_of_children() - before)
        with open(os.path.join(directory, "cpu_seconds"), "w") as note:
            note.write(f"{result.cpu_seconds}")
        return result


class Point:
    """One run of the study, or what several are in the mean."""

    def __init__(self, knob, value, results, curve, reference):
        self.knob, self.value = knob, value
        self.rows = mean([curve(result) for result in results])
        self.error = error(self.rows, reference)
        self.worst = max(error(curve(result), reference) for result in results)
        self.seconds = sum(result.cpu_seconds for result in results) / len(results)
        self.iterations = round(sum(result.newton_iterations for result in results) / len(results))
        estimates = [result.summary["stages"][-1]["estimated_error"]["total"] for result in results]
        self.estimate = None if None in estimates else sum(map(abs, estimates)) / len(estimates)
        self.change = None

    def place(self):
        return self.seconds, max(self.error, LEAST)


def percent(value):
    return f"{100 * value:.2g} %" if value >= LEAST else f"< {100 * LEAST:g} %"


def estimated(point):
    """What the program itself says of its error, which may be nothing."""
    return "" if point.estimate is None else percent(point.estimate)


def short(entry):
    return SHORT.get(entry, entry.split("/")[-1])


def described(settings):
    return ", ".join(f"{short(entry)} {value}" for entry, value in settings.items())


def assignments(settings):
    """ENTRY=VALUE for all entries; a key may name several."""
    return [f"{name}={value}" for entry, value in settings.items() for name in entry.split(" and ")]


def level_settings(scene, level, repeat):
    return [f"Accuracy={level}", *scene.levels, *assignments(repeat)]


def combinations(grid):
    """All settings of a grid, as dictionaries."""
    chosen = [{}]
    for entry, values in grid:
        chosen = [{**settings, entry: value} for settings in chosen for value in values]
    return chosen


def measure(scene, run):
    """Reference and all points of a scene."""
    points = []
    finest = [run(scene.file, {**scene.base, **scene.finest, **repeat}) for repeat in scene.repeats if scene.finest]
    reference = scene.exact or mean([scene.curve(result) for result in finest])

    def add(knob, value, *results):
        points.append(Point(knob, value, results, scene.curve, reference))
        point = points[-1]
        print(f"{knob} | {value} | {percent(point.error)} | estimated {estimated(point)} | {point.seconds:.2f} s | "
              f"{point.iterations}", flush=True)
        return point

    for level in LEVELS if scene.levels is not None else ():
        results = [run(scene.file, level_settings(scene, level, repeat)) for repeat in scene.repeats]
        add("levels", level, *results)
        for repeat, result in zip(scene.repeats, results) if len(results) > 1 else ():
            add("one of them", f"{level}, {described(repeat)}", result)
    for repeat, result in zip(scene.repeats, finest) if len(finest) > 1 else ():
        add("one of them", f"finest, {described(repeat)}", result)
    for entry, values in scene.knobs.items():
        line = [add(short(entry), f"{value}", run(scene.file, {**scene.base, entry: value})) for value in values]
        for point in line:
            point.change = error(point.rows, line[-1].rows)
    for settings in combinations(scene.grid) if scene.grid else ():
        add("together", described(settings), run(scene.file, {**scene.base, **settings}))
    return reference, points


def describe(name, scene, points):
    best = set(front([point.place() for point in points]))
    rows = [[point.knob, point.value, percent(point.error), "" if point.change is None else percent(point.change),
             estimated(point), f"{point.seconds:.2f}", str(point.iterations), "yes" if point.place() in best else ""]
            for point in points]
    text = f"{scene.about} Base: {described(scene.base)}."
    if scene.finest:
        text += f" Finest: {described(scene.finest)}."
    return "\n\n".join([text, f"![Errors over CPU seconds](../pictures/accuracy/{name}.svg)",
                        markdown_table(["knob", "value", "error", "change to its finest", "estimated", "CPU s",
                               "Newton iterations", "front"], rows)])


def write_block(file, name, text):
    replace_block(file, text, f"<!-- {name}: by ./loom accuracy -->", f"<!-- end of {name} -->")


def read_references():
    if not os.path.exists(REFERENCES):
        return {}
    with open(REFERENCES) as file:
        return json.load(file)


def write_reference(name, scene, rows):
    references = read_references()
    references[name] = {"scene": f"prm/{scene.file}.prm",
                        "settings": assignments({**scene.base, **scene.finest}),
                        **({"mean over": [assignments(repeat) for repeat in scene.repeats]} if len(scene.repeats) > 1 else {}),
                        "rows": rows}
    with open(REFERENCES, "w") as file:
        json.dump(references, file, indent=1)
        file.write("\n")


def study(name, run, document):
    scene = SCENES[name]
    reference, points = measure(scene, run)
    if not document:
        return
    if scene.finest:
        write_reference(name, scene, reference)
    write_block(document, name, describe(name, scene, points))
    series = {}
    for point in points:
        series.setdefault(point.knob, []).append(point.place())
    pictures = os.path.join(os.path.dirname(os.path.abspath(document)), "..", "pictures", "accuracy")
    os.makedirs(pictures, exist_ok=True)
    with open(os.path.join(pictures, name + ".svg"), "w") as file:
        file.write(picture(re.split("[.:]", scene.about)[0].replace("`", ""), series))
    if scene.levels is None:
        return
    levels = [[name] + [f"{percent(point.worst)}, {point.seconds:.2f} s, {point.iterations}"
                        for point in points if point.knob == "levels"]]
    with open(document) as text:
        rows = [line for line in text.read().split("<!-- end of levels -->")[0].splitlines()
                if re.match(r"\| (%s) \|" % "|".join(set(SCENES) - {name}), line)]
    rows = [line.strip("| ").split(" | ") for line in rows] + levels
    rows.sort(key=lambda row: list(SCENES).index(row[0]))
    write_block(document, "levels", markdown_table(["scene", "draft (10 %)", "standard (2 %)", "fine (0.5 %)"], rows))


def hold_levels(names, run, references):
    """Number of levels that miss their error."""
    missed = 0
    for name in names:
        scene = SCENES[name]
        against = [("closed form", rows) for rows in (scene.exact, scene.held) if rows]
        if scene.finest:
            against.append(("finest run", references[name]["rows"]))
        for level, bound in LEVELS.items():
            result = run(scene.file, level_settings(scene, level, scene.repeats[0]))
            for what, rows in against:
                found = error(scene.curve(result), rows)
                missed += not found <= bound
                print(f"{name}, {level}, against the {what}: {percent(found)}, allowed {percent(bound)}, "
                      f"{result.cpu_seconds:.2f} s, {result.newton_iterations} iterations: "
                      f"{'ok' if found <= bound else 'MISSED'}", flush=True)
    return missed


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("scenes", nargs="*", help=f"{', '.join(STUDIES)}; all if none is named")
    parser.add_argument("--work", default="accuracy")
    parser.add_argument("--write")
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("--levels", action="store_true")
    arguments = parser.parse_intermixed_args()
    names = arguments.scenes or STUDIES
    unknown = set(names) - set(STUDIES)
    if unknown:
        parser.error(f"no scene {', '.join(sorted(unknown))}; allowed: {', '.join(STUDIES)}")
    os.makedirs(arguments.work, exist_ok=True)
    run = Runs(arguments.program, arguments.work, arguments.keep)
    if arguments.levels:
        names = arguments.scenes or [name for name, scene in SCENES.items() if scene.levels is not None]
        other = [name for name in names if name not in SCENES or SCENES[name].levels is None]
        if other:
            parser.error(f"no levels are held in {', '.join(other)}")
        references = read_references()
        missing = [name for name in names if SCENES[name].finest and not references.get(name, {}).get("rows")]
        if missing:
            sys.exit(f"no reference of {', '.join(missing)} in {REFERENCES}")
        sys.exit(hold_levels(names, run, references) > 0)
    for name in names:
        print(f"== {name}", flush=True)
        if name in TABLES:
            text = TABLES[name](run)
            if arguments.write:
                write_block(arguments.write, name, text)
        else:
            study(name, run, arguments.write)


if __name__ == "__main__":
    main()
