"""Makes the changes of mutants.toml in a copy of the tree, one at a time, and tells which of them no test notices.

mutate.py FOLDER [NAME…]
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import time
import tomllib
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[1]
TABLE = ROOT / "scripts" / "mutants.toml"
# What the engine, its module and their tests are built from and read.
PARTS = (
    "CMakeLists.txt",
    "CMakePresets.json",
    "pyproject.toml",
    "README.md",
    "native",
    "addon",
    "tests",
    "scripts",
    "docs",
)
LONGEST_TEST = 300.0  # seconds; a mutant that makes a test hang is noticed too
UNIT = "unit: "


class BrokenTable(Exception):
    """A row that doesn't fit the tree: its text isn't there, or its tests don't run or fail as it is."""


@dataclass(frozen=True)
class Mutant:
    """A change of one file, and the tests of which each must fail: "unit: CASE" of the C++ tests, or pytest's."""

    name: str
    file: str
    find: str
    replace: str
    caught_by: list[str]

    def text(self, original: str) -> str:
        """The file with the change; the text to find must be there exactly once."""
        if original.count(self.find) != 1:
            raise BrokenTable(
                f"{self.name}: {self.file} holds {self.find!r} {original.count(self.find)} times, not once"
            )
        return original.replace(self.find, self.replace)


class Copy:
    """The tree that is changed and built: its build is kept, so that a change compiles what depends on it."""

    def __init__(self, folder: Path) -> None:
        self._tree = folder / "tree"
        self._build = self._tree / "build" / "native"
        self._package = self._build / "package"

    def refresh(self) -> None:
        """Bring the copy up to date; files that are the same keep their times."""
        self._tree.mkdir(parents=True, exist_ok=True)
        wanted = {path.relative_to(ROOT) for part in PARTS for path in _files(ROOT / part)}
        for path in [p.relative_to(self._tree) for part in PARTS for p in _files(self._tree / part)]:
            if path not in wanted:
                (self._tree / path).unlink()
        for path in wanted:
            _write(self._tree / path, (ROOT / path).read_bytes())

    def configure(self) -> None:
        """Prepare the build with this Python; what a change leaves unused may be warned of."""
        folder = subprocess.check_output([sys.executable, "-m", "pybind11", "--cmakedir"], text=True).strip()
        options = [f"-Dpybind11_DIR={folder}", f"-DPython_EXECUTABLE={sys.executable}"]
        self._run(["cmake", "--preset", "dev", "-DFAIRING_WARNINGS_AS_ERRORS=OFF", *options])

    def change(self, mutant: Mutant) -> None:
        """Make the change."""
        path = self._tree / mutant.file
        _write(path, mutant.text(path.read_text(encoding="utf-8")).encode())

    def build(self, tests: list[str]) -> None:
        """Build what these tests run."""
        targets = []
        if any(test.startswith(UNIT) for test in tests):
            targets.append("fairing_unit_tests")
        if not all(test.startswith(UNIT) for test in tests):
            targets.append("_core")
        for target in targets:
            parallel = ["--parallel", str(os.cpu_count())]
            self._run(["cmake", "--build", "--preset", "dev", "--target", target, *parallel])
        if "_core" in targets:
            shutil.rmtree(self._package, ignore_errors=True)
            shutil.copytree(self._tree / "native" / "python", self._package)
            for module in (self._build / "native").glob("_core.*"):
                shutil.copy(module, self._package / "fairing")

    def passes(self, test: str) -> bool:
        """Run one test; raises BrokenTable where there is no such test."""
        unit = test.startswith(UNIT)
        program = self._build / "tests" / "native" / "fairing_unit_tests"
        # A comma would end doctest's pattern; ? stands for any one character.
        pattern = test.removeprefix(UNIT).replace(",", "?")
        command = [str(program), f"--test-case={pattern}"]
        if not unit:
            command = [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", test]
        try:
            done = self._done(command, LONGEST_TEST)
        except subprocess.TimeoutExpired:
            return False
        crashed = done.returncode < 0
        ran = re.search(r"test cases: +[1-9]", done.stdout) if unit else done.returncode in (0, 1)
        if not ran and not crashed:
            raise BrokenTable(f"{test!r} ran no test:\n{(done.stdout + done.stderr)[-4000:]}")
        return done.returncode == 0

    def _run(self, command: list[str]) -> None:
        done = self._done(command)
        if done.returncode:
            raise BrokenTable(f"{' '.join(command)} failed:\n{(done.stdout + done.stderr)[-4000:]}")

    def _done(self, command: list[str], seconds: float | None = None) -> subprocess.CompletedProcess[str]:
        environment = {**os.environ, "PYTHONPATH": str(self._package)}
        return subprocess.run(
            command, cwd=self._tree, env=environment, capture_output=True, text=True, timeout=seconds, check=False
        )


def _files(part: Path) -> list[Path]:
    if part.is_file():
        return [part]
    return [path for path in part.rglob("*") if path.is_file() and "__pycache__" not in path.parts]


def _write(path: Path, content: bytes) -> None:
    if path.is_file() and path.read_bytes() == content:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)


def chosen(names: list[str]) -> list[Mutant]:
    """The rows of the table with these names, all of them where none is named."""
    rows = [Mutant(**row) for row in tomllib.loads(TABLE.read_text(encoding="utf-8"))["mutant"]]
    unknown = set(names) - {row.name for row in rows}
    if unknown:
        raise BrokenTable(f"no mutant is called {', '.join(sorted(unknown))}")
    return [row for row in rows if not names or row.name in names]


def survivors(copy: Copy, mutants: list[Mutant]) -> list[str]:
    """Make one change after the other; return "name: test" for each test that doesn't notice its mutant."""
    found = []
    for mutant in mutants:
        begin = time.monotonic()
        copy.refresh()
        copy.change(mutant)
        copy.build(mutant.caught_by)
        blind = [test for test in mutant.caught_by if copy.passes(test)]
        found += [f"{mutant.name}: {test}" for test in blind]
        print(f"   {'SURVIVES' if blind else 'caught':8} {mutant.name} ({time.monotonic() - begin:.0f} s)", flush=True)
    copy.refresh()
    return found


def check_tests(copy: Copy, mutants: list[Mutant]) -> None:
    """See that the tests run, and pass without a change."""
    tests = sorted({test for mutant in mutants for test in mutant.caught_by})
    copy.refresh()
    copy.configure()
    for mutant in mutants:
        mutant.text((ROOT / mutant.file).read_text(encoding="utf-8"))
    copy.build(tests)
    failing = [test for test in tests if not copy.passes(test)]
    if failing:
        raise BrokenTable(f"fails without any change: {', '.join(failing)}")


def main() -> int:
    """Returns 1 where a mutant survives, 2 where the table doesn't fit the tree."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("names", nargs="*")
    given = parser.parse_args()
    try:
        mutants = chosen(given.names)
        copy = Copy(given.folder)
        check_tests(copy, mutants)
        blind = survivors(copy, mutants)
    except BrokenTable as broken:
        print(f"mutate: {broken}", file=sys.stderr)
        return 2
    if blind:
        print("No test noticed:\n  " + "\n  ".join(blind), file=sys.stderr)
        return 1
    print(f"   All {len(mutants)} mutants are caught")
    return 0


if __name__ == "__main__":
    sys.exit(main())
