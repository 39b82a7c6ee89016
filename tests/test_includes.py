"""Sources ask for the parts of Eigen that they use: builds without precompiled headers can't load otherwise."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

NATIVE = Path(__file__).parents[1] / "native"
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
