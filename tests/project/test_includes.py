"""Includes: the parts of Eigen that sources use, or builds without precompiled headers fail; and one way only."""

import re
from pathlib import Path

import pytest

NATIVE = Path(__file__).parents[2] / "native"
GEOMETRY = re.compile(
    r"\.cross\(|\bQuaternion|\bAngleAxis|\.unitOrthogonal\("
)  # declared everywhere, defined there alone
GIVES_IT = re.compile(r"#include <Eigen/(Geometry|Eigenvalues|Dense)>")


def closure(file: Path, seen: dict[Path, str]) -> dict[Path, str]:
    """Texts of a source and of our headers that it includes, at whatever remove."""
    if file not in seen:
        seen[file] = file.read_text(encoding="utf-8")
        for name in re.findall(r'#include "([^"]+)"', seen[file]):
            found = next((place for place in (NATIVE / name, file.parent / name) if place.exists()), None)
            if found is not None:
                closure(found, seen)
    return seen


@pytest.mark.parametrize("room", sorted(path.name for path in NATIVE.iterdir() if path.is_dir()))
def test_who_uses_geometry_includes_it(room: str) -> None:
    texts = {file: "".join(closure(file, {}).values()) for file in (NATIVE / room).rglob("*.cpp")}
    assert [file.name for file, text in texts.items() if GEOMETRY.search(text) and not GIVES_IT.search(text)] == []


def test_includes_between_folders_point_one_way() -> None:
    arrows = {
        folder.name: {
            name
            for file in [*folder.glob("*.h"), *folder.glob("*.cpp")]
            for name in re.findall(r'^#include "(\w+)/', file.read_text(encoding="utf-8"), re.MULTILINE)
        }
        - {folder.name}
        for folder in NATIVE.iterdir()
        if folder.is_dir()
    }
    done: set[str] = set()
    while len(done) < len(arrows):
        ready = {folder for folder, needed in arrows.items() if folder not in done and needed <= done}
        assert ready, f"in a ring: {sorted(set(arrows) - done)}"
        done |= ready
