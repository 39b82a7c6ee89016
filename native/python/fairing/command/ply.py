"""PLY files: properties of any type, in text or binary; what is not known stays in the file as it is."""

from __future__ import annotations

import itertools
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing.command.corners import by_points, by_vertices
from fairing.objects.parts import PLACE, Data, Parts, Polygons

Array = npt.NDArray[Any]
_TYPES = {
    "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4",
    "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4",
    "int64": "i8", "uint64": "u8", "float32": "f4", "float64": "f8",
}  # fmt: skip
_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
_GROUPS = {  # properties that make one array
    "x y z": "points", "nx ny nz": "normals", "red green blue alpha": "colors", "red green blue": "colors",
    "r g b": "colors", "diffuse_red diffuse_green diffuse_blue": "colors", "s t": "uv", "u v": "uv",
    "texture_u texture_v": "uv",
}  # fmt: skip


@dataclass
class Property:
    name: str
    kind: str
    count: str
    """The type of a list's length; empty where each row has one value."""
    values: Array = field(default_factory=lambda: np.empty(0))
    """Of all rows, one after the other."""
    sizes: Array = field(default_factory=lambda: np.empty(0, np.int64))
    """(n,) how many each row has."""


@dataclass
class Element:
    name: str
    rows: int = 0
    properties: list[Property] = field(default_factory=list)


@dataclass
class Header:
    form: str = "binary_little_endian"
    comments: list[str] = field(default_factory=list)
    elements: list[Element] = field(default_factory=list)

    def element(self, name: str) -> Element:
        return next((each for each in self.elements if each.name == name), Element(name))


def read(source: Path) -> tuple[Parts, Header]:
    """The mesh, and what the file says besides."""
    raw = source.read_bytes()
    end = re.search(rb"[\r\n][ \t]*end_header[ \t]*(\r\n|\n|\r|$)", raw)
    if not raw.startswith(b"ply") or end is None:
        raise ValueError("it is no PLY file, or its header has no end")
    header = _header(raw[: end.start()].decode("utf-8", "replace"))
    body, at = raw[end.end() :], 0
    if header.form == "ascii":
        body = np.array(body.split(), dtype=np.float64).tobytes()
    for element in header.elements:
        at = _read_rows(element, body, at, _ORDERS[header.form])
    return _parts(header), header


def _header(text: str) -> Header:
    header = Header("")
    for line in re.split(r"[\r\n]+", text)[1:]:
        words = line.split()
        if words[:1] in (["comment"], ["obj_info"]):
            header.comments.append(line)
        elif words[:1] == ["format"]:
            header.form = words[1]
        elif words[:1] == ["element"]:
            header.elements.append(Element(words[1], int(words[2])))
        elif words[:1] == ["property"]:
            count = words[2] if words[1] == "list" else ""
            header.elements[-1].properties.append(Property(words[-1], words[-2], count))
        elif words:
            raise ValueError(f"its header has a line without a meaning: {line!r}")
    kinds = {kind for each in header.elements for one in each.properties for kind in (one.kind, one.count)}
    if odd := [*({header.form} - {*_ORDERS}), *(kinds - {*_TYPES, ""})]:
        raise ValueError(f"its header says {odd[0]!r}, which is not known")
    return header


def _read_rows(element: Element, body: bytes, at: int, order: str) -> int:
    """Read an element's rows from a place on, in runs whose lists are as long; return where they end."""
    runs: list[tuple[Array, list[int]]] = []
    left, window = element.rows if element.properties else 0, 1
    while left:
        layout, sizes = _layout(element, body, at, order)
        block = np.frombuffer(body, layout, min(left, window, (len(body) - at) // layout.itemsize), at)
        if not len(block):
            raise ValueError(f"it ends before its last {element.name}")
        alike = np.all([block[name] == block[name][0] for name in layout.names or () if name[0] == "n"], axis=0)
        run = len(block) if np.all(alike) else int(np.argmin(alike))
        runs.append((block[:run], sizes))
        window, left, at = 2 * run, left - run, at + run * layout.itemsize
    for k, each in enumerate(element.properties):
        kind = np.dtype(_TYPES[each.kind])
        each.values = np.concatenate([np.empty(0, kind), *(run[f"v{k}"].ravel() for run, _ in runs)]).astype(kind)
        each.sizes = np.repeat([sizes[k] for _, sizes in runs], [len(run) for run, _ in runs]).astype(np.int64)
    return at


def _layout(element: Element, body: bytes, at: int, order: str) -> tuple[np.dtype[Any], list[int]]:
    """The row that begins at a place, and the sizes in it; each number of a text has eight bytes."""
    fields: list[Any] = []
    sizes = []
    for k, each in enumerate(element.properties):
        sizes.append(1)
        if each.count:
            begin = at + np.dtype(fields).itemsize
            fields.append((f"n{k}", order + _TYPES[each.count] if order else "f8"))
            sizes[-1] = int(np.frombuffer(body[begin : begin + 8], fields[-1][1], 1)[0])
            if not 0 <= sizes[-1] <= len(body):
                raise ValueError(f"a list of {element.name} has {sizes[-1]} entries")
        fields.append((f"v{k}", order + _TYPES[each.kind] if order else "f8", (sizes[-1],)))
    return np.dtype(fields), sizes


def _stored(element: Element) -> Data:
    """What is no list, by name; properties that belong together are one array."""
    known = {each.name: each.values for each in element.properties if not each.count}
    data: Data = {}
    for words, name in _GROUPS.items():
        if name not in data and known.keys() >= {*words.split()}:
            data[name] = np.column_stack([known.pop(each) for each in words.split()])
    return data | known


def _parts(header: Header) -> Parts:
    at_points, face = _stored(header.element("vertex")), header.element("face")
    lists = {each.name: each for each in face.properties if each.count and face.rows}
    rows = lists.get("vertex_indices") or lists.get("vertex_index") or next(iter(lists.values()), None)
    strips = [each.values for each in header.element("tristrips").properties if each.count]
    if "points" not in at_points or not (rows or strips):
        raise ValueError("it has no vertices, or no faces")
    points = at_points.pop("points")
    if not rows:
        return Parts(points, _from_strips(strips[0].astype(np.int64)), at_points)
    at_corners, uv = {}, lists.get("texcoord")
    if uv and np.array_equal(uv.sizes, 2 * rows.sizes):
        at_corners["uv"] = uv.values.reshape(-1, 2)
    faces = Polygons(rows.values.astype(np.int32), rows.sizes.astype(np.int32))
    return by_vertices(points, faces, (at_points, _stored(face)), at_corners)


def _from_strips(numbers: Array) -> Polygons:
    """Strips of triangles, each ended by −1."""
    triangles = []
    for strip in np.split(numbers, np.flatnonzero(numbers < 0)):
        strip = strip[strip >= 0]
        rows = (
            np.lib.stride_tricks.sliding_window_view(strip, 3).copy() if len(strip) > 2 else np.empty((0, 3), np.int64)
        )
        rows[1::2, :2] = rows[1::2, 1::-1]
        triangles.append(rows[(rows[:, 0] != rows[:, 1]) & (rows[:, 1] != rows[:, 2]) & (rows[:, 2] != rows[:, 0])])
    return Polygons.of(np.concatenate(triangles))


def write(target: Path, parts: Parts, header: Header | None) -> list[str]:
    """Write a mesh: form, properties and their types are those of ``header``; tell what it can't have any more."""
    known = header or Header()
    places, number, data = by_points(parts)
    at_points = {name: values for name, values in data.items() if name != "uv" or PLACE not in parts.vertex_data}
    lists = [Property("vertex_indices", "int", "uchar", number[parts.faces.corners], parts.faces.sizes)]
    if "uv" in parts.vertex_data and "uv" not in at_points:
        uv = parts.vertex_data["uv"][parts.faces.corners].ravel()
        lists.append(Property("texcoord", "float", "uchar", uv, 2 * parts.faces.sizes))
    vertex, face = known.element("vertex"), known.element("face")
    out = [
        _element(vertex, _columns({"points": parts.points[places], **at_points}, vertex)),
        _element(face, [*lists, *_columns(parts.face_data, face)]),
    ]
    others = [each for each in known.elements if each.name not in ("vertex", "face", "tristrips")]
    stays = len(places) >= vertex.rows  # else what others say of vertices has no meaning
    lines = ["ply", f"format {known.form} 1.0", *known.comments]
    for element in out + others * stays:
        lines.append(f"element {element.name} {element.rows}")
        for each in element.properties:
            lines.append(f"property {f'list {each.count} ' if each.count else ''}{each.kind} {each.name}")
    body = b"".join(_written_rows(element, _ORDERS[known.form]) for element in out + others * stays)
    target.write_bytes("\n".join([*lines, "end_header\n"]).encode() + body)
    gone = {each.name for each in (*vertex.properties, *face.properties) if each.count}
    gone |= {*parts.vertex_data} - {*at_points, "uv", PLACE}
    gone -= {"vertex_index", *(each.name for each in lists)}
    return sorted(gone | {each.name for each in others * (not stays)})


def _columns(data: Data, old: Element) -> list[Property]:
    """Each property; arrays are parted as they were in the file, or as is usual."""
    there = {each.name for each in old.properties}
    columns = []
    for name, values in data.items():
        flat = values.reshape(len(values), -1)
        usual = [words.split() for words, group in _GROUPS.items() if group == name]
        usual = [words for words in usual if len(words) == flat.shape[1]]
        own = [name] if flat.shape[1] == 1 else [f"{name}_{k}" for k in range(flat.shape[1])]
        names = next((words for words in usual if {*words} <= there), usual[0] if usual else own)
        code = values.dtype.str[1:].replace("b1", "u1")
        kind = next((kind for kind, known in _TYPES.items() if known == code), "int")
        columns += [Property(each, kind, "", flat[:, k], np.ones(len(flat), int)) for k, each in enumerate(names)]
    return columns


def _element(old: Element, properties: list[Property]) -> Element:
    """An element whose properties have the order and the types of the old one's, as far as these hold the numbers."""
    known = {each.name: each for each in old.properties}
    for each in properties:
        if before := known.get(each.name) or known.get(each.name.replace("indices", "index")):
            each.name, each.kind, each.count = before.name, before.kind, before.count
        if each.count:
            each.kind = _wide_enough(each.kind, each.values)
            each.count = _wide_enough(each.count, each.sizes)
    names = [each.name for each in old.properties]
    properties = sorted(properties, key=lambda each: names.index(each.name) if each.name in names else len(names))
    return Element(old.name, len(properties[0].sizes), properties)


def _wide_enough(kind: str, values: Array) -> str:
    dtype = np.dtype(_TYPES[kind])
    return kind if dtype.kind == "f" or values.max(initial=0) <= np.iinfo(dtype).max else "int"


def _written_rows(element: Element, order: str) -> bytes:
    """The rows, in runs whose lists are as long."""
    if not element.properties or not element.rows:
        return b""
    sizes = np.column_stack([each.sizes for each in element.properties])
    ends = np.pad(np.cumsum(sizes, axis=0), ((1, 0), (0, 0)))
    cuts = [0, *(np.flatnonzero((np.diff(sizes, axis=0) != 0).any(axis=1)) + 1), element.rows]
    written = []
    for begin, end in itertools.pairwise(cuts):
        columns: list[Array] = []
        for k, each in enumerate(element.properties):
            part = each.values[ends[begin, k] : ends[end, k]].reshape(end - begin, -1)
            if each.count:
                columns.append(np.full((end - begin, 1), sizes[begin, k], (order or "=") + _TYPES[each.count]))
            columns.append(np.ascontiguousarray(part, (order or "=") + _TYPES[each.kind]))
        if order:
            written.append(np.concatenate([each.view(np.uint8) for each in columns], axis=1).tobytes())
        else:
            words = np.concatenate([each.astype(str) for each in columns], axis=1).tolist()
            written.append("".join(" ".join(row) + "\n" for row in words).encode())
    return b"".join(written)
