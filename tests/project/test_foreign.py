"""Two distributions that share the package's folder."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import fairing


@pytest.fixture
def site(tmp_path: Path) -> Path:
    """A folder of packages with this one in it."""
    shutil.copytree(Path(fairing.__file__).parent, tmp_path / "fairing")
    (tmp_path / "intrinsic_fairing-1.0.dist-info").mkdir()
    for libraries in Path(fairing.__file__).parents[1].glob("*.libs"):
        shutil.copytree(libraries, tmp_path / libraries.name)
    return tmp_path


def imported(site: Path, name: str = "fairing") -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(site)}
    command = [sys.executable, "-c", f"import {name}; print({name}.__file__)"]
    return subprocess.run(command, env=environment, cwd=site, capture_output=True, text=True, check=False)


def test_alone_it_imports(site: Path) -> None:
    assert imported(site).stdout.startswith(str(site))


def test_beside_the_foreign_one_it_says_what_to_do(site: Path) -> None:
    (site / "fairing-0.5.3.dist-info").mkdir()
    done = imported(site)
    assert done.returncode == 1
    for words in ("ImportError", "fairing-0.5.3", "pip uninstall fairing", "intrinsic-fairing", str(site / "fairing")):
        assert words in done.stderr
