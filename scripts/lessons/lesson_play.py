"""Plays a lesson's steps in Blender without a window. A step that is not understood is an error."""

from __future__ import annotations

from typing import Any, NamedTuple

import bmesh
import bpy
import numpy as np

from lesson_page import Step, Value

AXES = {"X": 0, "Y": 1, "Z": 2}
# Entries of menus with a text of their own: what they run, and with which options.
ENTRIES: dict[str, tuple[str, dict[str, Value]]] = {"Fair Bridge": ("fair_fill", {"bridge": True})}


class Run(NamedTuple):
    """An operator of meshes, the options that the page names after it, and those of the entry itself."""

    operator: str
    options: dict[str, Value]
    given: dict[str, Value]


class Move(NamedTuple):
    """What is selected is moved along an axis."""

    axis: str
    by: float


class Key(NamedTuple):
    """A key of Blender's own: Tab, A, or B with a box around what lies above the selection."""

    name: str


def labels() -> dict[str, str]:
    """The identifiers of this extension's operators of meshes, by their labels."""
    known = (name for name in dir(bpy.ops.mesh) if name.startswith("fair_"))
    return {getattr(bpy.ops.mesh, name).get_rna_type().name: name for name in known}


def actions(steps: list[Step]) -> list[Run | Move | Key]:
    """What to do; ValueError for words that name nothing."""
    known, found = labels(), list[Run | Move | Key]()
    rest = list(steps)
    while rest:
        step = rest.pop(0)
        if step.kind == "option":
            if not found or not isinstance(found[-1], Run):
                raise ValueError(f"{step.name}: an option of what?")
            found[-1].options.update([option(found[-1].operator, step)])
        elif step.name == "G":
            axis, by = rest.pop(0), rest.pop(0)
            found.append(Move(axis.name, float(by.name)))
        elif step.name in ("Tab", "A", "B"):
            found.append(Key(step.name))
        elif (label := step.name.split(" ▸ ")[-1]) in known:
            found.append(Run(known[label], {}, {}))
        elif label in ENTRIES:
            operator, given = ENTRIES[label]
            found.append(Run(operator, {}, given))
        elif step.name not in ("Enter", "Alt Z"):
            raise ValueError(f"{step.name!r} is no key, menu or button")
    return found


def option(operator: str, step: Step) -> tuple[str, Value]:
    """An option's identifier and value, by the labels that the panel shows."""
    offered = getattr(bpy.ops.mesh, operator).get_rna_type().properties
    match = [each for each in offered if each.name == step.name and not each.is_hidden]
    if len(match) != 1:
        raise ValueError(f"{operator} has no option {step.name!r}")
    (chosen,) = match
    if chosen.type == "ENUM":
        items = [item.identifier for item in chosen.enum_items if item.name == step.value]
        if not items:
            raise ValueError(f"{step.name} has no option {step.value!r}")
        return chosen.identifier, items[0]
    assert step.value is not None
    return chosen.identifier, step.value


def play(steps: list[Step]) -> None:
    """Do it, from the file that is open."""
    for action in actions(steps):
        if isinstance(action, Run):
            getattr(bpy.ops.mesh, action.operator)("EXEC_DEFAULT", True, **action.given, **action.options)
        elif isinstance(action, Move):
            move(action)
        elif action.name == "Tab":
            bpy.ops.object.editmode_toggle()
        elif action.name == "B":
            box_above()
        else:
            bpy.ops.mesh.select_all(action="SELECT")


def box_above() -> None:
    """Select the faces above those selected, as a box does that is drawn around them with X-ray on."""
    bm = bmesh.from_edit_mesh(bpy.context.edit_object.data)
    top = max(vertex.co.z for vertex in bm.verts if vertex.select)
    above = [face for face in bm.faces if min(vertex.co.z for vertex in face.verts) >= top]
    bpy.ops.mesh.select_all(action="DESELECT")
    for face in above:
        face.select_set(True)
    bmesh.update_edit_mesh(bpy.context.edit_object.data)


def move(action: Move) -> None:
    """As a drag does: vertices are moved, and Blender updates the scene, which Live listens to."""
    mesh: Any = bpy.context.edit_object.data
    bm = bmesh.from_edit_mesh(mesh)
    by = np.zeros(3)
    by[AXES[action.axis]] = action.by
    for vertex in bm.verts:
        if vertex.select:
            vertex.co += vertex.co.__class__(by)
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
    bpy.context.view_layer.update()
