"""How the extension's engine gets a name of its own (scripts/shipping/private.py)."""

import base64
import hashlib
import importlib.util
import zipfile
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).parents[2]


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
