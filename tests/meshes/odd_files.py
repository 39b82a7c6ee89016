"""Files of one shape as programs write them: an open box of five quads, and files that can't be read."""

import struct
from collections.abc import Callable, Iterable, Sequence

CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
QUADS = [(0, 3, 2, 1), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
TRIANGLES = [t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))]


def off(points: Iterable[Sequence[float]], faces: Iterable[Sequence[int]]) -> str:
    """A text for arrays."""
    places, rows = [" ".join(map(repr, map(float, row))) for row in points], [" ".join(map(str, row)) for row in faces]
    corners = [f"{row.count(' ') + 1} {row}" for row in rows]
    return "\n".join(["OFF", f"{len(places)} {len(rows)} 0", *places, *corners, ""])


def ply(form: str = "ascii", faces: list[tuple[int, ...]] = QUADS, vertex: tuple[str, ...] = ()) -> bytes:
    """`vertex`: further properties of vertices ("type name"), of value 1."""
    lines = ["ply", f"format {form} 1.0", "comment made", f"element vertex {len(CORNERS)}"]
    lines += [f"property float {axis}" for axis in "xyz"] + [f"property {each}" for each in vertex]
    lines += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header", ""]
    head = "\n".join(lines).encode()
    if form == "ascii":
        rows = [" ".join(map(str, [*corner, *[1] * len(vertex)])) for corner in CORNERS]
        return head + "\n".join([*rows, *(f"{len(f)} {' '.join(map(str, f))}" for f in faces), ""]).encode()
    order, kinds = "<" if "little" in form else ">", "".join(each[0] for each in vertex).replace("u", "B")
    body = b"".join(struct.pack(f"{order}3f{kinds}", *corner, *[1] * len(vertex)) for corner in CORNERS)
    return head + body + b"".join(struct.pack(f"{order}B{len(f)}i", len(f), *f) for f in faces)


def _obj(
    corner: Callable[[int], str] = str, before: str = "", head: str = "", end: str = "\n", face: str = "f",
    behind: str = "",
) -> bytes:  # fmt: skip
    """`corner`: how vertex number 1 … 8 is named; `before`: lines between vertices and faces; `behind`: each vertex."""
    places = "".join(f"v {x} {y} {z}{behind}{end}" for x, y, z in CORNERS)
    return (
        head + places + before + "".join(f"{face} {' '.join(corner(v + 1) for v in q)}{end}" for q in QUADS)
    ).encode()


def _stl(name: str = "box") -> bytes:
    facets = ["\n".join(f"vertex {x} {y} {z}" for x, y, z in (CORNERS[v] for v in row)) for row in TRIANGLES]
    return "\n".join(
        [
            f"solid {name}",
            *(f"facet normal 0 0 1\nouter loop\n{each}\nendloop\nendfacet" for each in facets),
            "endsolid",
            "",
        ]
    ).encode()


def _binary_stl(attribute: int = 0) -> bytes:
    rows = b"".join(
        struct.pack("<12fH", 0, 0, 0, *(x for v in t for x in CORNERS[v]), attribute) for t in TRIANGLES
    )  # fmt: skip
    return bytes(80) + struct.pack("<I", len(TRIANGLES)) + rows


def _off(plain: str, word: str, vertex: str, face: str) -> bytes:
    """`vertex`, `face`: what follows in each row."""
    _, counts, *rows = plain.splitlines()
    tails = [vertex] * len(CORNERS) + [face] * len(QUADS)
    return "\r\n".join([word, counts, *map("".join, zip(rows, tails, strict=True)), ""]).encode()


def good() -> dict[str, bytes]:
    """Files by names; all of them are the box. Dialects are OBJ's and OFF's, which are read here."""
    plain = off(CORNERS, QUADS)
    return {
        **{f"{form}.ply": ply(form) for form in ("ascii", "binary_little_endian", "binary_big_endian")},
        "upper_name.PLY": ply(),
        "mixed.ply": ply(faces=[QUADS[0], *TRIANGLES[2:6], QUADS[3], QUADS[4]]),
        "colours.ply": ply("binary_little_endian", vertex=("float nx", "uchar red", "uchar green", "uchar blue")),
        "a_line.ply": ply(faces=[*QUADS, (0, 1)]),
        "twice.ply": ply(faces=[*QUADS, (4, 4, 5)]),
        "wedges.ply": _wedges(),
        "plain.off": plain.encode(),
        **{
            f"{word or 'no_word'}{face}.off": _off(plain, word, vertex, face)
            for word, vertex, face in [
                ("", "", " 255 0 0"),
                ("OFF", " 10 20 30", " 3"),
                ("COFF", " 255 0 0 255", ""),
                ("4OFF", " 1", ""),
                ("NCOFF", " 0 0 1 9 8 7", " .5 .5 .5 1"),
                ("STCNOFF", " 0 0 1 .1 .2 .3 1 .5 .25", ""),
            ]
        },
        "behind_others.off": b"appearance {\n+texturing\n}\n" + plain.encode(),
        "comments.off": plain.replace("OFF\n", "OFF # here\n# counts\n").encode(),
        "text.stl": _stl(),
        "long_name.stl": _stl("a box, exported: 10 facets (vertex, facet)"),
        "binary.stl": _binary_stl(),
        "binary_attribute.stl": _binary_stl(attribute=31),
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
        "a_line.obj": _obj() + b"f 1 2\n",
        "twice.obj": _obj() + b"f 5 5 6\n",
        "lone_vertex.obj": _obj(before="v 9 9 9\n"),
        "late_vertices.obj": _obj(lambda v: str(v)) + b"v 5 5 5\ng end\n",
    }


def _wedges() -> bytes:
    """Places in an image at the corners of faces."""
    head, _, body = ply().partition(b"end_header\n")
    head = head.replace(b"vertex_indices\n", b"vertex_indices\nproperty list uchar float texcoord\n")
    lines = body.decode().splitlines()
    lines[8:] = [line + " 8 0 0 1 0 1 1 0 1" for line in lines[8:]]
    return head + b"end_header\n" + "\n".join([*lines, ""]).encode()


def broken() -> dict[str, bytes]:
    """Files that hold no mesh, or only a part of one."""
    whole, text = ply("binary_little_endian"), off(CORNERS, QUADS).encode()
    return {
        "empty.ply": b"", "empty.off": b"", "empty.obj": b"", "empty.stl": b"", "empty.glb": b"", "empty.vtk": b"",
        "text.ply": b"hello\n", "text.off": b"hello\n", "text.obj": b"hello\n", "text.stl": b"hello\n",
        "text.glb": b"hello\n", "text.vtk": b"hello\n", "head.ply": whole[:60], "short.ply": whole[:-7],
        "short_text.ply": ply()[:-20], "points.ply": ply(faces=[]), "no_format.ply": ply("binary_odd_endian"),
        "type.ply": ply().replace(b"uchar", b"byte9"), "range.ply": ply(faces=[(0, 1, 99)]),
        "range_off.off": text.replace(b"4 0 3 2 1", b"4 0 3 2 99"), "short.off": text[:60],
        "words.off": text.replace(b"0.0 1.0 1.0", b"0.0 x 1.0"), "zero.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n",
        "range.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "points.obj": b"v 0 0 0\nv 1 0 0\n",
        "short.stl": _binary_stl()[:100], "text_cut.stl": _stl()[:200], "unknown.xyz": b"0 0 0\n",
        "noise.ply": bytes(range(256)) * 9,
        "noise.stl": bytes(range(256))[:84], "noise.obj": bytes(range(256)), "noise.off": bytes(range(256)),
    }  # fmt: skip
