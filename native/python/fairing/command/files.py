"""Meshes in files: OBJ and OFF by what stands beside, other formats by plyfile, trimesh or meshio (extra `io`)."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from types import SimpleNamespace
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


_CELLS = ("meshio", SimpleNamespace(read=_read_cells, write=_write_cells))
_SCENES = ("trimesh", scenes)
# The library of each format, and what reads and writes by it. What one can't read the next reads; the first one writes.
_KINDS: dict[str, tuple[tuple[str, Any], ...]] = {
    ".ply": (("plyfile", ply),), ".obj": (("fairing", obj),), ".off": (("fairing", off),), ".stl": (_SCENES, _CELLS),
    **dict.fromkeys((".glb", ".gltf", ".3mf"), (_SCENES,)),
    **dict.fromkeys((".vtk", ".vtu", ".msh", ".xdmf", ".inp", ".med", ".su2", ".mesh"), (_CELLS,)),
    **dict.fromkeys((".bdf", ".nas", ".dat", ".avs"), (_CELLS,)),
}  # fmt: skip


def read(source: Path) -> tuple[Parts, Write]:
    """The mesh, and what writes a mesh like it and tells what can't be written; ValueError where it can't be read."""
    kind = source.suffix.lower()
    if not source.is_file():
        raise ValueError(f"{source}: there is no such file")
    reasons = []
    for library, module in _libraries(kind):
        name = library.__name__
        try:
            with np.errstate(all="ignore"):
                parts, known = module.read(library, source)
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
    library, module = next(_libraries(target.suffix.lower()))
    known = read[2] if read[:2] == (target.suffix.lower(), library.__name__) else None
    try:
        lost: list[str] = module.write(library, target, parts, known)
    except (Exception, SystemExit) as error:
        raise ValueError(f"{target}: {library.__name__} stops: {error!r}") from error
    return lost


def check(kind: str) -> None:
    """ValueError where a format can't be written here."""
    next(_libraries(kind))


def _libraries(kind: str) -> Iterator[tuple[Any, Any]]:
    """Those of a format that are installed, with what reads and writes by them; ValueError where none is."""
    if kind not in _KINDS:
        raise ValueError(f"{kind or 'a name without an ending'}: unknown format; known are {' '.join(_KINDS)}")
    found = False
    for name, module in _KINDS[kind]:
        try:
            library = importlib.import_module(name)
        except ImportError:
            continue
        found = True
        yield library, module
    if not found:
        names = " or ".join(name for name, _ in _KINDS[kind])
        raise ValueError(f"{kind} needs {names}: pip install 'intrinsic-fairing[io]'")
