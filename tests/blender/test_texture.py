"""Fair Texture in Blender: colours go on over new faces, on a copy; all else keeps its bits, and undo takes it back."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bmesh
import bpy
import numpy as np
import pytest

import meshes
import textured
from extension import module
from test_fill import select_vertices

Floats = meshes.Floats
SIZE = 256
FLAT = 0.4  # of the image for half of the grid, whose middle is the image's


def ramp(u: Floats, v: Floats) -> Floats:
    """Light that goes up evenly, as sRGB stores it."""
    light = np.stack([0.2 + 0.4 * u, 0.6 - 0.3 * v, 0.3 + 0.2 * u + 0.1 * v, np.ones_like(u)], axis=-1)
    return module("core.colours").Coding(srgb=True, straight=True, clipped=True).encoded(light)


def on_grid(points: Floats, _polygon: Any = None) -> Floats:
    return 0.5 + FLAT * points[:, :2]


def holed_grid(image: bpy.types.Image | None = None, cells: int = 16) -> bpy.types.Object:
    """A flat grid with a hole in its middle, all on the image."""
    obj = meshes.grid(cells)
    textured.lay_out(obj, on_grid)
    obj.data.materials.append(textured.material_of(image or textured.image_of(ramp, SIZE)))
    return meshes.remove(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.5)


def fill(obj: bpy.types.Object) -> None:
    """Fill its hole and stay in edit mode, with the new faces selected."""
    select_vertices(obj, lambda co: max(abs(co.x), abs(co.y)) < 0.9 and co.z < 0.5)
    assert bpy.ops.mesh.fair_fill("EXEC_DEFAULT", True) == {"FINISHED"}


def run(**properties: Any) -> set[str]:
    status: set[str] = bpy.ops.mesh.fair_texture("EXEC_DEFAULT", True, **properties)
    return status


def filled_and_textured(obj: bpy.types.Object, **properties: Any) -> bpy.types.Image:
    """Do both, from and to object mode; return the image that is shown."""
    fill(obj)
    try:
        assert run(**properties) == {"FINISHED"}
    finally:
        meshes.leave()
    return textured.shown(obj)


def inside(margin: float = 0.0) -> Any:
    """The texels of the hole, and so many texels around."""
    steps = np.abs((np.arange(SIZE) + 0.5) / SIZE - 0.5)
    near = steps < 0.5 * FLAT + margin / SIZE
    return near[:, None] & near[None]


def hidden(field: textured.Field) -> textured.Field:
    """The field without what lies in the hole, where something loud is."""

    def found(u: Floats, v: Floats) -> Floats:
        colours = field(u, v)
        colours[inside()] = [1.0, 0.0, 1.0, 1.0]
        return colours

    return found


def test_a_ramp_of_light_goes_on_to_the_last_step() -> None:
    """Of a byte; and the copy alone is written, outside the hole bit by bit as the image."""
    image = textured.image_of(hidden(ramp), SIZE)
    before = textured.pixels(image)
    copy = filled_and_textured(holed_grid(image))
    assert copy != image
    assert np.array_equal(textured.pixels(image), before)
    after = textured.pixels(copy)
    v, u = (np.mgrid[:SIZE, :SIZE] + 0.5) / SIZE
    assert np.abs(after - ramp(u, v))[inside()].max() < 1.01 / 255.0
    assert np.array_equal(after[~inside()], before[~inside()])


def test_floats_are_kept_as_they_are() -> None:
    """Numbers beyond 1, to the precision that they are stored with; the map is not taken for sRGB."""

    def heights(u: Floats, v: Floats) -> Floats:
        return np.stack([3.0 * u - 2.0 * v, v, -u, np.ones_like(u)], axis=-1)

    obj = holed_grid(textured.image_of(hidden(heights), SIZE, floats=True))
    one_face(obj)
    assert run() == {"FINISHED"}
    meshes.leave()
    copy = textured.shown(obj)
    v, u = (np.mgrid[:SIZE, :SIZE] + 0.5) / SIZE
    assert copy.is_float
    assert np.abs(textured.pixels(copy) - heights(u, v))[inside()].max() < 1e-4


def one_face(obj: bpy.types.Object) -> None:
    """Close its hole with F, lay the face out as those around are, and stay in edit mode with it selected."""
    select_vertices(obj, lambda co: max(abs(co.x), abs(co.y)) < 0.9)
    bpy.ops.mesh.edge_face_add()
    meshes.leave()
    new = np.arange(len(obj.data.polygons)) == len(obj.data.polygons) - 1
    _give_places(obj, new)
    meshes.enter(obj, new)


def test_how_the_fill_is_cut_does_not_count() -> None:
    """F has one face and no place on the image of its own, Grid Fill a grid, Fair Fill triangles."""
    found = []
    for way in ("fair_fill", "fill", "edge_face_add"):
        bpy.ops.wm.read_homefile(use_empty=True)
        obj = holed_grid(textured.image_of(hidden(ramp), SIZE))
        select_vertices(obj, lambda co: max(abs(co.x), abs(co.y)) < 0.9)
        getattr(bpy.ops.mesh, way)()
        meshes.leave()
        new = np.arange(len(obj.data.polygons)) >= 16 * 16 - 64
        _give_places(obj, new)
        meshes.enter(obj, new)
        assert run() == {"FINISHED"}
        meshes.leave()
        found.append(textured.pixels(textured.shown(obj))[inside()])
    assert np.abs(found[0] - found[1]).max() < 1.01 / 255.0
    assert np.abs(found[0] - found[2]).max() < 1.01 / 255.0


def _give_places(obj: bpy.types.Object, new: Any) -> None:
    """Lay new faces out as those around are."""
    points = meshes.positions(obj)
    layer = obj.data.uv_layers["Map"].uv
    for polygon in obj.data.polygons:
        if new[polygon.index]:
            for corner, place in zip(polygon.loop_indices, on_grid(points[list(polygon.vertices)]), strict=True):
                layer[corner].vector = place


def in_a_corner(points: Floats, _polygon: Any = None) -> Floats:
    return 0.25 + 0.2 * points[:, :2]


def around_the_hole() -> Any:
    """The texels of the old faces there."""
    u = (np.arange(SIZE) + 0.5) / SIZE
    old = (u > 0.05) & (u < 0.45)
    hole = (u > 0.15) & (u < 0.35)
    return (old[:, None] & old[None]) & ~(hole[:, None] & hole[None])


def test_faces_without_a_place_get_one_in_free_space() -> None:
    """F leaves its corners at (0, 0). There is as much texture as around, and what lies elsewhere keeps its bits."""
    image = textured.image_of(ramp, SIZE)
    before = textured.pixels(image)
    obj = holed_grid(image)
    textured.lay_out(obj, in_a_corner)
    select_vertices(obj, lambda co: max(abs(co.x), abs(co.y)) < 0.9)
    bpy.ops.mesh.edge_face_add()
    assert run() == {"FINISHED"}
    meshes.leave()
    new = obj.data.polygons[-1]
    uv = textured.places(obj)[list(new.loop_indices)]
    assert np.ptp(uv, axis=0) == pytest.approx([0.2, 0.2], rel=0.01)
    after = textured.pixels(textured.shown(obj))
    assert np.array_equal(after[around_the_hole()], before[around_the_hole()])
    points = meshes.positions(obj)[list(new.vertices)]
    texels = np.floor(uv * SIZE).astype(int)
    wanted = ramp(*in_a_corner(points).T)
    assert np.abs(after[texels[:, 1], texels[:, 0]] - wanted).max() < 3.0 / 255.0


def two_islands(obj: bpy.types.Object) -> None:
    """Lay the halves of the grid out apart, one of them turned; the hole is in both."""

    def place(points: Floats, polygon: Any) -> Floats:
        x, y = points[:, 0], points[:, 1]
        if polygon.center.x < 0.0:
            return np.stack([0.42 + 0.4 * x, 0.5 + 0.4 * y], axis=1)
        return np.stack([0.98 - 0.4 * x, 0.5 - 0.4 * y], axis=1)

    textured.lay_out(obj, place)


def test_colours_meet_at_seams() -> None:
    """Both islands have the colours of one field on the surface; so has the hole across their seam."""

    def field(u: Floats, v: Floats) -> Floats:
        x = np.where(u < 0.5, (u - 0.42) / 0.4, (0.98 - u) / 0.4)
        y = np.where(u < 0.5, (v - 0.5) / 0.4, (0.5 - v) / 0.4)
        return 0.5 + 0.2 * np.stack([x, y, x * x - y * y, np.ones_like(x)], axis=-1)

    image = textured.image_of(field, SIZE, floats=True)
    obj = meshes.grid(16)
    two_islands(obj)
    obj.data.materials.append(textured.material_of(image))
    meshes.remove(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.5)
    filled_and_textured(obj)
    after = textured.pixels(textured.shown(obj))
    points, uv = meshes.positions(obj), textured.places(obj)
    checked = 0
    for polygon in obj.data.polygons:
        if polygon.select:
            middle = uv[list(polygon.loop_indices)].mean(axis=0) * SIZE
            at = points[list(polygon.vertices)].mean(axis=0)
            texel = np.floor(middle).astype(int)
            wanted = 0.5 + 0.2 * np.array([at[0], at[1], at[0] ** 2 - at[1] ** 2])
            assert after[texel[1], texel[0], :3] == pytest.approx(wanted, abs=0.006)  # a texel is 0.002 wide
            checked += 1
    assert checked > 50


def test_other_islands_keep_their_bits() -> None:
    """One lies where the fill continues the map: the fill moves, and the island's texels stay."""
    image = textured.image_of(ramp, SIZE)
    before = textured.pixels(image)
    obj = holed_grid(image)
    textured.lay_out(obj, in_a_corner)
    with meshes.rebuilt(obj) as bm:
        layer = bm.loops.layers.uv.active
        corners = [bm.verts.new((x, y, 1.0)) for x, y in ((-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1))]
        for loop in bm.faces.new(corners).loops:
            loop[layer].uv = in_a_corner(np.array([loop.vert.co[:]]))[0]
    filled_and_textured(obj)
    changed = (textured.pixels(textured.shown(obj)) != before).any(axis=2)
    island = np.abs((np.arange(SIZE) + 0.5) / SIZE - 0.25) < 0.02
    assert np.count_nonzero(changed) > (0.2 * SIZE) ** 2 / 2
    assert not changed[around_the_hole() | (island[:, None] & island[None])].any()


def test_one_undo_takes_all_back_and_redo_brings_it() -> None:
    obj = holed_grid()
    fill(obj)
    bpy.ops.ed.undo_push(message="Before")
    before = state()
    assert run() == {"FINISHED"}
    after = state()
    assert after != before
    bpy.ops.ed.undo()
    assert state() == before
    bpy.ops.ed.redo()
    assert state() == after


def state() -> Any:
    """Images with their bits, materials, and what the grid shows."""
    obj = bpy.data.objects["Grid"]
    bm = bmesh.from_edit_mesh(obj.data)
    layer = bm.loops.layers.uv.active
    images = {image.name: (textured.pixels(image).tobytes(), image.use_fake_user) for image in bpy.data.images}
    uv = [tuple(loop[layer].uv) for face in bm.faces for loop in face.loops]
    return images, sorted(bpy.data.materials.keys()), textured.shown(obj).name, uv


def test_undo_takes_back_a_copied_material_too() -> None:
    obj = holed_grid()
    other = meshes.grid(2)
    other.name = "Other"
    other.data.materials.append(obj.data.materials[0])
    bpy.context.view_layer.objects.active = obj
    fill(obj)
    bpy.ops.ed.undo_push(message="Before")
    before = state()
    assert run() == {"FINISHED"}
    obj, other = bpy.data.objects["Grid"], bpy.data.objects["Other"]
    assert obj.data.materials[0] != other.data.materials[0]
    assert textured.shown(other).name == "Skin"
    bpy.ops.ed.undo()
    assert state() == before


def test_a_material_of_its_own_is_kept() -> None:
    obj = holed_grid()
    material = obj.data.materials[0]
    filled_and_textured(obj)
    assert obj.data.materials[0] == material
    assert len(bpy.data.materials) == 1


@pytest.mark.parametrize("floats", [False, True])
def test_the_copy_is_packed_and_comes_back_from_the_file(floats: bool, tmp_path: Path) -> None:
    image = textured.image_of(ramp, SIZE, floats=floats)
    copy = filled_and_textured(holed_grid(image))
    assert copy.name == "Skin.faired"
    assert copy.packed_file is not None
    assert copy.colorspace_settings.name == image.colorspace_settings.name
    assert image.use_fake_user  # no one shows it any more, and it is in this file alone
    wanted, original = textured.pixels(copy), textured.pixels(image)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "kept.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "kept.blend"))
    assert np.array_equal(textured.pixels(bpy.data.images["Skin.faired"]), wanted)
    assert np.array_equal(textured.pixels(bpy.data.images["Skin"]), original)


def test_the_original_file_is_not_touched(tmp_path: Path) -> None:
    """The copy has no file that one could save it over; the original's is enough to keep it."""
    path = tmp_path / "skin.png"
    made = textured.image_of(hidden(ramp), SIZE)
    made.filepath_raw, made.file_format = str(path), "PNG"
    made.save()
    before = path.read_bytes()
    image = bpy.data.images.load(str(path))
    copy = filled_and_textured(holed_grid(image))
    assert path.read_bytes() == before
    assert not image.is_dirty and not image.use_fake_user
    assert copy.packed_file is not None
    assert bpy.path.abspath(copy.filepath) != str(path)
    v, u = (np.mgrid[:SIZE, :SIZE] + 0.5) / SIZE
    assert np.abs(textured.pixels(copy) - ramp(u, v))[inside()].max() < 1.01 / 255.0


def test_a_second_run_has_a_copy_of_its_own() -> None:
    obj = holed_grid()
    first = filled_and_textured(obj)
    meshes.enter(obj, np.arange(len(obj.data.polygons)) >= 16 * 16 - 64)
    assert run() == {"FINISHED"}
    meshes.leave()
    second = textured.shown(obj)
    assert second not in (first, bpy.data.images["Skin"])
    assert second.name.startswith("Skin.faired.")


def test_linked_images_and_materials_are_copied(tmp_path: Path) -> None:
    material = textured.material_of(textured.image_of(hidden(ramp), SIZE))
    path = str(tmp_path / "library.blend")
    bpy.data.libraries.write(path, {material}, fake_user=True)
    bpy.ops.wm.read_homefile(use_empty=True)
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.materials = ["Paint"]
    linked = bpy.data.materials["Paint"]
    obj = meshes.grid(16)
    textured.lay_out(obj, on_grid)
    obj.data.materials.append(linked)
    meshes.remove(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.5)
    before = textured.pixels(linked.node_tree.nodes["Colour"].image)
    copy = filled_and_textured(obj)
    assert copy.library is None and obj.data.materials[0].library is None
    assert linked.node_tree.nodes["Colour"].image.library is not None
    assert np.array_equal(textured.pixels(linked.node_tree.nodes["Colour"].image), before)
    v, u = (np.mgrid[:SIZE, :SIZE] + 0.5) / SIZE
    assert np.abs(textured.pixels(copy) - ramp(u, v))[inside()].max() < 1.01 / 255.0


def without_material(obj: bpy.types.Object) -> None:
    obj.data.materials.clear()


def without_image(obj: bpy.types.Object) -> None:
    obj.data.materials[0].node_tree.nodes["Colour"].image = None


def tiles(obj: bpy.types.Object) -> None:
    obj.data.materials[0].node_tree.nodes["Colour"].image = bpy.data.images.new("Tiles", 8, 8, tiled=True)


def movie(obj: bpy.types.Object) -> None:
    textured.shown(obj).source = "MOVIE"


def lost_file(obj: bpy.types.Object) -> None:
    image = bpy.data.images.new("Lost", 8, 8)
    image.source, image.filepath = "FILE", "/nowhere/lost.png"
    obj.data.materials[0].node_tree.nodes["Colour"].image = image


def generated_places(obj: bpy.types.Object) -> None:
    tree = obj.data.materials[0].node_tree
    node = tree.nodes.new("ShaderNodeTexCoord")
    tree.links.new(node.outputs["Generated"], tree.nodes["Colour"].inputs["Vector"])


def repeated(obj: bpy.types.Object) -> None:
    """The old faces cover all of the image, several times."""
    textured.lay_out(obj, lambda points, _: 2.0 * points[:, :2])


@pytest.mark.parametrize(
    ("spoil", "text"),
    [
        (without_material, "no material with an image"),
        (without_image, "No image gives the material 'Paint' its colour"),
        (tiles, "is no single one"),
        (movie, "is no single one"),
        (lost_file, "can't be read"),
        (generated_places, "something else than a UV map"),
        (repeated, "no free part for"),
    ],
)
def test_what_can_not_be_continued_is_refused(spoil: Any, text: str) -> None:
    """And nothing changes."""
    obj = holed_grid()
    spoil(obj)
    fill(obj)
    before = len(bpy.data.images), len(bpy.data.materials)
    with pytest.raises(RuntimeError, match=text):
        run()
    assert (len(bpy.data.images), len(bpy.data.materials)) == before
    meshes.leave()


def test_a_selection_without_textured_faces_around_is_refused() -> None:
    obj = holed_grid()
    meshes.enter(obj, np.ones(len(obj.data.polygons), dtype=bool))
    with pytest.raises(RuntimeError, match="None of the faces around"):
        run()
    meshes.leave()


def test_nothing_selected_does_nothing() -> None:
    obj = holed_grid()
    meshes.enter(obj, np.zeros(len(obj.data.polygons), dtype=bool))
    assert run() == {"CANCELLED"}
    meshes.leave()


def grainy(u: Floats, v: Floats) -> Floats:
    noise = 0.05 * np.random.default_rng(0).normal(size=u.shape)
    colours = np.repeat((0.5 + noise)[..., None], 4, axis=2)
    colours[..., 3] = 1.0
    colours[inside()] = 0.5
    return colours


@pytest.mark.parametrize("group", ["", "Good"])
def test_detail_has_the_grain_around(group: str) -> None:
    """Its spread, in proportion; without it the new colours are smooth."""
    obj = holed_grid(textured.image_of(grainy, SIZE, floats=True))
    good = [v.index for v in obj.data.vertices if v.co.x > 0.5]
    obj.vertex_groups.new(name="Good").add(good, 1.0, "REPLACE")
    spreads = {}
    for detail in (0.0, 0.5, 1.0):
        fill(obj) if detail == 0.0 else meshes.enter(obj, np.arange(len(obj.data.polygons)) >= 192)
        assert run(detail=detail, detail_from=group) == {"FINISHED"}
        meshes.leave()
        spreads[detail] = textured.pixels(textured.shown(obj))[inside(-8.0), 0].std()
    assert spreads[0.0] < 0.01
    assert spreads[1.0] == pytest.approx(0.05, rel=0.15)
    assert spreads[0.5] == pytest.approx(0.025, rel=0.2)


def test_detail_from_too_little_is_refused() -> None:
    obj = holed_grid()
    obj.vertex_groups.new(name="Good").add([0], 1.0, "REPLACE")
    fill(obj)
    with pytest.raises(RuntimeError, match="no square of"):
        run(detail=1.0, detail_from="Good")
    with pytest.raises(RuntimeError, match="Detail From: there is no vertex group named 'Bad'"):
        run(detail=1.0, detail_from="Bad")
    meshes.leave()


def test_a_new_mesh_gets_new_colours_too() -> None:
    """Remesh carries the map over; the colours of what was there go."""
    obj = meshes.grid(16)
    textured.lay_out(obj, on_grid)
    obj.data.materials.append(textured.material_of(textured.image_of(hidden(ramp), SIZE)))
    meshes.enter(obj, meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.5))
    assert meshes.run(remesh=True) == {"FINISHED"}
    assert run() == {"FINISHED"}
    meshes.leave()
    v, u = (np.mgrid[:SIZE, :SIZE] + 0.5) / SIZE
    assert np.abs(textured.pixels(textured.shown(obj)) - ramp(u, v))[inside()].max() < 1.01 / 255.0


def test_each_object_in_edit_mode_gets_a_copy_of_its_own() -> None:
    """They share a material, which is parted; in one of them it is the object's, not the mesh's."""
    image = textured.image_of(hidden(ramp), SIZE)
    first = holed_grid(image)
    second = first.copy()
    second.data = first.data.copy()
    second.name = "Second"
    bpy.context.collection.objects.link(second)
    second.material_slots[0].link = "OBJECT"
    second.material_slots[0].material = first.data.materials[0]
    for obj in (first, second):
        one_face(obj)
        meshes.leave()
    meshes.edit(first, second)
    assert run() == {"FINISHED"}
    meshes.leave()
    v, u = (np.mgrid[:SIZE, :SIZE] + 0.5) / SIZE
    copies = {textured.shown(obj) for obj in (first, second)}
    assert len(copies) == 2 and image not in copies
    for copy in copies:
        assert np.abs(textured.pixels(copy) - ramp(u, v))[inside()].max() < 1.01 / 255.0
    assert second.data.materials[0] != second.material_slots[0].material


def test_a_map_that_is_shifted_by_whole_images_is_read_as_it_shows() -> None:
    """The new face is beyond the image, so that it moves inside."""
    obj = holed_grid()
    textured.lay_out(obj, lambda points, _: in_a_corner(points) + np.array([-2.0, 1.0]))
    select_vertices(obj, lambda co: max(abs(co.x), abs(co.y)) < 0.9)
    bpy.ops.mesh.edge_face_add()
    assert run() == {"FINISHED"}
    meshes.leave()
    new = obj.data.polygons[-1]
    uv = textured.places(obj)[list(new.loop_indices)]
    assert uv.min() > 0.0 and uv.max() < 1.0
    wanted = ramp(*in_a_corner(meshes.positions(obj)[list(new.vertices)]).T)
    x, y = np.floor(uv * SIZE).astype(int).T
    assert np.abs(textured.pixels(textured.shown(obj))[y, x] - wanted).max() < 3.0 / 255.0


def test_the_named_map_is_read_and_the_other_one_stays() -> None:
    obj = holed_grid(textured.image_of(hidden(ramp), SIZE))
    obj.data.materials[0] = textured.material_of(textured.shown(obj), "Named", uv_map="Map")
    textured.lay_out(obj, lambda points, _: 0.1 * points[:, :2], "Other")
    obj.data.uv_layers["Other"].active = obj.data.uv_layers["Other"].active_render = True
    one_face(obj)
    meshes.leave()
    before = textured.places(obj, "Other")
    meshes.edit(obj)
    assert run() == {"FINISHED"}
    meshes.leave()
    v, u = (np.mgrid[:SIZE, :SIZE] + 0.5) / SIZE
    assert np.abs(textured.pixels(textured.shown(obj)) - ramp(u, v))[inside()].max() < 1.01 / 255.0
    assert np.array_equal(textured.places(obj, "Other"), before)


@pytest.mark.parametrize(("scale", "harmonic"), [(3.0, False), (1.0, False), (1.0 / 3.0, True)])
def test_an_object_is_measured_in_world_space(scale: float, harmonic: bool) -> None:
    """There x² − y² / 9 of the mesh is harmonic where y is a third as long; else another function goes on."""

    def saddle(u: Floats, v: Floats) -> Floats:
        x, y = (u - 0.5) / FLAT, (v - 0.5) / FLAT
        level = 0.5 + 0.3 * (x**2 - y**2 / 9.0)
        return np.stack([level, level, level, np.ones_like(u)], axis=-1)

    obj = holed_grid(textured.image_of(hidden(saddle), SIZE, floats=True))
    obj.scale = (1.0, scale, 1.0)
    one_face(obj)
    assert run() == {"FINISHED"}
    meshes.leave()
    v, u = (np.mgrid[:SIZE, :SIZE] + 0.5) / SIZE
    error = np.abs(textured.pixels(textured.shown(obj)) - saddle(u, v))[inside()].max()
    assert (error < 0.5 / 255.0) == harmonic
    assert harmonic or error > 0.01
