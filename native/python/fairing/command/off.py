"""OFF files, text and binary: polygons, colours, normals and texture places, which no library reads them all with."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing.objects.parts import Data, Parts, Polygons, by_vertices

_WORD = re.compile(r"(?:ST|[CN4])*OFF")
_KINDS = (("N", "normals", (3,)), ("C", "colors", (4, 3)), ("ST", "uv", (2,)))  # in this order behind the place


def read(source: Path) -> tuple[Parts, list[str]]:
    """The mesh, and what can't be written again. Data at faces is their colour, or its number in a table."""
    raw = source.read_bytes()
    if (binary := re.match(rf"{_WORD.pattern}[ \t]+BINARY[ \t]*\r?\n".encode(), raw)) is not None:
        if raw[:3] != b"OFF":
            raise ValueError("binary files of this kind are read with places alone")
        places, rows = _binary(raw[binary.end() :])
        return by_vertices(places, Polygons.of(rows), ({}, {}), {}), []
    text = re.sub(r"#[^\r\n]*", "", raw.decode("ascii", "replace")).splitlines()
    lines = [words for line in text if (words := line.split())] or [[""]]
    begin = next((k for k, row in enumerate(lines) if _WORD.fullmatch(row[0].upper())), None)  # behind an appearance
    word = "OFF" if begin is None else lines[begin].pop(0)
    lines = [row for row in lines[begin or 0 :] if row]
    count, size = (int(each) for each in lines[0][:2])
    if min(count, size) < 1 or len(lines) <= count + size:
        raise ValueError("it has no faces" if size < 1 else f"it ends before {count} vertices and {size} faces")
    table, of_vertices = _vertices(lines[1 : 1 + count], word.upper())
    faces = lines[1 + count : 1 + count + size]
    sizes = np.array([int(row[0]) for row in faces], np.int32)
    corners = np.array([int(each) for row, k in zip(faces, sizes.tolist(), strict=True) for each in row[1 : 1 + k]])
    rest = [row[1 + k :] for row, k in zip(faces, sizes.tolist(), strict=True)]
    is_even = len({len(row) for row in rest}) == 1
    of_faces: Data = {"colors": _numbers(rest)} if is_even and len(rest[0]) else {}
    parts = by_vertices(table, Polygons(corners.astype(np.int32), sizes), (of_vertices, of_faces), {})
    return parts, [] if is_even else ["colors of some faces"]


def _vertices(rows: list[list[str]], word: str) -> tuple[npt.NDArray[np.float64], Data]:
    width = min(map(len, rows))
    rows = [row[:width] for row in rows]
    places = np.array([row[: 3 + ("4" in word)] for row in rows], np.float64)
    begin, data = places.shape[1], {}
    for letter, name, widths in _KINDS:
        if letter not in word.replace("OFF", ""):
            continue
        free = width - begin - 2 * (name == "colors" and "ST" in word)
        size = next((each for each in widths if each <= free), 0)
        if size == 0:
            raise ValueError(f"vertices have {width} numbers, too few for {word}")
        data[name] = _numbers([row[begin : begin + size] for row in rows], name == "colors")
        begin += size
    return places[:, :3] / places[:, 3:] if "4" in word else places, data


def _numbers(rows: list[list[str]], may_be_bytes: bool = True) -> npt.NDArray[Any]:
    """Whole numbers up to 255 as bytes, others as real ones."""
    table = np.array(rows, np.float64)
    whole = may_be_bytes and not any("." in each for row in rows for each in row)
    return table.astype(np.uint8) if whole and (table == table.astype(np.uint8)).all() else table


def _binary(raw: bytes) -> tuple[npt.NDArray[np.float64], list[list[int]]]:
    """Places and faces: Geomview's numbers, of the larger end first and with colours, or pmp's."""
    for order, coloured in ((">", True), ("<", False)):
        whole = np.frombuffer(raw, f"{order}i4", len(raw) // 4)
        count, size = whole[:2].tolist()
        at = 3 + 3 * count
        rows: list[list[int]] = []
        while count > 0 and len(rows) < size and 0 <= at < len(whole) and 0 < whole[at] < len(whole) - at:
            end = at + 1 + int(whole[at])
            rows.append(whole[at + 1 : end].tolist())
            at = end + (1 + int(whole[end]) if coloured and end < len(whole) else 0)
        if len(rows) == size > 0 and at == len(whole):
            return whole[3 : 3 + 3 * count].view(f"{order}f4").reshape(-1, 3).astype(np.float64), rows
    raise ValueError("its binary numbers are no vertices and faces")


def write(target: Path, parts: Parts, lost: list[str] | None) -> list[str]:
    """Write a mesh; tell what it can't have."""
    shapes = {name: np.shape(values)[1:] for name, values in parts.vertex_data.items()}
    known = [(letter, name) for letter, name, widths in _KINDS if shapes.get(name) in [(each,) for each in widths]]
    table = [parts.points, *(parts.vertex_data[name] for _, name in known)]
    colours = parts.face_data.get("colors")
    tails = [""] * len(parts.faces.sizes) if colours is None else [f" {row}" for row in _lines([colours])]
    faces = [f"{len(row)} {' '.join(map(str, row.tolist()))}" for row in parts.faces.rows()]
    word = "".join(letter for letter, _ in sorted(known, key=lambda each: "STCN".index(each[0])))
    lines = [f"{word}OFF", f"{len(parts.points)} {len(faces)} 0", *_lines(table), *map(str.__add__, faces, tails)]
    target.write_text("\n".join([*lines, ""]), encoding="ascii")
    gone = {*parts.vertex_data} - {name for _, name in known} | {*parts.face_data} - {"colors"}
    return sorted(gone.union(lost or ()))


def _lines(columns: list[npt.NDArray[Any]]) -> list[str]:
    rows = zip(*(values.reshape(len(values), -1).tolist() for values in columns), strict=True)
    return [" ".join(repr(each) for part in row for each in part) for row in rows]
