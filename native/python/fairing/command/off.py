"""OFF files in text: polygons and colours, which no library reads together."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing.objects.parts import Data, Parts, Polygons, by_vertices

_WORD = re.compile(r"(?:ST|[CN4])*OFF")


def read(_: Any, source: Path) -> tuple[Parts, list[str]]:
    """The mesh, and what can't be written again. Data at faces is their colour, or its number in a table."""
    text = re.sub(r"#[^\r\n]*", "", source.read_bytes().decode("ascii", "replace")).splitlines()
    lines = [words for line in text if (words := line.split())] or [[""]]
    begin = next((k for k, row in enumerate(lines) if _WORD.fullmatch(row[0].upper())), None)  # behind an appearance
    word = "OFF" if begin is None else lines[begin].pop(0).upper()
    lines = [row for row in lines[begin or 0 :] if row]
    count, size = (int(each) for each in lines[0][:2])
    if min(count, size) < 1 or len(lines) <= count + size:
        raise ValueError("it has no faces" if size < 1 else f"it ends before {count} vertices and {size} faces")
    table, of_vertices = _vertices(lines[1 : 1 + count], word.removesuffix("OFF"))
    faces = lines[1 + count : 1 + count + size]
    sizes = np.array([int(row[0]) for row in faces], np.int32)
    corners = np.array([int(each) for row, k in zip(faces, sizes.tolist(), strict=True) for each in row[1 : 1 + k]])
    rest = [row[1 + k :] for row, k in zip(faces, sizes.tolist(), strict=True)]
    is_even = len({len(row) for row in rest}) == 1
    of_faces: Data = {"colors": _numbers(rest)} if is_even and len(rest[0]) else {}
    lost = {"normals": "N" in word, "uv": "ST" in word, "colors of some faces": not is_even}
    parts = by_vertices(table, Polygons(corners.astype(np.int32), sizes), (of_vertices, of_faces), {})
    return parts, [name for name, holds in lost.items() if holds]


def _vertices(rows: list[list[str]], kind: str) -> tuple[npt.NDArray[np.float64], Data]:
    """A place, a normal, a colour of three or four numbers and a place in a texture follow each other."""
    width, begin = min(map(len, rows)), 3 + ("4" in kind)
    table = np.array([row[:begin] for row in rows], np.float64)
    places = table[:, :3] / table[:, 3:] if "4" in kind else table
    if "C" not in kind:
        return places, {}
    begin += 3 * ("N" in kind)
    size = min(4, width - begin - 2 * ("ST" in kind))
    if size < 3:
        raise ValueError(f"vertices have {width} numbers, too few for {kind}OFF")
    return places, {"colors": _numbers([row[begin : begin + size] for row in rows])}


def _numbers(rows: list[list[str]]) -> npt.NDArray[Any]:
    """Whole numbers up to 255 as bytes, others as real ones."""
    table = np.array(rows, np.float64)
    whole = not any("." in each for row in rows for each in row)
    return table.astype(np.uint8) if whole and (table == table.astype(np.uint8)).all() else table


def write(_: Any, target: Path, parts: Parts, lost: list[str] | None) -> list[str]:
    """Write a mesh; tell what it can't have."""
    stores = parts.vertex_data, parts.face_data
    of_vertices, of_faces = ([data["colors"]] if "colors" in data else [] for data in stores)
    tails = [f" {row}" for row in _lines(of_faces)] or [""] * len(parts.faces.sizes)
    faces = [f"{len(row)} {' '.join(map(str, row.tolist()))}" for row in parts.faces.rows()]
    head = ["COFF" if of_vertices else "OFF", f"{len(parts.points)} {len(faces)} 0"]
    lines = [*head, *_lines([parts.points, *of_vertices]), *map(str.__add__, faces, tails), ""]
    target.write_text("\n".join(lines), encoding="ascii")
    return sorted({*parts.vertex_data, *parts.face_data}.union(lost or ()) - {"colors"})


def _lines(columns: list[npt.NDArray[Any]]) -> list[str]:
    rows = zip(*(values.reshape(len(values), -1).tolist() for values in columns), strict=True)
    return [" ".join(repr(each) for part in row for each in part) for row in rows]
