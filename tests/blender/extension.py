"""The installed extension's modules; imported late, when conftest has installed it."""

import importlib
from dataclasses import asdict
from typing import Any

import meshes

ID = "bl_ext.user_default.intrinsic_fairing"


def module(name: str = "") -> Any:
    """Return the extension's package, or one of its modules."""
    return importlib.import_module(f"{ID}.{name}" if name else ID)


def inspect(obj: Any, faces: Any, **options: Any) -> Any:
    """Return what the panel would tell about these faces of an object in object mode."""
    meshes.enter(obj, faces)
    try:
        return module("selection.inspection").inspect(obj, module("options.options").FairOptions(**options))
    finally:
        meshes.leave()


def give_options(stand: Any, **chosen: Any) -> Any:
    """Give a stand-in for the operator `mesh.fair_region` its options, and return it."""
    for name, value in {**asdict(module("options.options").FairOptions()), **chosen}.items():
        setattr(stand, name, value)
    return stand


def stand_in(operator: Any, **own: Any) -> Any:
    """Return an object with an operator's methods, which Blender alone can make; `reported` has what it says."""
    ours = [kind for kind in reversed(operator.__mro__) if kind.__module__.startswith(ID)]
    names = {name: value for kind in ours for name, value in vars(kind).items() if not name.startswith(("__", "bl_"))}
    stand = type("Stand", (), {**names, **own})()
    stand.reported = []
    stand.report = lambda kinds, text: stand.reported.append((kinds, text))
    return stand
