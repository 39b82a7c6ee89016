"""The add-on's modules: what touches Blender stays apart from what doesn't, and nobody imports in a ring."""

import ast
from pathlib import Path

import pytest

ADDON = Path(__file__).parents[2] / "addon"
BLENDER = {"bpy", "bmesh", "mathutils", "gpu", "gpu_extras", "blf", "bl_ui", "addon_utils", "idprop", "imbuf"}
FOLDERS = sorted({path.parent for path in ADDON.rglob("*.py")} - {ADDON})


def module(path: Path) -> str:
    return path.relative_to(ADDON).with_suffix("").as_posix()


def imported(path: Path) -> tuple[set[str], set[str]]:
    """Modules of the add-on that a file imports, within functions too, and those of Blender."""
    ours, blender = set[str](), set[str]()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            blender |= {alias.name.split(".")[0] for alias in node.names} & BLENDER
        elif isinstance(node, ast.ImportFrom) and not node.level:
            blender |= {str(node.module).split(".")[0]} & BLENDER
        elif isinstance(node, ast.ImportFrom):
            folder = path.parents[node.level - 1].joinpath(*(node.module or "").split("."))
            found = [folder.with_suffix(".py"), *(folder / f"{alias.name}.py" for alias in node.names)]
            ours |= {module(each) for each in found if each.is_file()}
    return ours, blender


MODULES = {module(path): imported(path) for path in ADDON.rglob("*.py") if path.parent != ADDON}


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_a_folder_says_what_it_is_for_and_holds_no_code_of_its_own(folder: Path) -> None:
    tree = ast.parse((folder / "__init__.py").read_text(encoding="utf-8"))
    assert ast.get_docstring(tree)
    assert len(tree.body) == 1


@pytest.mark.parametrize("name", [name for name, (_, blender) in MODULES.items() if not blender])
def test_what_needs_no_blender_imports_nothing_that_does(name: str) -> None:
    if not name.startswith("mesh/"):
        assert {other for other in MODULES[name][0] if other in MODULES and MODULES[other][1]} == set()


def test_bmesh_is_touched_in_one_folder() -> None:
    assert {name.split("/")[0] for name, (_, blender) in MODULES.items() if "bmesh" in blender} == {"mesh"}


def test_nothing_imports_in_a_ring() -> None:
    done: set[str] = set()
    while len(done) < len(MODULES):
        ready = {name for name, (ours, _) in MODULES.items() if name not in done and ours & set(MODULES) <= done}
        assert ready, sorted(set(MODULES) - done)
        done |= ready
