"""STL files, in text or binary: corners in one place are one vertex."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from fairing._types import FloatArray
from fairing.objects.parts import Data, Parts, Polygons, alike

_ROW = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_SOLID = re.compile(rb"^[ \t]*solid\b[ \t]*([^\r\n]*)", re.MULTILINE | re.IGNORECASE)
_CORNER = re.compile(rb"\bvertex\s+(\S+)\s+(\S+)\s+(\S+)", re.IGNORECASE)


@dataclass
class Header:
    binary: bytes = b""
    """The first 80 bytes; of text there are none."""
    names: tuple[str, ...] = ("",)
    """Of the solids in a text."""


def read(source: Path) -> tuple[Parts, Header]:
    """The mesh; data at faces: the solid, and the attribute of binary files where any is not zero."""
    raw = source.read_bytes()
    count = int(np.frombuffer(raw, "<u4", 1, 80)[0]) if len(raw) >= 84 else -1
    text = raw.lstrip()[:5].lower() == b"solid" and _CORNER.search(raw) is not None
    if not text or len(raw) == 84 + 50 * count:
        there = (len(raw) - 84) // 50
        if there < max(count, 1):
            raise ValueError(f"it announces {max(count, 0)} triangles and has {max(there, 0)}")
        rows = np.frombuffer(raw, _ROW, count or there, 84)
        attribute = {"attribute": rows["attribute"].copy()} if rows["attribute"].any() else {}
        return _joined(rows["corners"].reshape(-1, 3).astype(np.float64), attribute), Header(raw[:80])
    starts = [each.start() for each in _SOLID.finditer(raw)]
    corners, facets = list(_CORNER.finditer(raw)), re.findall(rb"\bfacet\s+normal\b", raw, re.IGNORECASE)
    if len(corners) != 3 * len(facets) or b"endsolid" not in raw.lower():
        raise ValueError("it has a facet without three corners, or ends too early")
    places = np.array([each.groups() for each in corners], dtype=np.float64)
    solid = np.searchsorted(starts, [each.start() for each in corners[::3]]) - 1
    names = tuple(each.group(1).strip().decode("utf-8", "replace") for each in _SOLID.finditer(raw))
    return _joined(places, {"solid": solid} if len(names) > 1 else {}), Header(b"", names)


def _joined(corners: FloatArray, of_faces: Data) -> Parts:
    first, number = alike(corners)
    return Parts(corners[first], Polygons.of(number.reshape(-1, 3)), {}, of_faces)


def write(target: Path, parts: Parts, header: Header | None) -> list[str]:
    """Write a mesh, binary or as text as ``header`` has it; tell what it can't have."""
    known, made = header or Header(b"\0" * 80), parts.in_triangles()
    corners = made.points[made.own]
    crosses = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = crosses / np.maximum(np.linalg.norm(crosses, axis=1), 1e-300)[:, None]
    if known.binary:
        rows = np.zeros(len(corners), _ROW)
        rows["normal"], rows["corners"] = normals, corners
        rows["attribute"] = made.face_data.get("attribute", 0)
        target.write_bytes(known.binary + np.array([len(rows)], "<u4").tobytes() + rows.tobytes())
    else:
        solid = made.face_data.get("solid", np.zeros(len(corners), int))
        lines = []
        for number, name in enumerate(known.names):
            lines.append(f"solid {name}")
            for k in np.flatnonzero(solid == number).tolist():
                lines += [f"facet normal {_words(normals[k])}", "outer loop"]
                lines += [f"vertex {_words(corner)}" for corner in corners[k]]
                lines += ["endloop", "endfacet"]
            lines.append(f"endsolid {name}")
        target.write_text("\n".join([*lines, ""]), encoding="utf-8")
    return sorted({*made.vertex_data} | {*made.face_data} - {"attribute", "solid"})


def _words(values: FloatArray) -> str:
    return " ".join(map(repr, values.tolist()))
