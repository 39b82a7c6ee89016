"""Modules of the tree with one change each, built in a copy that is kept between runs."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import reach
from limits import make_settable

ROOT = Path(__file__).resolve().parents[2]
PARTS = (
    "CMakeLists.txt",
    "CMakePresets.json",
    "pyproject.toml",
    "native",
    "tests/native",
    "addon/blender_manifest.toml",
)


class Tree:
    """A copy of the engine's sources in `folder`/tree."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder.resolve()
        self.tree = self.folder / "tree"
        rows = tomllib.loads((Path(__file__).parent / "switches.toml").read_text())["switch"]
        self.switches = {row["name"]: row for row in rows}
        for part in PARTS:
            source, copy = ROOT / part, self.tree / part
            copy.parent.mkdir(parents=True, exist_ok=True)
            if source.is_dir():
                _mirror(source, copy)
            else:
                shutil.copy2(source, copy)

    def built(self, name: str) -> Path:
        """The folder that holds the package `fairing` with that change; none for "as it is"."""
        package = self.folder / "modules" / name
        row = self.switches.get(name)
        changed = self.tree / row["file"] if row else None
        original = changed.read_text() if changed else ""
        if row and original.count(row["find"]) != 1:
            raise SystemExit(
                f"{name}: {row['file']} holds {row['find']!r} {original.count(row['find'])} times, not once"
            )
        try:
            if row and changed:
                changed.write_text(original.replace(row["find"], row["replace"]))
            self._build()
        finally:
            if changed:
                changed.write_text(original)
        return self._packed(package)

    def built_with_limits(self) -> Path:
        """The folder that holds the package `fairing` with limits that can be set; the copy is no other's then."""
        make_settable(self.tree / "native")
        self._build("-DFAIRING_WARNINGS_AS_ERRORS=OFF", "-DFAIRING_BUILD_TESTS=OFF")
        return self._packed(self.folder / "modules" / "limits")

    def built_with_marks(self) -> Path:
        """The folder that holds the package `fairing` whose module says which branches ran."""
        module = self.tree / "native/bindings/module.cpp"
        module.write_text(reach.marked(module.read_text()))
        self._build(*reach.OPTIONS)
        return self._packed(self.folder / "modules" / "marks")

    def _packed(self, package: Path) -> Path:
        shutil.rmtree(package, ignore_errors=True)
        shutil.copytree(self.tree / "native/python/fairing", package / "fairing")
        for module in (self.tree / "build/native/native").glob("_core.*.so"):
            shutil.copy(module, package / "fairing")
        return package

    def _build(self, *options: str) -> None:
        pybind11 = subprocess.run(
            [sys.executable, "-m", "pybind11", "--cmakedir"], check=True, capture_output=True, text=True
        ).stdout.strip()
        configure = [
            "cmake",
            "--preset",
            "dev",
            f"-Dpybind11_DIR={pybind11}",
            f"-DPython_EXECUTABLE={sys.executable}",
            *options,
        ]
        for command in (configure, ["cmake", "--build", "--preset", "dev", "--target", "_core"]):
            done = subprocess.run(command, cwd=self.tree, capture_output=True, text=True, check=False)
            if done.returncode:
                raise SystemExit(done.stdout[-3000:] + done.stderr[-3000:])


def _mirror(source: Path, copy: Path) -> None:
    """Copies what has changed, so that a build compiles no more than that."""
    for path in source.rglob("*"):
        target = copy / path.relative_to(source)
        if path.is_dir() or "__pycache__" in path.parts:
            continue
        if not target.exists() or target.read_bytes() != path.read_bytes():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, target)
    for target in copy.rglob("*"):
        if target.is_file() and not (source / target.relative_to(copy)).exists():
            target.unlink()
