"""OBJ files: objects, groups and materials stay, and so do values at corners."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing.command.corners import by_points, by_vertices
from fairing.objects.parts import PLACE, Data, Parts, Polygons

_STATE = {"o": "object", "g": "group", "usemtl": "material", "s": "smoothing"}
_CORNER = ("uv", "normals")


@dataclass
class Header:
    """What a file says besides."""

    folder: Path
    comments: list[str] = field(default_factory=list)
    libraries: list[str] = field(default_factory=list)
    words: list[str] = field(default_factory=lambda: [""])
    """Names of objects, groups and materials; data at faces has their numbers."""
    gone: set[str] = field(default_factory=set)
    """Statements that are not kept."""


def read(source: Path) -> tuple[Parts, Header]:
    """The mesh; data at faces: the numbers of what holds for each."""
    header = Header(source.parent)
    rows: dict[str, list[list[float]]] = {"v": [], "vt": [], "vn": []}
    corners: list[tuple[int, int, int]] = []
    sizes: list[int] = []
    state = dict.fromkeys(_STATE, 0)
    states: list[tuple[int, ...]] = []
    numbers = {"": 0}
    for word, rest in _statements(source):
        if word in rows:
            rows[word].append([float(each) for each in rest.split()])
        elif word in ("f", "fo"):
            face = [_corner(each, [len(values) for values in rows.values()]) for each in rest.split()]
            corners += face
            sizes.append(len(face))
            states.append(tuple(state.values()))
        elif word in state:
            state[word] = numbers.setdefault(rest, len(numbers))
        elif word == "mtllib":
            header.libraries.append(rest)
        else:
            header.gone.add(word)
    header.words = list(numbers)
    return _parts(rows, np.array(corners, np.int64).reshape(-1, 3), sizes, np.array(states, np.int32)), header


def _statements(source: Path) -> Iterator[tuple[str, str]]:
    text = source.read_bytes().decode("utf-8", "surrogateescape")
    for line in re.sub(r"\\[ \t]*\r?\n", " ", text).splitlines():
        word, _, rest = line.partition("#")[0].strip().replace("\t", " ").partition(" ")
        if word:
            yield word, rest.strip()


def _corner(word: str, counts: list[int]) -> tuple[int, int, int]:
    """Numbers from 0 of a corner's place, texture place and normal; −1 where it has none."""
    found = [-1, -1, -1]
    for k, each in enumerate(word.split("/")[:3]):
        if each:
            number = int(each)
            found[k] = number - 1 if number > 0 else counts[k] + number
            if number == 0 or found[k] < 0:
                raise ValueError(f"a face names {each}, which is not there")
    return found[0], found[1], found[2]


def _parts(
    rows: dict[str, list[list[float]]], corners: npt.NDArray[Any], sizes: list[int], states: npt.NDArray[Any]
) -> Parts:
    if not sizes or not rows["v"]:
        raise ValueError("it has no vertices, or no faces")
    width = min(map(len, rows["v"]))
    table = np.array([row[:width] for row in rows["v"]])
    of_points: Data = {"colors": table[:, 3:6]} if width >= 6 else {}
    at_corners: Data = {}
    for k, (word, size) in enumerate((("vt", 2), ("vn", 3)), start=1):
        if (corners[:, k] >= 0).any():
            values = np.array([[*row, 0.0][:size] for row in rows[word]] + [[np.nan] * size])
            at_corners[_CORNER[k - 1]] = values[np.where(corners[:, k] < 0, len(values) - 1, corners[:, k])]
    of_faces: Data = {name: states[:, k] for k, name in enumerate(_STATE.values()) if states[:, k].any()}
    polygons = Polygons(corners[:, 0].astype(np.int32), np.array(sizes, np.int32))
    return by_vertices(table[:, :3], polygons, (of_points, of_faces), at_corners)


def write(target: Path, parts: Parts, header: Header | None) -> list[str]:
    """Write a mesh, its faces by objects and groups; tell what it can't have."""
    known = header or Header(target.parent)
    places, number, _ = by_points(parts)
    table = parts.points[places]
    if "colors" in parts.vertex_data:
        colours = parts.vertex_data["colors"][places, :3]
        table = np.column_stack([table, colours / 255 if colours.dtype == np.uint8 else colours])
    lines = [*(f"mtllib {name}" for name in known.libraries), *_lines("v", table)]
    words = (number[parts.faces.corners] + 1).astype(str)
    for name, word in zip(_CORNER, ("vt", "vn"), strict=True):
        own = np.full(len(words), "", dtype="U12")
        if name in parts.vertex_data:
            values = parts.vertex_data[name][parts.faces.corners]
            there = np.isfinite(values).all(axis=1)
            kept, of = np.unique(values[there], axis=0, return_inverse=True)
            lines += _lines(word, kept)
            own[there] = (of.ravel() + 1).astype(str)
        words = np.char.add(np.char.add(words, "/"), own)
    lines += _faces(parts, [word.rstrip("/") for word in words.tolist()], known.words)
    target.write_bytes("\n".join([*lines, ""]).encode("utf-8", "surrogateescape"))
    _copy_materials(known, target.parent)
    written = {"colors", PLACE, *_CORNER, *(_STATE.values() if header else ())}
    return sorted(known.gone | ({*parts.vertex_data, *parts.face_data} - written))


def _lines(word: str, rows: npt.NDArray[Any]) -> list[str]:
    return [f"{word} {' '.join(map(repr, row))}" for row in rows.tolist()]


def _faces(parts: Parts, corners: list[str], words: list[str]) -> list[str]:
    """The lines of all faces, those together for which the same object, group and material hold."""
    names = {word: parts.face_data[name] for word, name in _STATE.items() if name in parts.face_data and len(words) > 1}
    state = np.column_stack([np.zeros(len(parts.faces.sizes), int), *names.values()])
    kinds, first, of = np.unique(state, axis=0, return_index=True, return_inverse=True)
    lines, now = [], dict.fromkeys(names, 0)
    for kind in np.argsort(first).tolist():
        for word, value in zip(names, kinds[kind, 1:].tolist(), strict=True):
            lines += [f"{word} {words[value]}"] if value != now[word] else []
            now[word] = value
        for face in np.flatnonzero(of.ravel() == kind).tolist():
            begin = parts.faces.first[face]
            lines.append("f " + " ".join(corners[begin : begin + parts.faces.sizes[face]]))
    return lines


def _copy_materials(header: Header, folder: Path) -> None:
    """Beside a file in another folder: its materials, and the pictures that these name."""
    if header.folder.resolve() == folder.resolve():
        return
    names = [name for name in header.libraries if (header.folder / name).is_file()]
    for name in list(names):
        text = (header.folder / name).read_text(encoding="utf-8", errors="replace")
        names += re.findall(r"^[ \t]*(?:map_\w+|bump|disp|decal|norm|refl)[ \t].*?([^\s]+)[ \t]*$", text, re.M)
    for name in names:
        if (header.folder / name).is_file() and ".." not in Path(name).parts and not Path(name).is_absolute():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(header.folder / name, folder / name)
