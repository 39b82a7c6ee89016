"""The picture of the rooms in docs/architecture.md is what includes and imports say."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


@pytest.fixture
def house(tmp_path: Path) -> Path:
    """A copy of what the picture is drawn from, with the picture."""
    copied = shutil.ignore_patterns("__pycache__", "*.pyi")
    for folder in ("native", "addon"):
        shutil.copytree(ROOT / folder, tmp_path / folder, ignore=copied)
    (tmp_path / "scripts").mkdir()
    (tmp_path / "docs/pictures").mkdir(parents=True)
    for file in ("scripts/draw_house.py", "docs/pictures/house.svg"):
        shutil.copy(ROOT / file, tmp_path / file)
    return tmp_path


def check(house: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, house / "scripts/draw_house.py", "--check"]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def include(house: Path, source: str, header: str) -> None:
    path = house / source
    path.write_text(f'#include "{header}"\n{path.read_text(encoding="utf-8")}', encoding="utf-8")


def test_the_picture_is_up_to_date() -> None:
    done = check(ROOT)
    assert done.returncode == 0, done.stderr


def test_a_circle_is_refused(house: Path) -> None:
    include(house, "native/base/errors.h", "mesh/patch.h")
    done = check(house)
    assert done.returncode != 0
    assert "native/base needs itself" in done.stderr or "native/mesh needs itself" in done.stderr


def test_every_room_is_on_the_page() -> None:
    picture = (ROOT / "docs/pictures/house.svg").read_text(encoding="utf-8")
    page = (ROOT / "docs/architecture.md").read_text(encoding="utf-8")
    rooms = re.findall(r">((?:native|addon)/\w+)<", picture)
    assert len(rooms) >= 20
    assert [room for room in rooms if f"`{room}`" not in page] == []
