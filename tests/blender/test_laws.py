"""Every operator and every law: an operator is a row of operators.py, a law one function over a row.

What is refused, cancelled or undone leaves the mesh as it was, to the bit; what lies outside is not touched.
"""

import re
import threading
from collections.abc import Callable, Iterator
from contextlib import suppress
from types import SimpleNamespace
from typing import Any

import bmesh
import bpy
import numpy as np
import pytest
from mathutils import Euler, Matrix, Vector
from scipy.spatial import cKDTree

import meshes
from changes import Kind, edited
from extension import module, stand_in
from operators import EVERY

FAR = 50.0  # where a bystander is


@pytest.fixture(params=EVERY)
def kind(request: pytest.FixtureRequest) -> Kind:
    module("run.job").memory.clear()
    return EVERY[request.param]


@pytest.fixture
def gate() -> Iterator[threading.Event]:
    opened = threading.Event()
    yield opened
    opened.set()
    module("run.background").stop_all()


def begun(kind: Kind, change: Callable[[Any], object] = lambda obj: None) -> bpy.types.Object:
    """The row's scene in edit mode, changed in object mode; layers that edit mode adds are there already."""
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    kind.enter()
    meshes.leave()
    obj = bpy.context.object
    change(obj)
    bpy.context.view_layer.update()
    for _ in range(2):
        bpy.ops.object.mode_set(mode="EDIT")
        meshes.leave()
    bpy.ops.object.mode_set(mode="EDIT")
    return obj


def state(obj: bpy.types.Object) -> dict[str, bytes]:
    """All of the mesh in edit mode, and what is selected."""
    return meshes.contents_in_edit_mode(obj.name)


def asked(kind: Kind) -> Any:
    """A stand-in for the operator, which has read what is selected."""
    operator = getattr(bpy.types, f"MESH_OT_{kind.operator}")
    stand = stand_in(operator)
    for each in getattr(bpy.ops.mesh, kind.operator).get_rna_type().properties:
        if each.identifier != "rna_type":
            setattr(stand, each.identifier, kind.first.get(each.identifier, each.default))
    stand._asked = stand._read(bpy.context)
    return stand


def test_undo_and_redo_are_exact(kind: Kind) -> None:
    obj = begun(kind)
    name = obj.name
    bpy.ops.ed.undo_push(message="Begin")
    before = edited(name)
    assert kind.run() == {"FINISHED"}
    after = edited(name)
    assert after != before
    bpy.ops.ed.undo()
    assert edited(name) == before
    bpy.ops.ed.redo()
    assert edited(name) == after


def test_the_same_click_has_the_same_answer(kind: Kind) -> None:
    """Whatever was asked before it."""
    found = []
    for change in ({}, kind.second):
        name = begun(kind).name
        bpy.ops.ed.undo_push(message="Begin")
        kind.run(**change)
        bpy.ops.ed.undo()
        kind.run()
        found.append(edited(name))
    assert found[0] == found[1]


def test_a_cancelled_search_leaves_every_bit(kind: Kind) -> None:
    """Cancelled at its first question, or later: how many there are depends on the machine."""
    import fairing

    obj = begun(kind)
    before = state(obj)
    for last in (0, 1, 3, 9):
        module("run.job").memory.clear()
        left = iter(range(last))
        with pytest.raises(fairing.Cancelled) if last == 0 else suppress(fairing.Cancelled):
            asked(kind)._asked.work(lambda *_, left=left: next(left, None) is not None)
    assert state(obj) == before


def test_escape_leaves_every_bit(kind: Kind, gate: threading.Event) -> None:
    """In the background, event by event."""
    if kind.operator == "fair_fillet":
        pytest.skip("follows the mouse: test_fillet.py")
    obj = begun(kind)
    before = state(obj)
    stand = asked(kind)

    def work(_: Any) -> Any:
        assert gate.wait(30.0)

    stand._signs = module("run.background").Signs(bpy.context)
    stand._run = module("run.runner").Run(work)
    event = SimpleNamespace(type="TIMER", value="PRESS")
    assert stand.modal(bpy.context, event) == {"RUNNING_MODAL"}
    event.type = "ESC"
    assert stand.modal(bpy.context, event) == {"CANCELLED"}
    gate.set()
    assert stand._run.wait(30.0)
    assert state(obj) == before


def with_nan(obj: bpy.types.Object) -> None:
    chosen = next(vertex for vertex in obj.data.vertices if vertex.select)
    chosen.co.x = float("nan")
    for block in obj.data.shape_keys.key_blocks if obj.data.shape_keys else ():
        block.data[chosen.index].co.x = float("nan")


def flat(obj: bpy.types.Object) -> None:
    obj.scale = (1.0, 0.0, 1.0)


def locked(obj: bpy.types.Object) -> None:
    for name in ("Basis", "Smile"):
        obj.shape_key_add(name=name)
    obj.active_shape_key_index = 1
    obj.data.shape_keys.key_blocks[1].lock_shape = True


def deselected(obj: bpy.types.Object) -> None:
    for elements in (obj.data.polygons, obj.data.edges, obj.data.vertices):
        elements.foreach_set("select", [False] * len(elements))


def levelled(obj: bpy.types.Object) -> None:
    obj.modifiers.new("Levels", "MULTIRES")


SPOILT = {with_nan: "NaN|invalid", flat: "scale", locked: "Unlock", deselected: "elect|edge", levelled: "Multires"}


@pytest.mark.parametrize("spoil", SPOILT, ids=lambda each: each.__name__)
def test_a_refusal_leaves_every_bit(kind: Kind, spoil: Callable[[Any], None]) -> None:
    """And the selection."""
    moves = kind.operator == "fair_denoise" or (kind.operator == "fair_region" and not kind.first.get("remesh"))
    if spoil is levelled and moves:
        pytest.skip("levels stay: test_restoration.py")
    if spoil is with_nan and kind.first.get("bridge"):
        pytest.skip("the other hole is filled: test_fill_each.py")
    if spoil is locked and kind.first.get("all_keys"):
        pytest.skip("has keys of its own: test_report.py")
    obj = begun(kind, spoil)
    before = state(obj)
    try:
        assert kind.run() == {"CANCELLED"}
    except RuntimeError as refusal:
        assert re.search(SPOILT[spoil], str(refusal)), refusal
    assert state(obj) == before


def with_bystander(obj: bpy.types.Object) -> None:
    """A hidden triangle and an edge, far away, with marks and a value of each kind."""
    mesh = obj.data
    with meshes.rebuilt(obj) as bm:
        corners = [bm.verts.new((FAR + x, FAR + y, FAR)) for x, y in ((0, 0), (1, 0), (0, 1))]
        face = bm.faces.new(corners)
        face.select_set(False)
        face.hide_set(True)
        tail = bm.edges.new((bm.verts.new((FAR, FAR, 2 * FAR)), bm.verts.new((FAR, FAR, 3 * FAR))))
        tail.select_set(False)
    for block in mesh.shape_keys.key_blocks if mesh.shape_keys else ():
        for vertex in mesh.vertices[-5:]:
            block.data[vertex.index].co = vertex.co
    for domain, elements in (("POINT", mesh.vertices), ("EDGE", mesh.edges), ("FACE", mesh.polygons)):
        layer = mesh.attributes.new(f"number {domain}", "INT", domain)
        if domain == "POINT":  # elsewhere values are marks
            layer.data.foreach_set("value", np.arange(len(elements), dtype=np.int32) + 7)
    for edge in mesh.edges:
        if all(mesh.vertices[v].co.z > 0.9 * FAR for v in edge.vertices):
            edge.use_seam = edge.use_edge_sharp = True
            mesh.attributes["number EDGE"].data[edge.index].value = 5
    mesh.polygons[len(mesh.polygons) - 1].material_index = 3
    mesh.attributes["number FACE"].data[len(mesh.polygons) - 1].value = 4


def bystander(obj: bpy.types.Object) -> list[Any]:
    """What of it can be seen, in object mode: by places, since numbers may change."""
    mesh = obj.data
    far = {vertex.index: tuple(vertex.co) for vertex in mesh.vertices if vertex.co.z > 0.9 * FAR}
    numbers = {domain: mesh.attributes[f"number {domain}"].data for domain in ("POINT", "EDGE", "FACE")}
    points = sorted((place, mesh.vertices[v].hide, numbers["POINT"][v].value) for v, place in far.items())
    edges = sorted(
        (sorted(far[v] for v in e.vertices), e.hide, e.use_seam, e.use_edge_sharp, numbers["EDGE"][e.index].value)
        for e in mesh.edges
        if all(v in far for v in e.vertices)
    )
    faces = [
        ([far[v] for v in f.vertices], f.hide, f.select, f.material_index, numbers["FACE"][f.index].value)
        for f in mesh.polygons
        if all(v in far for v in f.vertices)
    ]
    return [points, edges, faces]


def test_what_is_hidden_or_elsewhere_stays(kind: Kind) -> None:
    obj = begun(kind, with_bystander)
    meshes.leave()
    before = bystander(obj)
    assert [len(each) for each in before] == [5, 4, 1]
    bpy.ops.object.mode_set(mode="EDIT")
    assert kind.run() == {"FINISHED"}
    meshes.leave()
    assert bystander(obj) == before


def outside_faces(obj: bpy.types.Object, wanted: set[Any] | None = None) -> set[Any]:
    """Faces that are not selected, or those among `wanted`: the places of their corners, to the bit."""
    places = [tuple(vertex.co) for vertex in obj.data.vertices]
    faces = {tuple(sorted(places[v] for v in face.vertices)): face.select for face in obj.data.polygons}
    return {face for face, on in faces.items() if (not on if wanted is None else face in wanted)}


def test_faces_outside_stay_where_they_are(kind: Kind) -> None:
    if kind.operator == "fair_fillet":
        pytest.skip("cuts the faces beside the seam")
    obj = begun(kind)
    meshes.leave()
    before = outside_faces(obj)
    bpy.ops.object.mode_set(mode="EDIT")
    assert kind.run() == {"FINISHED"}
    meshes.leave()
    assert outside_faces(obj, before) == before


def test_before_and_after_goes_back_and_forth(kind: Kind) -> None:
    obj = begun(kind)
    before = edited(obj.name)
    assert kind.run() == {"FINISHED"}
    after = edited(obj.name)
    if not bpy.ops.mesh.fair_compare.poll():
        pytest.skip("vertices are new, or moved in all keys")
    for expected in (before, after):
        assert bpy.ops.mesh.fair_compare("EXEC_DEFAULT", True) == {"FINISHED"}
        assert edited(obj.name) == expected


def with_modifiers(obj: bpy.types.Object) -> None:
    obj.modifiers.new("Subdivision", "SUBSURF").levels = 2
    obj.modifiers.new("Array", "ARRAY").count = 3


def test_modifiers_change_nothing(kind: Kind) -> None:
    found = []
    for change in (lambda obj: None, with_modifiers):
        obj = begun(kind, change)
        assert kind.run() == {"FINISHED"}
        found.append(edited(obj.name))
    assert found[0] == found[1]


TURNED = Matrix.LocRotScale((3.0, -2.0, 1.0), Euler((0.3, 0.4, 0.5)), (1.0, 1.0, 1.0))
MIRRORED = Matrix.LocRotScale((0.0, 0.0, 0.0), Euler((0.0, 0.0, 0.0)), (-0.5, 2.0, 1.0))


TINY = Matrix.Scale(1e-4, 4)
LARGE = Matrix.Scale(1e5, 4)


@pytest.mark.parametrize("matrix", [TURNED, MIRRORED, TINY, LARGE], ids=["turned", "mirrored", "tiny", "large"])
def test_the_answer_is_one_of_the_world(kind: Kind, matrix: Matrix) -> None:
    """Whatever the object's matrix is; faces outward as before."""

    def unplaced(obj: bpy.types.Object) -> None:
        if np.linalg.det(np.array(matrix)) < 0.0:  # seen from outside still
            with meshes.rebuilt(obj) as bm:
                bmesh.ops.reverse_faces(bm, faces=bm.faces)
        obj.data.transform(matrix.inverted(), shape_keys=True)
        obj.matrix_world = matrix

    found = []
    for change in (lambda obj: None, unplaced):
        obj = begun(kind, change)
        assert kind.run() == {"FINISHED"}
        meshes.leave()
        points = np.array([obj.matrix_world @ vertex.co for vertex in obj.data.vertices])
        with meshes.rebuilt(obj, write=False) as bm:
            assert all(edge.is_contiguous for edge in bm.edges if edge.is_manifold)
            ends = np.array([[vertex.index for vertex in edge.verts] for edge in bm.edges])
        found.append((points, float(np.median(np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1)))))
    (plain, length), (placed, _) = found
    assert len(placed) == pytest.approx(len(plain), rel=0.1)
    assert cKDTree(plain).query(placed)[0].max() < length
    assert cKDTree(placed).query(plain)[0].max() < length


def with_a_lifted_key(obj: bpy.types.Object) -> None:
    """A key that lifts everything, a group that everything is in, and faces that are all alike."""
    for name in ("Basis", "Lifted"):
        if not (obj.data.shape_keys and name in obj.data.shape_keys.key_blocks):
            obj.shape_key_add(name=name, from_mix=False)
    for vertex in obj.data.vertices:
        obj.data.shape_keys.key_blocks["Lifted"].data[vertex.index].co = vertex.co + Vector((0.0, 0.0, 0.5))
    obj.active_shape_key_index = 0
    obj.vertex_groups.new(name="All").add(range(len(obj.data.vertices)), 0.75, "REPLACE")
    sets = obj.data.attributes.new(".sculpt_face_set", "INT", "FACE")
    for polygon in obj.data.polygons:
        polygon.material_index, polygon.use_smooth = 1, True
        sets.data[polygon.index].value = 7


def test_keys_weights_and_faces_go_on_as_they_are_around(kind: Kind) -> None:
    obj = begun(kind, with_a_lifted_key)
    had_faces = len(obj.data.polygons) > 0
    assert kind.run() == {"FINISHED"}
    meshes.leave()
    keys = obj.data.shape_keys.key_blocks
    for basis, lifted in zip(keys["Basis"].data, keys["Lifted"].data, strict=True):
        assert (lifted.co - basis.co - Vector((0.0, 0.0, 0.5))).length < 2e-4
    (group,) = (each.index for each in obj.vertex_groups if each.name == "All")
    for vertex in obj.data.vertices:
        assert [e.weight for e in vertex.groups if e.group == group] == pytest.approx([0.75], abs=1e-5)
    if had_faces:
        sets = obj.data.attributes[".sculpt_face_set"].data
        found = {(p.material_index, p.use_smooth, sets[p.index].value) for p in obj.data.polygons}
        assert found == {(1, True, 7)}


def test_several_objects_are_done_like_one(kind: Kind) -> None:
    obj = begun(kind)
    assert kind.run() == {"FINISHED"}
    alone = edited(obj.name)
    first = begun(kind)
    meshes.leave()
    twin = first.copy()
    twin.data = first.data.copy()
    bpy.context.collection.objects.link(twin)
    linked = first.copy()  # with the same mesh
    bpy.context.collection.objects.link(linked)
    meshes.edit(first, twin, linked)
    assert kind.run() == {"FINISHED"}
    assert [edited(each.name) for each in (first, twin, linked)] == [alone, alone, alone]


def test_one_refused_object_leaves_all_alone(kind: Kind) -> None:
    if kind.operator == "fair_fill":
        pytest.skip("each hole is a job of its own: test_fill_each.py")
    first = begun(kind)
    meshes.leave()
    second = first.copy()
    second.data = first.data.copy()
    bpy.context.collection.objects.link(second)
    with_nan(second)
    meshes.edit(first, second)
    before = state(first)
    with pytest.raises(RuntimeError, match=second.name):
        kind.run()
    assert state(first) == before


SCRIPTS = {
    "fair_region": ("fair_mesh", "polygons"), "fair_fill": ("fill_mesh", "vertices"),
    "fair_fillet": ("fillet_mesh", "edges"), "fair_denoise": ("denoise_mesh", "polygons"),
}  # fmt: skip


def scripted(obj: bpy.types.Object, kind: Kind) -> None:
    """Call the script's function for what is selected, with options in the properties' single precision."""
    name, kinds = SCRIPTS[kind.operator]
    options = {
        key: float(np.float32(value)) if isinstance(value, float) else value for key, value in kind.first.items()
    }
    getattr(module(), name)(obj.data, [each.index for each in getattr(obj.data, kinds) if each.select], **options)


def test_a_script_is_the_operator(kind: Kind) -> None:
    if kind.operator not in SCRIPTS or kind.first.get("all_keys"):
        pytest.skip("scripts have none")
    obj = begun(kind)
    assert kind.run() == {"FINISHED"}
    meshes.leave()
    expected = meshes.positions(obj), [sorted(polygon.vertices) for polygon in obj.data.polygons]
    obj = begun(kind)
    meshes.leave()
    scripted(obj, kind)
    assert [sorted(polygon.vertices) for polygon in obj.data.polygons] == expected[1]
    np.testing.assert_allclose(meshes.positions(obj), expected[0], atol=1e-6)


@pytest.mark.parametrize("overridden", [False, True])
def test_scripts_refuse_what_is_linked(kind: Kind, overridden: bool, tmp_path: Any) -> None:
    if kind.operator not in SCRIPTS:
        pytest.skip("scripts have none")
    name = begun(kind).name
    meshes.leave()
    path = str(tmp_path / "library.blend")
    bpy.data.libraries.write(path, {bpy.data.objects[name]})
    bpy.ops.wm.read_homefile(use_empty=True)
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.objects = [name]
    obj = bpy.data.objects[name]
    if overridden:
        bpy.context.collection.objects.link(obj)
        obj = obj.override_create(remap_local_usages=True)
        obj.data.override_create(remap_local_usages=True)
    before = meshes.contents(obj)
    with pytest.raises(ValueError, match="linked from another file"):
        scripted(obj, kind)
    assert meshes.contents(obj) == before
