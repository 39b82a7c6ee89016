"""What a release is refused for."""

import shutil
import subprocess
import tomllib
from pathlib import Path

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
