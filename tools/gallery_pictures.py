# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Pictures of doc/gallery.md from runs of its scenes.

    /usr/bin/python3 tools/gallery_pictures.py output doc/pictures/gallery

The first directory holds the output directories of the scenes that were run; those that are missing there are left alone.
Views that the program has drawn are made 800 points wide and saved with a palette, by VTK (Debian's python3-vtk9); loops of force
over motion are drawn from loading_curve.csv.
"""

import csv
import os
import struct
import sys
import zlib

VIEWS = {"twill_weave": "relax", "satin_weave": "relax", "knit": "load", "braid": "load", "rope": "load", "knot": "load",
         "composite_shear": "shear"}
# columns of the motion and of the force, with their titles
LOOPS = {"cyclic_pull": ("warp_x[mm]", "force_warp[N]", "motion of the warp's ends [mm]", "force in warp [N]"),
         "strand_bending": ("end_ry[rad]", "end_moment_y[N.mm]", "angle of the end [rad]", "moment [N mm]")}
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 640, 400, 70, 20, 20, 50


def quantized(file):
    """Width, height, indices row by row from above, and the palette of a picture made 800 points wide."""
    from vtkmodules.vtkImagingColor import vtkImageQuantizeRGBToIndex
    from vtkmodules.vtkImagingCore import vtkImageResize
    from vtkmodules.vtkIOImage import vtkPNGReader
    reader, resize, colors = vtkPNGReader(), vtkImageResize(), vtkImageQuantizeRGBToIndex()
    reader.SetFileName(file)
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    resize.SetInputConnection(reader.GetOutputPort())
    resize.SetOutputDimensions(800, 800 * height // width, 1)
    colors.SetInputConnection(resize.GetOutputPort())
    colors.SetNumberOfColors(128)
    colors.Update()
    image, table = colors.GetOutput(), colors.GetLookupTable()
    width, height, _ = image.GetDimensions()
    values = image.GetPointData().GetScalars()
    rows = [bytes(int(values.GetValue(row * width + i)) for i in range(width)) for row in reversed(range(height))]
    palette = [round(255 * c) for i in range(table.GetNumberOfTableValues()) for c in table.GetTableValue(i)[:3]]
    return width, height, rows, bytes(palette)


def save_png(file, width, height, rows, palette):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    with open(file, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)) +
                  chunk(b"PLTE", palette) + chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row for row in rows), 9)) +
                  chunk(b"IEND", b""))


def ticks(low, high):
    """Some five round numbers from `low` to `high`."""
    power = 1e-9
    while (high - low) / power > 50:
        power *= 10
    step = next(power * digit for digit in (1, 2, 5, 10) if (high - low) / (power * digit) <= 6)
    first = int(low // step)
    return [round(step * i, 9) for i in range(first, first + 9) if low <= step * i + 1e-12 and step * i <= high + 1e-12]


def loop_picture(points, title_x, title_y):
    low, high = [min(p[k] for p in points) for k in (0, 1)], [max(p[k] for p in points) for k in (0, 1)]
    x = lambda value: LEFT + (WIDTH - LEFT - RIGHT) * (value - low[0]) / (high[0] - low[0])
    y = lambda value: HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * (value - low[1]) / (high[1] - low[1])
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="13">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>']
    for tick in ticks(low[0], high[0]):
        out.append(f'<path stroke="#ddd" d="M{x(tick):.1f},{TOP}V{HEIGHT - BOTTOM}"/>')
        out.append(f'<text x="{x(tick):.1f}" y="{HEIGHT - BOTTOM + 18}" text-anchor="middle">{tick:g}</text>')
    for tick in ticks(low[1], high[1]):
        out.append(f'<path stroke="#ddd" d="M{LEFT},{y(tick):.1f}H{WIDTH - RIGHT}"/>')
        out.append(f'<text x="{LEFT - 8}" y="{y(tick) + 4:.1f}" text-anchor="end">{tick:g}</text>')
    line = " ".join(f"{x(a):.1f},{y(b):.1f}" for a, b in points)
    out.append(f'<polyline fill="none" stroke="#3b7ab8" stroke-width="2" points="{line}"/>')
    out.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 10}" text-anchor="middle">{title_x}</text>')
    middle = (TOP + HEIGHT - BOTTOM) / 2
    out.append(f'<text x="18" y="{middle}" text-anchor="middle" transform="rotate(-90 18 {middle})">{title_y}</text>')
    return "\n".join(out + ["</svg>", ""])


def loop_points(directory, motion, force):
    """Force over the way from t = 0, which is not among the rows: the first two tell where that was."""
    with open(os.path.join(directory, "loading_curve.csv")) as file:
        rows = [[float(row[name]) for name in ("t", motion, force)] for row in csv.DictReader(file) if row["t"]]
    (t1, x1, _), (t2, x2, _) = rows[:2]
    start = x1 - t1 * (x2 - x1) / (t2 - t1)
    return [(0, 0)] + [(x - start, y) for _, x, y in rows]


def main():
    runs, pictures = sys.argv[1:]
    for name, stage in VIEWS.items():
        view = os.path.join(runs, name, "pictures", f"view_{stage}.png")
        if os.path.exists(view):
            save_png(os.path.join(pictures, name + ".png"), *quantized(view))
    for name, (motion, force, *titles) in LOOPS.items():
        if os.path.exists(os.path.join(runs, name, "loading_curve.csv")):
            with open(os.path.join(pictures, name + ".svg"), "w") as out:
                out.write(loop_picture(loop_points(os.path.join(runs, name), motion, force), *titles))


if __name__ == "__main__":
    main()
