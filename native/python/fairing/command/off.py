"""OFF files: all that their first word may announce, in text or binary."""

from __future__ import annotations

import itertools
import re
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _arguments
from fairing.command.corners import by_points, by_vertices
from fairing.objects.parts import PLACE, Data, Parts, Polygons

Array = npt.NDArray[Any]
Words = list[str]
_FIRST = re.compile(r"\s*(?:((?:ST|C|N|4|n)*)OFF|off|Off)\b[ \t]*(BINARY)?")


def read(source: Path) -> tuple[Parts, str]:
    """The mesh, and the type of its numbers where it is binary; without the word OFF a file begins with its counts."""
    raw = source.read_bytes()
    text = re.sub("#.*", "", raw.decode("utf-8", "replace"))
    first = _FIRST.match(text)
    letters = first[1] or "" if first else ""
    st, c, n, homogeneous = ("ST" in letters, "C" in letters, "N" in letters, "4" in letters)
    if "n" in letters:
        raise ValueError("it has another dimension than three")
    if first and first[2]:
        return _binary(raw[raw.index(b"\n") + 1 :], 3 * n)
    lines = [words for line in text[first.end() if first else 0 :].splitlines() if (words := line.split())]
    counts: list[int] = []
    while len(counts) < 2:
        counts += map(int, lines.pop(0))
    if len(counts) == 2 and len(lines[0]) == 1:
        del lines[0]  # the count of edges
    fixed = 3 + homogeneous + 3 * n
    vertices, faces = _in_lines(lines, counts, fixed + 4 * c + 2 * st)
    table = _table(vertices)
    points = table[:, :3].astype(np.float64) / (table[:, 3:4].astype(np.float64) if homogeneous else 1.0)
    data: Data = {"normals": table[:, fixed - 3 : fixed].astype(np.float64)} if n else {}
    colours = table[:, fixed : table.shape[1] - 2 * st]
    if colours.shape[1] in (3, 4) and (c or not n):  # some programs don't announce them
        data["colors"] = _colours(colours)
    if st:
        data["uv"] = table[:, -2:].astype(np.float64)
    corners = np.array([word for row in faces for word in row[1 : int(row[0]) + 1]]).astype(np.int64)
    polygons = Polygons(_arguments.integers("faces", corners, None), np.array([int(row[0]) for row in faces], np.int32))
    tails = {len(row) - int(row[0]) - 1 for row in faces}
    of_faces: Data = {}
    if tails in ({3}, {4}):
        of_faces["colors"] = _colours(_table([row[int(row[0]) + 1 :] for row in faces]))
    return by_vertices(points, polygons, (data, of_faces), {}), ""


def _in_lines(lines: list[Words], counts: list[int], width: int) -> tuple[list[Words], list[Words]]:
    """The words of each vertex and face; where a file breaks lines elsewhere, faces have no colours."""
    vertices, end = counts[0], counts[0] + counts[1]
    odd = len(lines) < end or any(len(row) <= int(row[0]) for row in lines[vertices:end])
    if odd or any(len(row) < 3 for row in lines[:vertices]):
        words = list(itertools.chain(*lines))
        vertices = min(vertices, len(words))
        lines = [words[k * width : (k + 1) * width] for k in range(vertices)]
        at = vertices * width
        while at < len(words):
            lines.append(words[at : at + max(int(words[at]), 0) + 1])
            at += len(lines[-1])
    if len(lines) < end:
        raise ValueError(f"it announces {vertices} vertices and {counts[1]} faces and ends before")
    return lines[:vertices], lines[vertices:end]


def _table(lines: list[Words]) -> Array:
    """The columns that all lines have."""
    width = min(map(len, lines), default=3)
    return np.array([line[:width] for line in lines], dtype=str).reshape(len(lines), width)


def _colours(words: Array) -> Array:
    """Bytes where they are whole numbers."""
    values = words.astype(np.float64)
    whole = (
        not np.char.find(words, ".").max(initial=-1) >= 0
        and values.min(initial=0) >= 0
        and values.max(initial=0) <= 255
    )
    return values.astype(np.uint8) if whole else values


def _binary(raw: bytes, normals: int) -> tuple[Parts, str]:
    """In either order, with floats of either size; after a face some programs write how many colours follow."""
    for order, kind, coloured in itertools.product("<>", ("f4", "f8"), (0, 1)):
        vertices, faces, _ = np.frombuffer(raw, f"{order}u4", 3).tolist()
        at = 12 + vertices * (3 + normals) * int(kind[1])
        if at > len(raw):
            continue
        table = np.frombuffer(raw, order + kind, vertices * (3 + normals), 12).reshape(vertices, -1).astype(np.float64)
        rest = np.frombuffer(raw[at : at + (len(raw) - at) // 4 * 4], f"{order}u4")
        rows: list[Array] = []
        k = 0
        while k < len(rest) and len(rows) < faces and 2 < rest[k] < len(rest):
            rows.append(rest[k + 1 : k + 1 + int(rest[k])])
            k += 1 + int(rest[k])
            k += coloured * (1 + int(rest[k])) if k < len(rest) else 0
        if (
            len(rows) == faces
            and at + 4 * k == len(raw)
            and max((int(row.max()) for row in rows), default=0) < vertices
        ):
            polygons = Polygons(np.concatenate(rows).astype(np.int32), np.array([len(row) for row in rows], np.int32))
            return Parts(table[:, :3], polygons, {"normals": table[:, 3:]} if normals else {}), order + kind
    raise ValueError("its bytes are no vertices and faces in an order that is known")


def write(target: Path, parts: Parts, binary: str | None) -> list[str]:
    """Write a mesh, binary with numbers of that type, or as text; tell what it can't have."""
    places, number, data = by_points(parts)
    points, faces = parts.points[places], Polygons(number[parts.faces.corners], parts.faces.sizes)
    known = {"ST": data.get("uv"), "C": data.get("colors"), "N": data.get("normals")}
    counts = len(points), len(faces.sizes), 0
    lost = {*parts.vertex_data, *parts.face_data} - {PLACE}
    if binary:
        table = points if known["N"] is None else np.column_stack([points, known["N"]])
        rows = np.insert(faces.corners, faces.first, faces.sizes)
        numbers = [np.array(counts, f"{binary[0]}u4"), table.astype(binary), rows.astype(f"{binary[0]}u4")]
        word = "OFF BINARY\n" if known["N"] is None else "NOFF BINARY\n"
        target.write_bytes(word.encode() + b"".join(each.tobytes() for each in numbers))
        return sorted(lost - ({"normals"} & {*data}))
    word = "".join(word for word, values in known.items() if values is not None) + "OFF"
    columns = [values.astype(str) for values in (points, *reversed(known.values())) if values is not None]
    lines = [word, " ".join(map(str, counts)), *(" ".join(row) for row in np.column_stack(columns).tolist())]
    colours = parts.face_data.get("colors", np.empty((counts[1], 0))).astype(str).tolist()
    for row, tail in zip(faces.rows(), colours, strict=True):
        lines.append(" ".join(map(str, [len(row), *row.tolist(), *tail])))
    target.write_text("\n".join([*lines, ""]), encoding="utf-8")
    return sorted(lost - ({"normals", "colors", "uv"} & {*data}) - ({"colors"} & {*parts.face_data}))
