"""A mesh that new vertices and faces are written to, as a bmesh, in either mode."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import bmesh
import bpy

from ..mirror.reflected import Whole
from .halved import Mirror
from .layers import Shapes
from .mesh_io import user_of
from .set_aside import SetAside, has_unreached
from .weights import bone_groups


@dataclass(frozen=True)
class Target:
    """The bmesh, and what belongs to it apart from its layers."""

    bm: Any
    shapes: Shapes
    aside: SetAside
    bones: list[int]  # vertex groups of bones
    edited: bpy.types.Mesh | None  # the mesh whose edit mode shows the bmesh
    mirror: Mirror

    def open(self) -> bool:
        """Take out what must not be there when elements are made; before, nothing about the mesh has changed.

        Returns whether there was something: elements that were looked up before are of no use then.
        """
        if self.edited is None or not self.aside or self.aside.is_numbered:
            return False
        self.aside.take_out(self.edited)
        self.aside.number(self.bm)
        return True


@contextmanager
def in_edit_mode(obj: bpy.types.Object, whole: Whole | None = None) -> Iterator[Target]:
    """Give the mesh of an object in edit mode, and show what was done.

    whole: with the images of which the mesh was solved, which it has for a while.
    """
    mesh = obj.data
    bm = bmesh.from_edit_mesh(mesh)
    shapes = Shapes(bm, mesh.shape_keys, obj.active_shape_key)
    aside = _read_edit_mesh(mesh, bm)
    target = Target(bm, shapes, aside, bone_groups(obj), mesh, Mirror(bm, whole, mesh.use_mirror_x))
    try:
        if whole is not None:
            target.open()
        with target.mirror.images():
            yield target
    finally:
        bmesh.update_edit_mesh(mesh)
        if aside.is_numbered:  # they come back whatever has happened
            _reload(obj, aside)


@contextmanager
def in_object_mode(mesh: bpy.types.Mesh, whole: Whole | None = None) -> Iterator[Target]:
    """Give a mesh in object mode likewise, its Basis shown, and write that back."""
    aside = SetAside(mesh)
    bm = bmesh.new()
    try:
        _load(bm, mesh, aside)
        keys = mesh.shape_keys
        shapes = Shapes(bm, keys, None if keys is None else keys.reference_key)
        target = Target(bm, shapes, aside, bone_groups(user_of(mesh)), None, Mirror(bm, whole, mesh.use_mirror_x))
        with target.mirror.images():
            yield target
        bm.to_mesh(mesh)
        aside.put_back(mesh)
    finally:
        bm.free()
    mesh.update()


def _read_edit_mesh(mesh: bpy.types.Mesh, bm: Any) -> SetAside:
    copy = bpy.data.meshes.new("fairing attributes")
    try:
        if has_unreached(mesh):
            bm.to_mesh(copy)
        return SetAside(copy)
    finally:
        bpy.data.meshes.remove(copy)


def _load(bm: Any, mesh: bpy.types.Mesh, aside: SetAside) -> None:
    """Read a mesh in object mode into a bmesh, without what is set aside."""
    if not aside:
        bm.from_mesh(mesh)
        return
    copy = mesh.copy()  # with shape keys
    try:
        aside.take_out(copy)
        bm.from_mesh(copy)
        aside.number(bm)
    finally:
        bpy.data.meshes.remove(copy)


def _reload(obj: bpy.types.Object, aside: SetAside) -> None:
    """Put the attributes back where Blender allows it, in a mesh in object mode, and edit that."""
    obj.update_from_editmode()  # moves shape keys, too, as at the end of edit mode
    copy = obj.data.copy()
    try:
        aside.put_back(copy)
        _edit(obj, copy)
    finally:
        bpy.data.meshes.remove(copy)


def _edit(obj: bpy.types.Object, content: bpy.types.Mesh) -> None:
    """Let an object in edit mode have what a mesh in object mode holds."""
    bm = bmesh.from_edit_mesh(obj.data)
    modes = set(bm.select_mode)
    bm.clear()
    bm.from_mesh(content, use_shape_key=True, shape_key_index=obj.active_shape_key_index)
    bm.select_mode = modes
    bm.normal_update()
    bmesh.update_edit_mesh(obj.data)


@contextmanager
def restored(objects: Sequence[bpy.types.Object]) -> Iterator[None]:
    """Give objects in edit mode back what they were where what is done to them raises."""
    before = []
    try:
        for obj in objects:
            keyed = obj.data.shape_keys is not None
            before.append(obj.data.copy() if keyed else bpy.data.meshes.new("fairing before"))
            bmesh.from_edit_mesh(obj.data).to_mesh(before[-1])
        yield
    except BaseException:
        for obj, content in zip(objects, before, strict=False):
            _edit(obj, content)
        raise
    finally:
        for content in before:
            bpy.data.meshes.remove(content)
