# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""report.html holds what a run has found, and needs nothing else: no file, no network."""

import base64
import html.parser
import json
import os
import re
import shutil
import subprocess

from program_runs import SMALL_WEAVE, SOURCE, check, finish, run

VOID = {"meta", "link", "img", "br"}


class Page(html.parser.HTMLParser):
    """Text, addresses that are loaded, and whether each element that is opened is closed."""

    def __init__(self, directory):
        super().__init__()
        self.words, self.addresses, self.open, self.closed_in_order = [], [], [], True
        with open(os.path.join(directory, "report.html"), encoding="utf-8") as page:
            self.source = page.read()
        self.feed(self.source)
        self.text = " ".join(self.words)

    def handle_starttag(self, tag, attributes):
        self.addresses += [value for name, value in attributes if name in ("src", "href")]
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        self.closed_in_order &= bool(self.open) and self.open.pop() == tag

    def handle_data(self, data):
        self.words.append(data)

    def pictures(self, kind):
        start = f"data:image/{kind};base64,"
        return [base64.b64decode(address[len(start):], validate=True)
                for address in self.addresses if address.startswith(start)]


def written(directory, *names):
    with open(os.path.join(directory, *names), "rb") as file:
        return file.read()


def look_at(file):
    """What Chromium says of a page on its console, and how many pages it prints."""
    chromium = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr",
                "--user-data-dir=" + os.path.abspath("profile"), "--no-pdf-header-footer", "--print-to-pdf=page.pdf"]
    looked = subprocess.run([*chromium, "file://" + os.path.abspath(file)], capture_output=True, text=True, timeout=120)
    return ([line for line in looked.stderr.splitlines() if ":CONSOLE" in line],
            len(re.findall(rb"/Type\s*/Page\b", written("page.pdf"))))


done = run(SMALL_WEAVE, "woven", "Output/Pictures=true", "Output/Slices=both")
check("a weave is woven, relaxed and pulled", done.returncode == 0)
summary = json.loads(written("woven", "summary.json"))
lines = written("woven", "log.txt").decode().splitlines()
size = summary["model"]
check("the log says what is run, when the error is estimated, and where results are",
      lines[1] == f"fiberloom {summary['version']}  {SMALL_WEAVE}: weave, relax, biaxial of {size['fibers']} fibers, "
                  f"{size['fiber_dofs']} dofs, on 1 rank" and
      any(line.startswith("biaxial  the error of its loading curve is estimated") for line in lines) and
      lines[-1].startswith("results in woven: report.html"))
remaining = [float(line.split("remaining")[1].split()[0]) for line in lines if "remaining" in line]
check("from the weave on the log says how much remains of the scene: " + str(remaining),
      min(remaining[:2]) > 0 and remaining[-1] == 0)
page = Page("woven")
check("elements are closed", page.closed_in_order and not page.open)
check("nothing is loaded from elsewhere",
      all(address.startswith("data:") for address in page.addresses) and
      not re.search(r"@import|url\(|<script", page.source))
check("it names scene, version, run and size",
      all(text in page.text for text in (SMALL_WEAVE, summary["version"], summary["revision"], summary["run"])) and
      "All stages reached their end" in page.text and
      {str(summary["model"]["fibers"]), str(summary["model"]["fiber_dofs"])} <= set(page.words))
views, drawings = page.pictures("png"), page.pictures("svg+xml")
check("it has the view of each stage, the last one first",
      views == [written("woven", "pictures", f"view_{stage}.png") for stage in ("biaxial", "weave", "relax")])
slices = [file for file in sorted(os.listdir(os.path.join("woven", "slices")))
          if file.endswith(".svg") and not file.endswith("_0000.svg")]
check("and the slices at their ends, along both tows",
      [file.rpartition("_")[0] for file in slices] ==
      [f"{tow}_{stage}" for tow in ("fill", "warp") for stage in ("biaxial", "relax", "weave")] and
      all(drawings.count(written("woven", "slices", file)) == 1 for file in slices))
error = summary["stages"][-1]["estimated_error"]["total"]
curves = [drawing.decode() for drawing in drawings if b"loading curve, stage biaxial" in drawing]
plain = written("woven", "pictures", "loading_curve_biaxial.svg").decode()
check("its curve has the estimated error as a band",
      error > 0 and len(curves) == 1 and curves[0].count("Z\"") == plain.count("Z\"") + 2 and
      f"{100 * error:.2g} % of the largest value" in page.text)
check("it has the measures of the fabric",
      f"{summary['fabric']['thickness[mm]']:.4g}" in page.words and "crimp warp" in page.words)
check("and all parameters, folded",
      re.search(r"<details><summary>All entries in force.*Friction coefficient\s*= 0.2", page.source, re.DOTALL))

if shutil.which("chromium"):
    with open("wrong.html", "w") as wrong:
        wrong.write("<script>throw Error()</script>")
    check("a browser's console tells of errors", len(look_at("wrong.html")[0]) == 1)
    said, pages = look_at(os.path.join("woven", "report.html"))
    check(f"a browser says nothing of the page and prints {pages} pages of it: {said}", not said and pages == 2)
else:
    print("      no chromium: not looked at in a browser")

stopped = run(SMALL_WEAVE, "woven", "Output/Pictures=true", "Maximal wall time=1e-3", keep=True)
page = Page("woven")
check("a run that is stopped says so, and shows no pictures of the run before",
      stopped.returncode == 3 and os.path.exists("woven/pictures/view_weave.png") and "did not reach its end" in page.text and not page.pictures("png"))

run(SMALL_WEAVE, "summary", "Output/Only summary=true", "Stages=weave")
check("without files there is none", sorted(os.listdir("summary")) == ["log.txt", "summary.json"])

name = "<b>&.prm"
with open(os.path.join(SOURCE, "prm", "crossed_fibers.prm")) as scene, open(name, "w") as copy:
    copy.write(scene.read())
check("a name that looks like HTML is text", run(name, "name").returncode == 0 and name in Page("name").words)
finish()
