# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the fiberloom authors

"""Files of fibers, tables and VTK's in all of its encodings, changed in a few places."""

import base64
import re
import struct

NUMBERS = [b"-1", b"0", b"1", b"2", b"3", b"255", b"-9", b"1e300", b"-1e300", b"1e-300", b"5e-324", b"1e400", b"nan",
           b"inf", b"-inf", b"", b"0.5", b"1e6", b"2147483648", b"-2147483649", b"4294967296", b"1000000000000",
           b"-1000000000000", b"9223372036854775807", b"18446744073709551616", b"9" * 400, b"0x1", b"one", b"1,5"]
WORDS = [0, 1, 2, 3, 4, 5, 7, 64, 255, 1 << 15, 1 << 24, (1 << 31) - 1, 1 << 31, (1 << 32) - 1, 1 << 40, 1 << 62,
         (1 << 63) - 1, 1 << 63, (1 << 64) - 1, 0x7ff0000000000000, 0x7ff8000000000000, 0x7e37e43c8800759c]
BYTES = [b"\x00", b"\xff", b"\xc3\x28", b"\x1b[31m", b"<", b">", b"/", b"&", b'"', b"'", b"=", b"_", b"%s%n", b"\r",
         b"\n", b" ", b",", b"#", b";", b"[", b"]", b"\xef\xbb\xbf", b"\xe2\x80\xa8"]
HEADINGS = [b"fiber", b"x", b"y", b"z", b"radius", b"young_modulus", b"poisson_ratio", b"x[m]", b"y[um]", b"z [nm]",
            b"radius[\xc2\xb5m]", b"radius[]", b"radius[", b"radius]", b"young_modulus[GPa]", b"poisson_ratio[%]",
            b"tex", b"", b"x[parsec]", b"radius[um][mm]", b"\x1b[31m"]
ATTRIBUTES = {
    b"type": [b"String", b"Bit", b"Float32", b"Float64", b"Int8", b"UInt8", b"Int32", b"Int64", b"UInt64", b"Float16",
              b"", b"PolyData", b"UnstructuredGrid", b"ImageData"],
    b"format": [b"ascii", b"binary", b"appended", b"hex", b""],
    b"encoding": [b"raw", b"base64", b"zip", b""],
    b"header_type": [b"UInt32", b"UInt64", b"Int8", b""],
    b"byte_order": [b"LittleEndian", b"BigEndian", b"Middle"],
    b"compressor": [b"vtkZLibDataCompressor", b"vtkLZ4DataCompressor", b"vtkLZMADataCompressor", b"vtkNone", b""],
    b"Name": HEADINGS + [b"connectivity", b"offsets", b"types", b"Points", b"A" * 100000]}
ELEMENTS = [b"<a>", b"</a>", b"<Piece>", b"<Piece NumberOfPoints=\"2\" NumberOfCells=\"1\" NumberOfLines=\"1\">",
            b"<DataArray type=\"Float64\" Name=\"radius\" format=\"ascii\">1 2</DataArray>", b"<!--", b"-->", b"<![CDATA[",
            b"<?xml?>", b"<!DOCTYPE a [<!ENTITY b \"bbbb\">]>", b"<AppendedData encoding=\"raw\">_", b"</DataArray>",
            b"</VTKFile>", b"<DataArray/>", b"&b;"]

TABLE = b"""# two fibers
fiber, x[mm], y[mm], z[mm], radius[um], young_modulus[GPa], poisson_ratio, tex
0, 0.0, 0.0, 0.0, 8, 73, 0.22, 1
0, 0.5, 0.1, 0.0, 8, 73, 0.22, 1
0, 1.0, 0.0, 0.0, 8, 73, 0.22, 1
1, 0.0, 0.0, 1.0, 9, 70, 0.2, 2
1, 1.0, 0.0, 1.0, 9, 70, 0.2, 2
"""

SCENE = """set Stages = load
set Drives = a, b
set Accuracy = draft
subsection Fibers
  set Elements per fiber = 4
end
subsection Drive a
  set Ends = all start
end
subsection Drive b
  set Ends = all end
end
"""


def piece(is_poly_data, first):
    """Three points and two fibers, as text."""
    lines = (f'<Lines><DataArray type="Int64" Name="connectivity">0 1 2 1 3</DataArray>\n'
             f'<DataArray type="Int64" Name="offsets">3 5</DataArray></Lines>\n')
    if not is_poly_data:
        lines = lines.replace("Lines>", "Cells>").replace(
            "</Cells>", '\n<DataArray type="UInt8" Name="types">4 3</DataArray></Cells>')
    return (f'<Piece NumberOfPoints="4" Number{"OfLines" if is_poly_data else "OfCells"}="2">\n'
            f'<PointData><DataArray type="Float64" Name="radius">0.01 0.01 0.01 0.01</DataArray></PointData>\n'
            f'<CellData><DataArray type="Float32" Name="young_modulus[GPa]">73 70</DataArray>\n'
            f'<DataArray type="Int32" Name="tow">0 1</DataArray></CellData>\n'
            f'<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">\n'
            f'{first} 0 0  {first} 1 .1  {first} 2 0  {first} 5 3</DataArray></Points>\n{lines}</Piece>\n').replace(
                " .1", " 0.1")


def written_as_text(is_poly_data):
    kind = "PolyData" if is_poly_data else "UnstructuredGrid"
    return (f'<?xml version="1.0"?>\n<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian">\n<{kind}>\n'
            f'{piece(is_poly_data, 0)}{piece(is_poly_data, 7)}</{kind}>\n</VTKFile>\n').encode()


class Mutator:
    """Changes the text of a file in one place of its choice."""

    def __init__(self, rng):
        self.rng = rng

    def match(self, pattern, text):
        """One of the places where a pattern is found, or None."""
        found = list(re.finditer(pattern, text))
        return self.rng.choice(found) if found else None

    def replace(self, pattern, text, new):
        match = self.match(pattern, text)
        return text[:match.start()] + new(match[0]) + text[match.end():] if match else text

    def change_bytes(self, text):
        at = self.rng.randrange(len(text) + 1)
        one = text[at:at + 1]
        return text[:at] + self.rng.choice([b"", one + one, self.rng.choice(BYTES), bytes([self.rng.randrange(256)])]) + \
            text[at + 1:]

    def change_number(self, text):
        return self.replace(rb"-?\d+(\.\d+)?", text, lambda old: self.rng.choice(NUMBERS))

    def change_heading(self, text):
        names = rb"fiber|[xyz]\b|radius|young_modulus|poisson_ratio|tex|\[\w+\]"
        return self.replace(names, text, lambda old: self.rng.choice(HEADINGS))

    def change_attribute(self, text):
        key, values = self.rng.choice(list(ATTRIBUTES.items()))
        return self.replace(rb"\b" + key + rb'="[^"]*"', text, lambda old: key + b'="' + self.rng.choice(values) + b'"')

    def change_count(self, text):
        return self.replace(rb'(NumberOf\w+|offset)="[^"]*"', text,
                            lambda old: old.split(b"=")[0] + b'="' + self.rng.choice(NUMBERS) + b'"')

    def change_element(self, text):
        return self.replace(rb"<[^>]*>", text, lambda old: self.rng.choice(
            [b"", old + old, self.rng.choice(ELEMENTS), old + self.rng.choice(ELEMENTS), old[:-1], old[:-1] + b"/>"]))

    def change_word(self, text):
        """A number that is not text, or a size before it, in base64 or as it is."""
        match = self.match(rb"[A-Za-z0-9+/]{12,}={0,2}", text)
        if match and self.rng.random() < .8:
            raw = base64.b64decode(match[0][:len(match[0]) // 4 * 4])
            return text[:match.start()] + base64.b64encode(self.word(raw)) + text[match.end():]
        start = text.find(b"<AppendedData") + 1
        return text[:start] + self.word(text[start:])

    def word(self, raw):
        size, order = self.rng.choice([(4, "<I"), (8, "<Q"), (4, ">I"), (8, ">Q")])
        at = self.rng.randrange(max(1, len(raw) // size)) * size
        number = self.rng.choice(WORDS) & ((1 << 8 * size) - 1)
        return raw[:at] + struct.pack(order, number) + raw[at + size:]

    def change_lines(self, text):
        lines = text.split(b"\n")
        i, j = self.rng.randrange(len(lines)), self.rng.randrange(len(lines))
        kind = self.rng.randrange(4)
        if kind == 0:
            del lines[i]
        elif kind == 1:
            lines.insert(j, lines[i])
        elif kind == 2:
            lines[i], lines[j] = lines[j], lines[i]
        else:
            del lines[min(i, j):max(i, j)]
        return b"\n".join(lines)

    def cut(self, text):
        return text[:self.rng.randrange(len(text) + 1)]

    def lengthen(self, text):
        at = self.rng.randrange(len(text) + 1)
        more = self.rng.choice([b"<a>", b"</a>", b"<a b='", b" ", b"0 ", b"1,", b"\n", b"a", b"=", b"<!-- -->", b"\x00"])
        return text[:at] + more * self.rng.choice([20, 1000, 200000]) + text[at:]

    def mutate(self, text, is_table):
        ways = [self.change_bytes, self.change_number, self.change_number, self.change_lines, self.change_heading]
        if not is_table:
            ways += 2 * [self.change_attribute, self.change_count, self.change_element, self.change_word]
        ways = 3 * ways + [self.cut, self.lengthen]
        # Several changes hide each other where the first is refused.
        for _ in range(self.rng.choice([1, 1, 1, 1, 2, 3, 6])):
            text = self.rng.choice(ways)(text) or b"\n"
        return text


class Fibers:
    """Makes damaged files of fibers, which one scene reads."""

    # What runs without --check, by how it ended with it, and how it may end then.
    in_full = {"exit 1": ("exit 1",)}

    def __init__(self, source, program, work):
        self.work = work
        self.scene = work / "scene.prm"
        self.scene.write_text(SCENE)
        self.files = [(".csv", TABLE)] + [(name, written_as_text(name == ".vtp")) for name in (".vtp", ".vtu")]
        self.files += [(file.suffix, file.read_bytes()) for file in sorted((source / "tests/fiber_files").iterdir())]
        for kind, text in self.files:
            self.write(kind, text)
            wrong, ended = program.run(*self.arguments(kind), "--check")
            if wrong or ended != "exit 0":
                raise SystemExit(f"a file that is not damaged: {ended} {wrong} {(work / 'err').read_text()}")

    def write(self, kind, text):
        file = self.work / ("fibers" + kind)
        file.write_bytes(text)
        return file

    def arguments(self, kind):
        return [str(self.scene), "--set", f"Fibers/File=fibers{kind}"]

    def make(self, rng):
        """The file, and the arguments of the program that reads it."""
        kind, text = rng.choices(self.files, [3] + (len(self.files) - 1) * [1])[0]
        return self.write(kind, Mutator(rng).mutate(text, kind == ".csv")), self.arguments(kind)
