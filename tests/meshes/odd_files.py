"""Files of one shape as programs write them: an open box of five quads, and files that can't be read."""

import struct
from collections.abc import Callable, Iterable, Sequence

CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
QUADS = [(0, 3, 2, 1), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
TRIANGLES = [t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))]
_KINDS = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d"}
_KINDS |= {"int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I", "float32": "f"}


def off(points: Iterable[Sequence[float]], faces: Iterable[Sequence[int]]) -> str:
    """A text for arrays."""
    places, rows = [" ".join(map(repr, map(float, row))) for row in points], [" ".join(map(str, row)) for row in faces]
    corners = [f"{row.count(' ') + 1} {row}" for row in rows]
    return "\n".join(["OFF", f"{len(places)} {len(rows)} 0", *places, *corners, ""])


def _rows(rows: list[tuple[float, ...]], form: str = "%g", end: str = "\n") -> str:
    return "".join(" ".join(form % x for x in row) + end for row in rows)


def _sized(faces: list[tuple[int, ...]], end: str = "\n", tail: str = "") -> str:
    return "".join(f"{len(f)} {' '.join(map(str, f))}{tail}{end}" for f in faces)


def ply(
    form: str = "ascii", count: str = "uchar", index: str = "int", place: str = "float", end: str = "\n",
    before: tuple[str, ...] = (), behind: tuple[str, ...] = (), of_faces: tuple[str, ...] = (),
    faces: list[tuple[int, ...]] = QUADS, name: str = "vertex_indices", extra: str = "",
) -> bytes:  # fmt: skip
    """`before`, `behind`: further properties of vertices, `of_faces` of faces ("type name"); all of value 1."""
    lines = ["ply", f"format {form} 1.0", "comment made", "obj_info nothing", f"element vertex {len(CORNERS)}"]
    lines += [f"property {each}" for each in before] + [f"property {place} {axis}" for axis in "xyz"]
    lines += [f"property {each}" for each in behind]
    lines += [f"element face {len(faces)}", f"property list {count} {index} {name}"]
    lines += [f"property {each}" for each in of_faces]
    lines += [extra] if extra else []
    head = end.join([*lines, "end_header", ""]).encode()
    kinds = [_KINDS[each.split()[0]] for each in before] + [_KINDS[place]] * 3
    kinds += [_KINDS[each.split()[0]] for each in behind]
    values = [(1,) * len(before) + corner + (1,) * len(behind) for corner in CORNERS]
    if form == "ascii":
        rows = _rows(values, "%g", end) + _sized(faces, end, " 1" * len(of_faces))
        return head + rows.encode()
    order = "<" if "little" in form else ">"
    numbers = [each for row in values for each in zip(kinds, row, strict=True)]
    body = b"".join(struct.pack(order + k, x if k in "fd" else int(x)) for k, x in numbers)
    tails = b"".join(struct.pack(order + _KINDS[each.split()[0]], 1) for each in of_faces)
    for face in faces:
        body += struct.pack(order + _KINDS[count], len(face))
        body += struct.pack(f"{order}{len(face)}{_KINDS[index]}", *face) + tails
    return head + body


def _off(word: str = "OFF\n", counts: str = "8 5 0\n", vertex: str = "", face: str = "", end: str = "\n") -> bytes:
    rows = "".join(" ".join(map(str, corner)) + vertex + end for corner in CORNERS)
    return (word + counts + rows + _sized(QUADS, end, face)).encode()


def _obj(
    corner: Callable[[int], str] = str, before: str = "", head: str = "", end: str = "\n", face: str = "f",
    behind: str = "",
) -> bytes:  # fmt: skip
    """`corner`: how vertex number 1 … 8 is named; `before`: lines between vertices and faces; `behind`: each vertex."""
    places = "".join(f"v {x} {y} {z}{behind}{end}" for x, y, z in CORNERS)
    return (
        head + places + before + "".join(f"{face} {' '.join(corner(v + 1) for v in q)}{end}" for q in QUADS)
    ).encode()


def _stl(end: str = "\n", name: str = "box", upper: bool = False, indent: str = " ", solids: int = 1) -> bytes:
    text = ""
    step = len(TRIANGLES) // solids
    for k in range(solids):
        text += f"solid {name}{k or ''}{end}"
        for t in TRIANGLES[k * step : (k + 1) * step]:
            text += f"{indent}facet normal 0 0 1{end}{indent}{indent}outer loop{end}"
            text += "".join(f"{indent * 3}vertex {' '.join(map(str, CORNERS[v]))}{end}" for v in t)
            text += f"{indent * 2}endloop{end}{indent}endfacet{end}"
        text += f"endsolid {name}{k or ''}{end}"
    return (text.upper() if upper else text).encode()


def _binary_stl(head: bytes = b"", attribute: int = 0) -> bytes:
    rows = b"".join(
        struct.pack("<12fH", 0, 0, 0, *(x for v in t for x in CORNERS[v]), attribute) for t in TRIANGLES
    )  # fmt: skip
    return head.ljust(80, b"\0") + struct.pack("<I", len(TRIANGLES)) + rows


def good() -> dict[str, bytes]:
    """Files by names; all of them are the box."""
    normals, bytes_ = ("float nx", "float ny", "float nz"), ("uchar red", "uchar green", "uchar blue")
    files = {f"{form}_{count}_{index}.ply": ply(form, count, index) for form, count, index in [
        ("ascii", "uchar", "int"), ("ascii", "uint8", "int32"), ("ascii", "int", "uint"), ("ascii", "char", "uchar"),
        ("binary_little_endian", "uchar", "int"), ("binary_little_endian", "uchar", "uint"),
        ("binary_little_endian", "int", "int"), ("binary_little_endian", "ushort", "short"),
        ("binary_little_endian", "uint8", "uint16"), ("binary_little_endian", "char", "uchar"),
        ("binary_big_endian", "uchar", "int"),
        ("binary_big_endian", "int", "ushort"), ("binary_big_endian", "uint8", "uint32"), ("ascii", "float", "float"),
    ]}  # fmt: skip
    mixed = [QUADS[0], *TRIANGLES[2:6], QUADS[3], QUADS[4]]
    for form in ("ascii", "binary_little_endian", "binary_big_endian"):
        files |= {
            f"{form}_double.ply": ply(form, place="double"),
            f"{form}_normals.ply": ply(form, behind=normals),
            f"{form}_colours.ply": ply(form, behind=(*normals, *bytes_, "uchar alpha")),
            f"{form}_before.ply": ply(form, before=("float confidence", "short label")),
            f"{form}_faces.ply": ply(form, of_faces=("int flags", "uchar red", "uchar green", "uchar blue")),
            f"{form}_mixed.ply": ply(form, faces=mixed),
            f"{form}_index.ply": ply(form, name="vertex_index"),
            f"{form}_returns.ply": ply(form, end="\r\n"),
            f"{form}_no_edges.ply": ply(form, extra="element edge 0\nproperty int vertex1\nproperty int vertex2"),
        }
    files |= {
        "old_returns.ply": ply(end="\r"),
        "upper_name.PLY": ply(),
        "plain.off": _off(),
        "one_line.off": _off("OFF 8 5 0\n", ""),
        "two_counts.off": _off(counts="8 5\n"),
        "comments.off": _off("# made\nOFF # here\n", "\n# counts\n8 5 12 # three\n\n"),
        "returns.off": _off("OFF\r\n", "8 5 0\r\n", end="\r\n"),
        "tabs.off": _off().replace(b" ", b"\t"),
        "trailing.off": _off(vertex="  ", face=" \t"),
        "bytes.off": _off("COFF\n", vertex=" 255 0 0 255"),
        "three_bytes.off": _off("COFF\n", vertex=" 255 0 0"),
        "floats.off": _off("COFF\n", vertex=" 0.5 0.25 1.0 1.0"),
        "colours_unannounced.off": _off(vertex=" 10 20 30"),
        "normals.off": _off("NOFF\n", vertex=" 0 0 1"),
        "normals_colours.off": _off("CNOFF\n", vertex=" 0 0 1 9 8 7 255"),
        "letters_turned.off": _off("NCOFF\n", vertex=" 0 0 1 9 8 7 255"),
        "texture.off": _off("STOFF\n", vertex=" 0.5 0.25"),
        "everything.off": _off("STCNOFF\n", vertex=" 0 0 1 9 8 7 255 0.5 0.25"),
        "four.off": _off("4OFF\n", vertex=" 1"),
        "face_bytes.off": _off(face="  255 0 0"),
        "face_floats.off": _off(face=" 0.5 0.5 0.5 1.0"),
        "face_index.off": _off(face=" 3"),
        "plain.obj": _obj(),
        "texture.obj": _obj(lambda v: f"{v}/1", "vt 0.5 0.5\n"),
        "normals.obj": _obj(lambda v: f"{v}//1", "vn 0 0 1\n"),
        "both.obj": _obj(lambda v: f"{v}/1/1", "vt 0.5 0.5 0\nvn 0 0 1\n"),
        "empty_slash.obj": _obj(lambda v: f"{v}/"),
        "negative.obj": _obj(lambda v: str(v - 9)),
        "negative_normals.obj": _obj(lambda v: f"{v - 9}//-1", "vn 0 0 1\n"),
        "returns.obj": _obj(end="\r\n"),
        "comments.obj": _obj(str, "# faces\n\n   # and more\ng a b\ns off\n", "# made\n\nmtllib no such.mtl\no box\n"),
        "tabs.obj": _obj().replace(b" ", b"\t"),
        "continued.obj": _obj().replace(b"f 1 4 ", b"f 1 4 \\\n "),
        "fo.obj": _obj(face="fo"),
        "rgb.obj": _obj(behind=" 1 .5 0"),
        "weights.obj": _obj(behind=" 1.0"),
        "points_lines.obj": _obj(before="p 1\nl 1 2 3\nusemtl none\nvp 0.1 0.2\n"),
        "latin.obj": _obj(head="o caf\xe9\n").decode().encode("latin-1"),
        "text.stl": _stl(),
        "upper.stl": _stl(upper=True),
        "returns.stl": _stl(end="\r\n", indent="\t"),
        "no_name.stl": _stl(name=""),
        "long_name.stl": _stl(name="a box, exported: 10 facets (vertex, facet)"),
        "two_solids.stl": _stl(solids=2),
        "binary.stl": _binary_stl(),
        "binary_solid.stl": _binary_stl(b"solid box of another program"),
        "binary_facet.stl": _binary_stl(b"solid facet normal"),
        "binary_attribute.stl": _binary_stl(attribute=31),
    }  # fmt: skip
    line, twice, lone = (0, 1), (4, 4, 5), "v 9 9 9\n"
    files |= {
        "a_line.ply": ply(faces=[*QUADS, line]),
        "a_line_binary.ply": ply("binary_little_endian", faces=[line, *QUADS]),
        "a_line.off": _off(counts="8 6 0\n") + b"2 0 1\n",
        "a_line.obj": _obj() + b"f 1 2\n",
        "twice.ply": ply(faces=[*QUADS, twice]),
        "twice.off": _off(counts="8 6 0\n") + b"3 4 4 5\n",
        "twice.obj": _obj() + b"f 5 5 6\n",
        "lone_vertex.obj": _obj(before=lone),
        "late_vertices.obj": _obj(lambda v: str(v)) + b"v 5 5 5\ng end\n",
        "wedges.ply": _wedges("ascii"),
        "wedges_binary.ply": _wedges("binary_little_endian"),
    }
    return files


def _wedges(form: str) -> bytes:
    """Places in an image at the corners of faces."""
    head, _, body = ply(form).partition(b"end_header\n")
    head = head.replace(b"vertex_indices\n", b"vertex_indices\nproperty list uchar float texcoord\n")
    if form == "ascii":
        lines = body.decode().splitlines()
        lines[8:] = [line + " 8 0 0 1 0 1 1 0 1" for line in lines[8:]]
        return head + b"end_header\n" + "\n".join([*lines, ""]).encode()
    at, tail = 8 * 12, struct.pack("<B8f", 8, 0, 0, 1, 0, 1, 1, 0, 1)
    rows = [body[at + 17 * k : at + 17 * (k + 1)] + tail for k in range(5)]
    return head + b"end_header\n" + body[:at] + b"".join(rows)


def broken() -> dict[str, bytes]:
    """Files that hold no mesh, or only a part of one."""
    whole = ply("binary_little_endian")
    return {
        "empty.ply": b"", "empty.off": b"", "empty.obj": b"", "empty.stl": b"", "empty.glb": b"", "empty.vtk": b"",
        "text.ply": b"hello\n", "text.off": b"hello\n", "text.obj": b"hello\n", "text.stl": b"hello\n",
        "text.glb": b"hello\n", "text.vtk": b"hello\n", "head.ply": whole[:60], "short.ply": whole[:-7],
        "short_text.ply": ply()[:-20], "points.ply": ply(faces=[]), "no_format.ply": ply("binary_odd_endian"),
        "type.ply": ply().replace(b"uchar", b"byte9"), "range.ply": ply(faces=[(0, 1, 99)]),
        "range_off.off": _off().replace(b"4 0 3 2 1", b"4 0 3 2 99"), "short.off": _off()[:60],
        "words.off": _off().replace(b"0 1 1", b"0 x 1"), "zero.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n",
        "range.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "points.obj": b"v 0 0 0\nv 1 0 0\n",
        "short.stl": _binary_stl()[:100], "text_cut.stl": _stl()[:200], "unknown.xyz": b"0 0 0\n",
        "noise.ply": bytes(range(256)) * 9,
        "noise.stl": bytes(range(256))[:84], "noise.obj": bytes(range(256)), "noise.off": bytes(range(256)),
    }  # fmt: skip
