"""Releases: notes and versions, an engine of a private name, another distribution's files beside it."""

import base64
import hashlib
import importlib.util
import os
import shutil
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path
from types import ModuleType

import pytest

import fairing

ROOT = Path(__file__).parents[2]
NOTES = "### Added\n- Something."


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """A repository of version 1.2.3 with a changelog."""
    (tmp_path / "scripts").mkdir()
    (tmp_path / "addon").mkdir()
    for name in ("lib.sh", "release-notes"):
        shutil.copy(ROOT / "scripts" / name, tmp_path / "scripts")
    (tmp_path / "pyproject.toml").write_text('[project]\nversion = "1.2.3"\n')
    (tmp_path / "addon" / "blender_manifest.toml").write_text('version = "1.2.3"\n')
    sections = ["## [Unreleased]\n- Later.", f"## [1.2.3] – 2026-01-01\n\n{NOTES}", "## [1.2.2] – 2025-01-01\n- Old."]
    (tmp_path / "CHANGELOG.md").write_text("# Changelog\n\n" + "\n\n".join(sections), encoding="utf-8")
    return tmp_path


def release_notes(checkout: Path, tag: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        ["bash", "scripts/release-notes", tag], cwd=checkout, capture_output=True, text=True, check=False
    )


def test_notes_are_the_versions_section(checkout: Path) -> None:
    done = release_notes(checkout, "v1.2.3")
    assert (done.returncode, done.stdout.strip()) == (0, NOTES)


@pytest.mark.parametrize("tag", ["v1.2.4", "1.2.3", "v1.2", "v1.2.3-rc1", ""])
def test_tag_of_another_version_is_refused(checkout: Path, tag: str) -> None:
    done = release_notes(checkout, tag)
    assert done.returncode != 0
    assert "1.2.3" in done.stderr


def test_version_without_notes_is_refused(checkout: Path) -> None:
    changelog = checkout / "CHANGELOG.md"
    changelog.write_text(changelog.read_text(encoding="utf-8").replace("[1.2.3]", "[1.2.0]"), encoding="utf-8")
    done = release_notes(checkout, "v1.2.3")
    assert done.returncode != 0
    assert "CHANGELOG.md" in done.stderr


def test_module_and_extension_are_one_version(checkout: Path) -> None:
    (checkout / "pyproject.toml").write_text('[project]\nversion = "1.2.2"\n')
    assert release_notes(checkout, "v1.2.3").returncode != 0


def test_the_project_has_one_version() -> None:
    """Package, extension and engine: pyproject.toml is the truth, which the build reads and the manifest repeats."""
    version = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
    manifest = tomllib.loads((ROOT / "addon" / "blender_manifest.toml").read_text(encoding="utf-8"))
    assert manifest["version"] == version
    assert fairing.__version__ == version


# Two distributions that share the package's folder.
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


# How the extension's engine gets a name of its own (scripts/shipping/private.py).
@pytest.fixture
def private(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The script as a module."""
    monkeypatch.syspath_prepend(str(ROOT / "scripts" / "shipping"))
    spec = importlib.util.spec_from_file_location("private", ROOT / "scripts" / "shipping" / "private.py")
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize(
    ("source", "wanted"),
    [
        ("import fairing\n", "import own as fairing\n"),
        ("    import fairing  # late\n", "    import own as fairing  # late\n"),
        ("from fairing import fair\n", "from own import fair\n"),
        ("from fairing._core import fair\n", "from own._core import fair\n"),
        ("import fairing_tools\nfrom fairings import x\n", "import fairing_tools\nfrom fairings import x\n"),
        ("fairing.fair(import_fairing)\n", "fairing.fair(import_fairing)\n"),
    ],
)
def test_imports_are_renamed(private: ModuleType, source: str, wanted: str) -> None:
    assert private.renamed(source, "own", "here") == wanted


@pytest.mark.parametrize("source", ["import fairing as f", "import fairing, numpy", "import fairing._core"])
def test_imports_that_would_be_missed_are_refused(private: ModuleType, source: str) -> None:
    with pytest.raises(SystemExit, match="here imports fairing"):
        private.renamed(source, "own", "here")


def test_wheel_is_one_of_the_new_name(private: ModuleType, tmp_path: Path) -> None:
    """What RECORD says of each file is true; libraries stay where the module looks for them."""
    old = tmp_path / "fairing-1.2-cp311-cp311-any.whl"
    files = {
        "fairing/__init__.py": "from fairing._core import fair\n",
        "fairing/_core.so": "\0fairing\0",
        "fairing.libs/libmesh.so": "mesh",
        "fairing-1.2.dist-info/METADATA": "Metadata-Version: 2.1\nName: intrinsic-fairing\nVersion: 1.2\n",
        "fairing-1.2.dist-info/RECORD": "",
    }
    with zipfile.ZipFile(old, "w") as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    new = private.rename_wheel(old, "own_1_2")
    assert [path.name for path in tmp_path.iterdir()] == ["own_1_2-1.2-cp311-cp311-any.whl"]
    with zipfile.ZipFile(new) as archive:
        content = {name: archive.read(name) for name in archive.namelist()}
    assert content["own_1_2/__init__.py"] == b"from own_1_2._core import fair\n"
    assert content["own_1_2/_core.so"] == b"\0fairing\0"
    assert content["fairing.libs/libmesh.so"] == b"mesh"
    assert b"Name: own_1_2\n" in content["own_1_2-1.2.dist-info/METADATA"]
    rows = [row.split(",") for row in content.pop("own_1_2-1.2.dist-info/RECORD").decode().splitlines()]
    assert {row[0] for row in rows} == {*content, "own_1_2-1.2.dist-info/RECORD"}
    for name, digest, size in rows[:-1]:
        found = base64.urlsafe_b64encode(hashlib.sha256(content[name]).digest()).rstrip(b"=").decode()
        assert (digest, int(size)) == (f"sha256={found}", len(content[name]))


def test_name_has_the_version(private: ModuleType, tmp_path: Path) -> None:
    (tmp_path / "blender_manifest.toml").write_text('id = "mine"\nversion = "1.2.0-rc.1"\n')
    assert private.name_of(tmp_path) == "mine_1_2_0_rc_1"
    assert private.name_of(ROOT / "addon").isidentifier()
