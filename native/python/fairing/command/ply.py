"""PLY files by plyfile: properties keep their names, order and types; elements that are not known stay."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import numpy as np

from fairing.objects.parts import PLACE, Data, Parts, Polygons, by_points, by_vertices

_GROUPS = {"points": ("x", "y", "z"), "normals": ("nx", "ny", "nz")}
_COLOURS = ("red", "green", "blue", "alpha")


def read(plyfile: Any, source: Path) -> tuple[Parts, Any]:
    """The mesh, and the file with what it says besides."""
    triangles = {"face": dict.fromkeys(("vertex_indices", "vertex_index"), 3)}  # read at once where all of them are
    try:
        file = plyfile.PlyData.read(str(source), known_list_len=triangles)
    except plyfile.PlyParseError:
        file = plyfile.PlyData.read(str(source))
    if "face" not in file:
        raise ValueError("it has no faces")
    data, face = _stored(file["vertex"]), file["face"]
    lists = {each.name: list(face[each.name]) for each in face.properties if _is_list(each)}
    rows = lists.get("vertex_indices") or lists.get("vertex_index") or next(iter(lists.values()))
    sizes, at_corners = np.array([len(row) for row in rows], np.int32), {}
    if "texcoord" in lists and [len(row) for row in lists["texcoord"]] == (2 * sizes).tolist():
        at_corners["uv"] = np.concatenate(lists["texcoord"]).reshape(-1, 2)
    faces = Polygons(np.concatenate(rows).astype(np.int32), sizes)
    return by_vertices(data.pop("points"), faces, (data, _stored(face)), at_corners), file


def _is_list(each: Any) -> bool:
    return hasattr(each, "len_dtype")


def _stored(element: Any) -> Data:
    """What is no list, by name; places and normals are one array each."""
    names = [each.name for each in element.properties if not _is_list(each)]
    data: Data = {name: element[name].astype(element[name].dtype.newbyteorder("=")) for name in names}
    for name, words in _GROUPS.items():
        if data.keys() >= {*words}:
            data[name] = np.column_stack([data.pop(each) for each in words])
    return data


def write(plyfile: Any, target: Path, parts: Parts, file: Any) -> list[str]:
    """Write a mesh, properties and their types as ``file`` has them, if any; tell what it can't have any more."""
    places, number, data = by_points(parts)
    lists = {"vertex_indices": Polygons(number[parts.faces.corners], parts.faces.sizes).rows()}
    if "uv" in parts.vertex_data and PLACE in parts.vertex_data:
        data = {name: values for name, values in data.items() if name != "uv"}
        uv = parts.vertex_data["uv"][parts.faces.corners].ravel()
        lists["texcoord"] = Polygons(uv, 2 * parts.faces.sizes).rows()
    others = {each.name: each for each in file.elements} if file is not None else {}
    vertex, face = others.pop("vertex", None), others.pop("face", None)
    if face is not None and "vertex_index" in face:
        lists = {name.replace("indices", "index"): rows for name, rows in lists.items()}
    made = [
        _element(plyfile, "vertex", _columns({"points": parts.points[places], **data}), vertex),
        _element(plyfile, "face", {**lists, **_columns(parts.face_data)}, face),
    ]
    stays = not others or len(places) >= vertex.count  # else what others say of vertices has no meaning
    # Never big-endian: plyfile writes single numbers beside lists the other way round.
    said = (file.text, "<", file.comments, file.obj_info) if file is not None else ()
    content = io.BytesIO()  # the target may be the file that is still mapped
    plyfile.PlyData(made + [*others.values()] * stays, *said).write(content)
    target.write_bytes(content.getvalue())
    gone = {each.name for element in (vertex, face) if element for each in element.properties if _is_list(each)}
    gone |= {*parts.vertex_data} - {*data, "uv", PLACE}
    return sorted((gone - {*lists}).union(() if stays else others))


def _columns(data: Data) -> dict[str, Any]:
    """Each property."""
    columns: dict[str, Any] = {}
    for name, values in data.items():
        flat = values.reshape(len(values), -1)
        own = [name] if flat.shape[1] == 1 else [f"{name}_{k}" for k in range(flat.shape[1])]
        names = _GROUPS.get(name) or (_COLOURS[: flat.shape[1]] if name == "colors" else own)
        columns |= dict(zip(names, flat.T, strict=True))
    return columns


def _element(plyfile: Any, name: str, columns: dict[str, Any], old: Any) -> Any:
    """An element with the order and the types of the old one's properties, as far as these hold the numbers."""
    known = {each.name: each for each in old.properties} if old else {}
    order = sorted(columns, key=lambda key: [*known, *columns].index(key))
    table: dict[str, Any] = {}
    lengths, kinds = {}, {}
    for key, rows in ((key, columns[key]) for key in order):
        if isinstance(rows, list) or rows.ndim == 2:
            lengths[key] = _kind(known[key].len_dtype if key in known else "u1", max(map(len, rows)))
            largest = np.concatenate(rows).max()
            kinds[key] = _kind(
                known[key].val_dtype if key in known else ["i4", "f4"][largest.dtype.kind == "f"], largest
            )
            table[key] = np.array([*rows, None], object)[:-1]
        else:
            code = (
                known[key].val_dtype if key in known else {"b1": "u1", "i8": "i4", "u8": "u4"}.get(rows.dtype.str[1:])
            )
            table[key] = rows.astype(code or rows.dtype)
    made = np.empty(len(table[order[0]]), [(key, values.dtype) for key, values in table.items()])
    for key, values in table.items():
        made[key] = values
    return plyfile.PlyElement.describe(made, name, len_types=lengths, val_types=kinds)


def _kind(kind: str, largest: Any) -> str:
    """The type, or a wider one that holds the largest number."""
    whole = np.dtype(kind).kind != "f"
    return next(each for each in (kind, "u1", "u2", "i4", "u4") if np.iinfo(each).max >= largest) if whole else kind
