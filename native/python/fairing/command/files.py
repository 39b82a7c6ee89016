"""Meshes in files: OBJ by what stands beside, other formats by plyfile, trimesh or meshio (extra `io`)."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from fairing.command import obj, off, ply, scenes
from fairing.objects.hosts import opened
from fairing.objects.parts import Parts

Write = Callable[[Path, Parts], list[str]]


def _read_cells(meshio: Any, source: Path) -> tuple[Parts, Any]:
    return opened(meshio.read(source))


def _write_cells(meshio: Any, target: Path, parts: Parts, make: Any) -> list[str]:
    make = make or opened(meshio.Mesh(np.zeros((3, 3)), [("triangle", [[0, 1, 2]])]))[1]
    make(parts).write(target)
    return []


_OWN: dict[str, Any] = {".obj": obj, ".off": off}
_READ: dict[str, Callable[[Any, Path], tuple[Parts, Any]]] = {
    "fairing": lambda _, source: _OWN[source.suffix.lower()].read(source),
    "plyfile": ply.read,
    "trimesh": scenes.read,
    "meshio": _read_cells,
}
_WRITE: dict[str, Callable[[Any, Path, Parts, Any], list[str]]] = {
    "fairing": lambda _, target, *what: _OWN[target.suffix.lower()].write(target, *what),
    "plyfile": ply.write,
    "trimesh": scenes.write,
    "meshio": _write_cells,
}
# What a library can't read the next one reads; the first one writes.
_KINDS = {
    ".ply": ("plyfile",), **dict.fromkeys(_OWN, ("fairing",)), ".stl": ("trimesh", "meshio"),
    **dict.fromkeys((".glb", ".gltf", ".3mf"), ("trimesh",)),
    **dict.fromkeys((".vtk", ".vtu", ".msh", ".xdmf", ".inp", ".med", ".su2", ".mesh"), ("meshio",)),
    **dict.fromkeys((".bdf", ".nas", ".dat", ".avs"), ("meshio",)),
}  # fmt: skip


def read(source: Path) -> tuple[Parts, Write]:
    """The mesh, and what writes a mesh like it and tells what can't be written; ValueError where it can't be read."""
    kind = source.suffix.lower()
    if not source.is_file():
        raise ValueError(f"{source}: there is no such file")
    reasons = []
    for library in _libraries(kind):
        name = library.__name__
        try:
            with np.errstate(all="ignore"):
                parts, known = _READ[name](library, source)
                if not len(parts.faces.sizes):
                    raise ValueError("it has no faces")
        except (Exception, SystemExit) as error:  # libraries raise anything, and meshio ends the program
            kind_of = "" if isinstance(error, ValueError) else f" {type(error).__name__}:"
            reasons.append(f"{name}:{kind_of} {error}")
        else:
            return parts, partial(_written, (kind, name, known))
    raise ValueError(f"{source}: can't be read: {'; '.join(reasons)}")


def _written(read: tuple[str, str, Any], target: Path, parts: Parts) -> list[str]:
    """``read``: the format, the library that read it, and what the file said besides."""
    kind = target.suffix.lower()
    library = next(_libraries(kind))
    name = library.__name__
    try:
        return _WRITE[name](library, target, parts, read[2] if read[:2] == (kind, name) else None)
    except (Exception, SystemExit) as error:
        raise ValueError(f"{target}: {name} stops: {error!r}") from error


def check(kind: str) -> None:
    """ValueError where a format can't be written here."""
    next(_libraries(kind))


def _libraries(kind: str) -> Iterator[Any]:
    """Those of a format that are installed; ValueError where none is."""
    if kind not in _KINDS:
        raise ValueError(f"{kind or 'a name without an ending'}: no format that is known; those are {' '.join(_KINDS)}")
    found = False
    for name in _KINDS[kind]:
        try:
            library = importlib.import_module(name)
        except ImportError:
            continue
        found = True
        yield library
    if not found:
        raise ValueError(f"{kind} needs {' or '.join(_KINDS[kind])}: pip install 'intrinsic-fairing[io]'")
