"""What the sources keep: reasons beside constants, includes that point one way, and mutants that fit the tree."""

import re
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
sys.path.append(str(ROOT / "scripts"))

from limits import limits  # noqa: E402


def test_every_constant_has_a_reason_beside_it() -> None:
    found = list(limits(ROOT / "native"))
    assert len(found) > 300  # the pattern still finds them
    assert [f"{each.file.relative_to(ROOT)}:{each.line} {each.name}" for each in found if not each.reason] == []


def test_constants_of_one_run_share_the_comment_over_it_and_no_others(tmp_path: Path) -> None:
    (tmp_path / "a.cpp").write_text(
        "// Of both.\nconstexpr int one = 1;\nconstexpr int two = 2;\n\nconstexpr int three = 3;\n"
        "constexpr double four{4.0};  // edges\nconstexpr int function(int five = 5);\n"
    )
    found = [(each.name, each.value, each.reason) for each in limits(tmp_path)]
    assert found == [("one", "1", "Of both."), ("two", "2", "Of both."), ("three", "3", ""), ("four", "4.0", "edges")]


# Each row of scripts/mutants.toml fits the tree: its text is there once, and so are its tests.
ROWS = tomllib.loads((ROOT / "scripts" / "mutants.toml").read_text(encoding="utf-8"))["mutant"]


CASES = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "tests" / "native").glob("*.cpp"))


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["name"])
def test_a_row_fits_the_tree(row: dict) -> None:
    assert (ROOT / row["file"]).read_text(encoding="utf-8").count(row["find"]) == 1
    assert row["caught_by"]
    for test in row["caught_by"]:
        assert exists(test), test


def exists(test: str) -> bool:
    """Whether there is a C++ case or a Python test of that name."""
    if test.startswith("unit: "):
        name = re.escape(test.removeprefix("unit: "))
        return re.search(rf'TEST_CASE\(\s*"{name}"', CASES) is not None
    path, _, name = test.partition("::")
    text = (ROOT / path).read_text(encoding="utf-8")
    return not name or f"def {name.partition('[')[0]}(" in text


# Includes: the parts of Eigen that sources use, or builds without precompiled headers fail; and one way only.
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
