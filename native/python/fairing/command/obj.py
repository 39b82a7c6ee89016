"""OBJ files: polygons, objects, groups, materials and values at corners stay, which no library keeps together."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing.objects.parts import PLACE, Data, Parts, Polygons, by_points, by_vertices

_STATE = {"o": "object", "g": "group", "usemtl": "material", "s": "smoothing"}
_CORNER = {"vt": ("uv", 2), "vn": ("normals", 3)}


@dataclass
class Header:
    """What a file says besides."""

    libraries: list[Path] = field(default_factory=list)
    """Files of materials."""
    words: list[str] = field(default_factory=lambda: [""])
    """Names of objects, groups and materials; data at faces has their numbers."""
    gone: set[str] = field(default_factory=set)
    """Statements that are not kept."""


def read(_: Any, source: Path) -> tuple[Parts, Header]:
    """The mesh; data at faces: the numbers of what holds for each."""
    header = Header()
    rows: dict[str, list[list[float]]] = {"v": [], "vt": [], "vn": []}
    corners: list[list[int]] = []
    sizes: list[int] = []
    state, states = dict.fromkeys(_STATE, 0), []
    numbers = {"": 0}
    text = source.read_bytes().decode("utf-8", "surrogateescape")
    for line in re.sub(r"\\[ \t]*\r?\n", " ", text).splitlines():
        word, *rest = line.partition("#")[0].split() or [""]
        if word in rows:
            rows[word].append([float(each) for each in rest])
        elif word in ("f", "fo"):
            counts = [len(values) for values in rows.values()]
            corners += [_corner(each, counts) for each in rest]
            sizes.append(len(rest))
            states.append([*state.values()])
        elif word in state:
            state[word] = numbers.setdefault(" ".join(rest), len(numbers))
        elif word == "mtllib":
            header.libraries.append(source.parent.resolve() / " ".join(rest))
        elif word:
            header.gone.add(word)
    header.words = list(numbers)
    return _parts(rows, np.array(corners), np.array(sizes, np.int32), np.array(states, np.int32)), header


def _corner(word: str, counts: list[int]) -> list[int]:
    """Numbers from 0 of a corner's place, texture place and normal; −1 where it has none."""
    given = [int(each or 0) for each in f"{word}//".split("/")[:3]]
    found = [number - 1 if number >= 0 else count + number for number, count in zip(given, counts, strict=True)]
    if not 0 <= found[0] < 2**31 or min(found) < -1:
        raise ValueError(f"a face names {word}, which is not there")
    return found


def _parts(rows: dict[str, Any], corners: npt.NDArray[Any], sizes: npt.NDArray[Any], states: npt.NDArray[Any]) -> Parts:
    if not len(sizes) or not rows["v"]:
        raise ValueError("it has no vertices, or no faces")
    width = min(map(len, rows["v"]))
    table = np.array([row[:width] for row in rows["v"]])
    at_corners: Data = {}
    for k, (word, (name, size)) in enumerate(_CORNER.items(), start=1):
        if (corners[:, k] >= 0).any():  # the last row is that of a corner without a value: number −1
            at_corners[name] = np.array([[*row, 0.0][:size] for row in rows[word]] + [[np.nan] * size])[corners[:, k]]
    of_faces: Data = {name: states[:, k] for k, name in enumerate(_STATE.values()) if states[:, k].any()}
    of_points: Data = {"colors": table[:, 3:6]} if width >= 6 else {}
    faces = Polygons(corners[:, 0].astype(np.int32), sizes)
    return by_vertices(table[:, :3], faces, (of_points, of_faces), at_corners)


def write(_: Any, target: Path, parts: Parts, header: Header | None) -> list[str]:
    """Write a mesh, its faces by objects and groups; tell what it can't have."""
    known = header or Header()
    places, number, _ = by_points(parts)
    table = parts.points[places]
    if "colors" in parts.vertex_data:
        colours = parts.vertex_data["colors"][places, :3]
        table = np.column_stack([table, colours / 255 if colours.dtype == np.uint8 else colours])
    lines = [f"mtllib {_from(target.parent.resolve(), place)}" for place in known.libraries] + _lines("v", table)
    words = (number[parts.faces.corners] + 1).astype(str)
    for word, (name, _) in _CORNER.items():
        own = np.full(len(words), "", dtype="U12")
        if name in parts.vertex_data:
            values = parts.vertex_data[name][parts.faces.corners]
            there = np.isfinite(values).all(axis=1)
            kept, of = np.unique(values[there], axis=0, return_inverse=True)
            lines += _lines(word, kept)
            own[there] = (of.ravel() + 1).astype(str)
        words = np.char.add(np.char.add(words, "/"), own)
    faces = np.split(np.char.rstrip(words, "/"), parts.faces.first[1:])
    names = {word: parts.face_data[name] for word, name in _STATE.items() if header and name in parts.face_data}
    states = np.column_stack([np.zeros(len(faces), int), *names.values()])
    now = dict.fromkeys(names, 0)
    for face in np.lexsort(states.T[::-1]).tolist():  # those together for which the same holds
        for word, value in zip(names, states[face, 1:].tolist(), strict=True):
            lines += [f"{word} {known.words[value]}"] if value != now[word] else []
            now[word] = value
        lines.append("f " + " ".join(faces[face]))
    target.write_bytes("\n".join([*lines, ""]).encode("utf-8", "surrogateescape"))
    written = {"colors", PLACE, *(name for name, _ in _CORNER.values()), *(_STATE.values() if header else ())}
    return sorted(known.gone | ({*parts.vertex_data, *parts.face_data} - written))


def _lines(word: str, rows: npt.NDArray[Any]) -> list[str]:
    return [f"{word} {' '.join(map(repr, row))}" for row in rows.tolist()]


def _from(folder: Path, place: Path) -> str:
    """How a file in the folder names another one."""
    if not place.is_file():
        return place.name
    return os.path.relpath(place, folder) if place.anchor == folder.anchor else str(place)
