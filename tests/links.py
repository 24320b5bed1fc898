# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Links between documents lead to files and headings that are there, and scenes that the gallery names exist.
Usage, from the top: links.py

First it is tried on a made-up document with one broken link of each kind.
"""

import glob
import os
import re
import sys
import tempfile


def without_code(text):
    return re.sub(r"^(```.*?^```| {4}[^\n]*)$", "", text, flags=re.MULTILINE | re.DOTALL)


def anchors(text):
    """Of the headings, as forges make them; the second of a name has -1 behind it."""
    found = []
    for heading in re.findall(r"^#+ +(.+?) *$", without_code(text), re.MULTILINE):
        anchor = re.sub(r"[^\w\- ]", "", re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading.lower())).replace(" ", "-")
        same = sum(re.fullmatch(re.escape(anchor) + r"(-\d+)?", other) is not None for other in found)
        found.append(f"{anchor}-{same}" if same else anchor)
    return found


def broken(page):
    """One line for each link of the page that leads nowhere, and the number of links read."""
    with open(page) as file:
        text = file.read()
    links = re.findall(r"\]\(([^) ]+)\)", without_code(text))
    complaints = []
    for link in links:
        if re.match(r"\w+:", link):
            continue
        name, _, anchor = link.partition("#")
        target = os.path.normpath(os.path.join(os.path.dirname(page), name)) if name else page
        if not os.path.exists(target):
            complaints.append(f"{page}: {link} is not there")
        elif anchor and target.endswith(".md"):
            with open(target) as file:
                if anchor not in anchors(file.read()):
                    complaints.append(f"{page}: {link}: there is no such heading")
    return complaints, len(links)


def try_on_violations():
    with tempfile.TemporaryDirectory() as directory:
        page = os.path.join(directory, "page.md")
        with open(page, "w") as file:
            file.write("# One, two\n## One, two\n[a](page.md#one-two) [b](#one-two-1) [c](https://x.org) [d](#three) "
                       "![e](none.png) [f](page.md#one-two-2)\n\n    [g](code.md)\n")
        blamed = [line.split()[1] for line in broken(page)[0]]
    if blamed != ["#three:", "none.png", "page.md#one-two-2:"]:
        sys.exit(f"The check itself is wrong: it blames {blamed}.")


try_on_violations()
complaints, n_links = [], 0
for page in sorted(glob.glob("*.md") + glob.glob("doc/**/*.md", recursive=True)):
    of_page, n = broken(page)
    complaints += of_page
    n_links += n
with open("doc/gallery.md") as file:
    scenes = set(re.findall(r"prm/[\w/]+\.prm", file.read()))
complaints += [f"doc/gallery.md: {scene} is not there" for scene in sorted(scenes) if not os.path.exists(scene)]
if len(scenes) < 12:
    complaints.append(f"doc/gallery.md has {len(scenes)} scenes")
print(*complaints, f"{n_links} links and {len(scenes)} scenes read, {len(complaints)} wrong", sep="\n")
sys.exit(1 if complaints or n_links == 0 else 0)
