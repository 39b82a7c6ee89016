"""Meshes in files: PLY, OFF, OBJ and STL by what stands beside, other formats by meshio or trimesh (extra `io`)."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from fairing.command import obj, off, ply, scenes, stl
from fairing.objects.hosts import opened
from fairing.objects.parts import Parts

_OWN: dict[str, Any] = {".ply": ply, ".off": off, ".obj": obj, ".stl": stl}
_LIBRARIES = {
    "trimesh": (".glb", ".gltf", ".3mf"),
    "meshio": (".vtk", ".vtu", ".msh", ".xdmf", ".inp", ".med", ".su2", ".mesh", ".bdf", ".nas", ".dat", ".avs"),
}
Write = Callable[[Path, Parts], list[str]]


def read(source: Path) -> tuple[Parts, Write]:
    """The mesh, and what writes a mesh like it and tells what can't be written; ValueError where it can't be read."""
    kind = source.suffix.lower()
    if not source.is_file():
        raise ValueError(f"{source}: there is no such file")
    if kind in _OWN:
        try:
            with np.errstate(all="ignore"):
                parts, header = _OWN[kind].read(source)
            if not len(parts.faces.sizes):
                raise ValueError("it has no faces")
        except (ValueError, IndexError, KeyError, TypeError, OverflowError) as error:
            said = error if isinstance(error, ValueError) else "it is damaged, or ends too early"
            raise ValueError(f"{source}: can't be read: {said}") from error
        return parts, lambda target, made: _written(target, made, header if target.suffix.lower() == kind else None)
    library = _library(kind)
    with _told(library, source):
        if library.__name__ == "trimesh":
            parts, write = scenes.read(library, source)
        else:
            parts, make = opened(library.read(source))

            def write(target: Path, made: Parts) -> list[str]:
                make(made).write(target)
                return []

    def written(target: Path, made: Parts) -> list[str]:
        if target.suffix.lower() != kind:
            return _written(target, made, None)
        with _told(library, target):
            gone: list[str] = write(target, made)
        return gone

    return parts, written


@contextmanager
def _told(library: Any, path: Path) -> Iterator[None]:
    """ValueError for anything that a library raises: of broken files they end the program, too."""
    try:
        yield
    except (Exception, SystemExit) as error:
        raise ValueError(f"{path}: {library.__name__} stops: {error!r}") from error


def _written(target: Path, parts: Parts, header: Any) -> list[str]:
    """By what writes the format; ``header``: what a file of that format said besides."""
    kind = target.suffix.lower()
    if kind in _OWN:
        found: list[str] = _OWN[kind].write(target, parts, header)
        return found
    library = _library(kind)
    with _told(library, target):
        if library.__name__ == "trimesh":
            library.Trimesh(parts.points, parts.own, process=False).export(target)
            return sorted({*parts.vertex_data, *parts.face_data})
        empty = library.Mesh(parts.points[:3], [("triangle", [[0, 1, 2]])])
        opened(empty)[1](parts).write(target)
    return []


def check(kind: str) -> None:
    """ValueError where a format can't be written here."""
    if kind not in _OWN:
        _library(kind)


def _library(kind: str) -> Any:
    for name, kinds in _LIBRARIES.items():
        if kind in kinds:
            try:
                return importlib.import_module(name)
            except ImportError as error:
                raise ValueError(f"{kind} needs {name}: pip install 'intrinsic-fairing[io]'") from error
    known = " ".join([*_OWN, *(each for kinds in _LIBRARIES.values() for each in kinds)])
    raise ValueError(f"{kind or 'a name without an ending'}: no format that is known; those are {known}")
