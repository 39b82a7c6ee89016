"""Meshes in files, by meshio or trimesh (extra `io`): whichever reads the one format and writes the other."""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import Any

_MESHIO = {".ply", ".off", ".stl", ".vtk", ".vtu", ".msh", ".xdmf", ".inp", ".med", ".su2"}
_TRIMESH = {".obj", ".glb", ".gltf", ".3mf", ".ply", ".off", ".stl"}


def library_for(source: Path, target: Path) -> str:
    """Name the library; ValueError where none knows both formats."""
    both = {source.suffix.lower(), target.suffix.lower()}
    for name, known in (("meshio", _MESHIO), ("trimesh", _TRIMESH)):
        if both <= known:
            return name
    raise ValueError(
        f"{source.name} to {target.name}: one library has to know both formats; meshio knows "
        f"{' '.join(sorted(_MESHIO))}, trimesh {' '.join(sorted(_TRIMESH))}"
    )


def read(source: Path, library: str) -> Any:
    """The mesh; ValueError where the library is missing or the file holds no single mesh."""
    try:
        module = importlib.import_module(library)
    except ImportError as error:
        raise ValueError(f"{source.name} needs {library}: pip install 'intrinsic-fairing[io]'") from error
    if not source.is_file():
        raise ValueError(f"{source}: there is no such file")
    if source.suffix.lower() == ".ply" and not _has_header(source):
        raise ValueError(f"{source}: is no PLY file: its header has no end")
    if library == "meshio":
        try:
            return module.read(source)
        except (SystemExit, module.ReadError) as error:  # of a broken file it ends the program
            raise ValueError(f"{source}: meshio can't read it: {error}") from error
    try:
        mesh = module.load(source, force="mesh", process=False)
    except (NotImplementedError, KeyError, IndexError, TypeError) as error:
        raise ValueError(f"{source}: trimesh can't read it: {error}") from error
    if not hasattr(mesh, "faces"):
        raise ValueError(f"{source}: holds no mesh")
    return mesh


def _has_header(source: Path) -> bool:
    """Whether a PLY file has one; without its end meshio would read for ever."""
    with source.open("rb") as file:
        return b"end_header" in file.read(1 << 20)


def write(mesh: Any, target: Path) -> None:
    """Write the mesh; both libraries go by the name."""
    target.parent.mkdir(parents=True, exist_ok=True)
    if hasattr(mesh, "write"):
        mesh.write(target)
    else:
        mesh.export(target)
