"""Every type of attribute on every domain, through a fill, a fairing and a new mesh: what is wrong afterwards.

Run in a Blender of its own: some of these end it where they are not set aside.
"""

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np

import extension
import meshes

CUT = 0.3  # the cap above this height is what is filled, faired or meshed anew
SIDE = 0.6  # nearer to x = 0 than this, either side's category is right: faces are 0.26 wide and take one
NEAR = 0.15  # of the spread of the values: means, and the field that they are means of
STEP = 0.01  # colours of bytes are rounded
DOMAINS = ("POINT", "EDGE", "FACE", "CORNER")
SIZES = {"POINT": "vertices", "EDGE": "edges", "FACE": "polygons", "CORNER": "loops"}


def kinds() -> list[str]:
    """Return every type that this Blender has."""
    return [item.identifier for item in bpy.types.Attribute.bl_rna.properties["data_type"].enum_items]


def read(attribute: Any) -> Any:
    """Return the values of an attribute of a mesh in object mode, (n, w)."""
    if attribute.data_type == "STRING":
        return np.array([[item.value] for item in attribute.data])
    name, width, dtype = meshes.LAYOUT[attribute.data_type]
    values = np.empty(len(attribute.data) * width, dtype=dtype)
    attribute.data.foreach_get(name, values)
    return values.reshape(-1, width)


def write(attribute: Any, values: Any) -> None:
    if attribute.data_type == "STRING":
        for item, value in zip(attribute.data, values[:, 0], strict=True):
            item.value = value
    else:
        name, _, dtype = meshes.LAYOUT[attribute.data_type]
        attribute.data.foreach_set(name, np.ascontiguousarray(values, dtype=dtype).ravel())


def field(kind: str, places: Any, stepped: bool) -> Any:
    """Return values (n, w) for places (n, 3): they vary with x, by two steps where that is asked for."""
    x = np.where(places[:, 0] > 0.0, 0.5, -0.5) if stepped else places[:, 0]
    if kind == "STRING":
        return np.where(x > 0.0, b"right", b"left")[:, None]
    _, width, dtype = meshes.LAYOUT[kind]
    if dtype is not np.float32:
        return np.repeat(np.where(x > 0.0, 7, 3)[:, None], width, axis=1) if dtype is np.int32 else x[:, None] > 0.0
    if kind == "QUATERNION":
        return np.stack([np.cos(x / 2.0), 0.0 * x, 0.0 * x, np.sin(x / 2.0)], axis=1)
    if kind == "FLOAT4X4":
        turned = np.zeros((len(x), 4, 4))
        turned[:, 0, 0] = turned[:, 1, 1] = np.cos(x)
        turned[:, 0, 1], turned[:, 1, 0] = np.sin(x), -np.sin(x)
        turned[:, 2, 2] = turned[:, 3, 3] = 1.0
        turned[:, 3, 0] = x
        return turned.reshape(-1, 16)
    return 0.5 + 0.25 * np.repeat(x[:, None], width, axis=1)


def places(mesh: Any, domain: str) -> Any:
    """Return (n, 3): where the elements are."""
    points = np.array([vertex.co for vertex in mesh.vertices])
    if domain == "POINT":
        return points
    if domain == "EDGE":
        return np.array([points[list(edge.vertices)].mean(axis=0) for edge in mesh.edges])
    if domain == "FACE":
        return np.array([points[list(face.vertices)].mean(axis=0) for face in mesh.polygons])
    return points[[corner.vertex_index for corner in mesh.loops]]


def outside(mesh: Any, domain: str) -> Any:
    """Return the mask of the elements that stay whatever is done above CUT."""
    points = np.array([vertex.co for vertex in mesh.vertices])
    low = np.array([points[list(face.vertices)].mean(axis=0)[2] < CUT for face in mesh.polygons])
    if domain == "FACE":
        return low
    if domain == "CORNER":
        return np.repeat(low, [len(face.vertices) for face in mesh.polygons])
    found = np.zeros(len(getattr(mesh, SIZES[domain])), dtype=bool)
    for face, stays in zip(mesh.polygons, low, strict=True):
        if stays:
            corners = [mesh.loops[k] for k in face.loop_indices]
            found[[c.vertex_index if domain == "POINT" else c.edge_index for c in corners]] = True
    return found


def subject(act: str, size: int = 24) -> Any:
    """Add a sphere of so many edges around, open above CUT where it is to be filled."""
    obj = meshes.sphere(size)
    if act == "fill":
        meshes.remove(obj, lambda centre: centre.z > CUT)
    return obj


def dress(mesh: Any, domain: str, kind: str) -> None:
    """Give it an attribute by the name of its domain."""
    values = field(kind, places(mesh, domain), stepped=domain == "FACE")
    if domain == "EDGE":  # marks: only outside, or they would all stay
        default = read(mesh.attributes.new(domain, kind, domain))
        values = np.where(outside(mesh, domain)[:, None], values, default)
    else:
        mesh.attributes.new(domain, kind, domain)
    write(mesh.attributes[domain], values)


def apply(
    obj: Any, act: str, mode: str, before: Callable[[], Any] = int, after: Callable[[], Any] = int, **properties: Any
) -> None:
    """Fill, fair or mesh anew what is above CUT; before and after: called in edit mode."""
    high = meshes.faces_where(obj, lambda centre: centre.z > CUT)
    if act == "remesh":
        properties = {"remesh": True, "spacing": 0.8, **properties}
    if mode == "object" and act == "fill":
        extension.module("fill.script").fill_mesh(obj.data, **properties)
    elif mode == "object":
        extension.module("fair.script").fair_mesh(obj.data, np.flatnonzero(high).tolist(), **properties)
    else:
        meshes.enter(obj, high)
        if act == "fill":
            bpy.context.tool_settings.mesh_select_mode = (False, True, False)
            bpy.ops.mesh.select_non_manifold()
        before()
        operator = bpy.ops.mesh.fair_fill if act == "fill" else bpy.ops.mesh.fair_region
        assert operator("EXEC_DEFAULT", True, **properties) == {"FINISHED"}
        after()
        meshes.leave()


def names(mesh: Any, domain: str) -> list[bytes]:
    """Return what tells an element that stays from all others: where it is, a corner's face, too."""
    found = places(mesh, domain)
    if domain == "CORNER":
        sizes = [len(face.vertices) for face in mesh.polygons]
        found = np.concatenate([found, np.repeat(places(mesh, "FACE"), sizes, axis=0)], axis=1)
    return [row.tobytes() for row in found.astype(np.float32)]


def kept_values(mesh: Any, domain: str) -> dict[bytes, Any]:
    """Return the values of the elements outside by their names."""
    values, stays = read(mesh.attributes[domain]), outside(mesh, domain)
    return {name: value for name, value, stay in zip(names(mesh, domain), values, stays, strict=True) if stay}


def complaint(mesh: Any, kept: dict[bytes, Any], domain: str, kind: str) -> str:
    """Say what is wrong with the attribute, kept: the values outside before; empty where nothing is."""
    attribute = mesh.attributes.get(domain)
    if attribute is None or (attribute.data_type, attribute.domain) != (kind, domain):
        return "is gone"
    values, now = read(attribute), names(mesh, domain)
    still = [k for k, name in enumerate(now) if name in kept]
    if len(still) != len(kept) or not all(_same(values[k], kept[now[k]]) for k in still):
        return "other values outside"
    new, at = np.delete(values, still, axis=0), np.delete(places(mesh, domain), still, axis=0)
    if not len(new):
        return ""
    if domain == "EDGE":
        default = read(mesh.attributes.new("default", kind, domain))
        mesh.attributes.remove(mesh.attributes["default"])
        return "" if _same(new, default[: len(new)]) else "new edges have values"
    return _off_the_field(new, at, domain, kind)


def _off_the_field(new: Any, at: Any, domain: str, kind: str) -> str:
    whole = kind == "STRING" or meshes.LAYOUT[kind][2] is not np.float32
    stepped = whole or domain == "FACE"
    expected = field(kind, at, stepped)
    sure = np.abs(at[:, 0]) > SIDE if stepped else np.ones(len(at), dtype=bool)
    if whole:
        return "" if (new[sure] == expected[sure]).all() else "not the nearest value"
    off = np.abs(new[sure] - expected[sure]).max()
    return "" if off < (STEP if stepped else NEAR * np.ptp(expected, axis=0).max()) else f"off by {off:.3f}"


def _same(one: Any, other: Any) -> bool:
    """Tell whether two arrays have the same bits; texts the same letters."""
    return np.array_equal(one, other) if one.dtype.kind == "S" else one.tobytes() == other.tobytes()


def complaints(act: str, mode: str) -> list[str]:
    """Return what is wrong, one line for each type and domain."""
    found = []
    for kind in kinds():
        bpy.ops.wm.read_homefile(use_empty=True)
        bpy.context.tool_settings.mesh_select_mode = (False, False, True)
        obj = subject(act)
        for domain in DOMAINS:
            dress(obj.data, domain, kind)
        kept = {domain: kept_values(obj.data, domain) for domain in DOMAINS}
        before = {domain: read(obj.data.attributes[domain]) for domain in DOMAINS}
        count = len(obj.data.vertices)
        print(kind, flush=True)
        apply(obj, act, mode)
        if act == "fair":
            changed = [domain for domain in DOMAINS if not _same(read(obj.data.attributes[domain]), before[domain])]
            found += [f"{kind} {domain}: changed" for domain in changed]
            continue
        assert len(obj.data.vertices) != count
        wrong = {domain: complaint(obj.data, kept[domain], domain, kind) for domain in DOMAINS}
        found += [f"{kind} {domain}: {text}" for domain, text in wrong.items() if text]
    return found
