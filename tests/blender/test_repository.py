"""The extension from a repository, where its module doesn't load, and how Blender ends with it."""

import hashlib
import json
import platform
import re
import shutil
import subprocess
import threading
import time
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

import pytest

import conftest
import own_process
import repository
from extension import module

INSTALL = """
preferences.system.use_online_access = True  # Blender asks for it for any repository, also on a disk
index = add(sys.argv[1])
bpy.ops.extensions.repo_sync(repo_index=index)
install = partial(
    bpy.ops.extensions.package_install, repo_index=index, pkg_id="intrinsic_fairing", enable_on_install=True
)
"""
USE = (
    INSTALL
    + """
install()
installed, distance = enabled(), half_a_sphere()
bpy.ops.extensions.package_uninstall(repo_index=index, pkg_id="intrinsic_fairing")
print("DONE", installed, distance < 1e-4, enabled(), left(), hasattr(bpy.types, "MESH_OT_fair_region"))
"""
)
USED = "['bl_ext.{}.intrinsic_fairing'] True [] [] False"
UPDATE = (
    INSTALL
    + """
install()
before, distance = engine(), half_a_sphere()
open(sys.argv[2], "w").close()  # the test now offers the newer one
while not os.path.exists(sys.argv[3]):
    time.sleep(0.05)
bpy.ops.extensions.repo_sync(repo_index=index)
bpy.ops.extensions.package_upgrade_all()
after = engine()
for one, other in ((before, after), (after, before)):  # both work, each with errors of its own
    try:
        one.fair([[0.0, 0.0, float("nan")]] * 3, [[0, 1, 2]])
    except one.MeshError as error:
        assert not isinstance(error, other.MeshError)
print("DONE", before.__version__, after.__version__, distance < 1e-4, half_a_sphere() < 1e-4)
bpy.ops.extensions.package_uninstall(repo_index=index, pkg_id="intrinsic_fairing")
print(left())
"""
)


def cannot_isolate() -> bool:
    command = ["unshare", "--map-root-user", "--net", "true"]
    return shutil.which("unshare") is None or subprocess.run(command, capture_output=True, check=False).returncode != 0


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A repository with the zip that is tested."""
    return repository.make(tmp_path_factory.mktemp("fairing"), conftest._zip()).parent


def test_from_a_server(folder: Path, tmp_path: Path) -> None:
    with repository.served(folder.parent) as address:
        printed = repository.run(USE, tmp_path, f"{address}/{folder.name}/index.json")
    assert printed == USED.format("repository")


def test_update_while_the_engine_is_loaded(tmp_path: Path) -> None:
    """No restart: the new version's engine has another name than the loaded one's."""
    folder, asked, answered = tmp_path / "site", tmp_path / "asked", tmp_path / "answered"
    repository.make(folder, conftest._zip())

    def offer_newer() -> None:
        while not asked.exists():
            time.sleep(0.05)
        repository.make(folder, repository.newer(conftest._zip(), tmp_path))
        answered.touch()

    with repository.served(folder) as address:
        thread = threading.Thread(target=offer_newer, daemon=True)
        thread.start()
        printed = repository.run(UPDATE, tmp_path, f"{address}/index.json", str(asked), str(answered))
    assert printed.splitlines()[0] == f"{repository.VERSION} {repository.NEXT} True True"
    assert printed.splitlines()[-1] == "[]"


@pytest.mark.skipif(cannot_isolate(), reason="no network of its own can be made here")
def test_from_a_disk_without_network(folder: Path, tmp_path: Path) -> None:
    """A share or a disk of a studio whose machines reach nothing."""
    printed = repository.run(USE, tmp_path, f"{folder.as_uri()}/index.json", offline=True)
    assert re.sub(r"bl_ext\.\w+\.", "bl_ext.{}.", printed) == USED


def test_listing_and_page(folder: Path) -> None:
    """What a host offers: one entry for each zip, with its hash, and links that Blender takes by drag and drop."""
    listing = json.loads((folder / "index.json").read_text(encoding="utf-8"))
    (archive,) = folder.glob("*.zip")
    digest = hashlib.sha256(archive.read_bytes()).hexdigest()
    (entry,) = listing["data"]
    assert (entry["id"], entry["archive_url"], entry["archive_hash"]) == (
        "intrinsic_fairing",
        f"./{archive.name}",
        f"sha256:{digest}",
    )
    page = (folder / "index.html").read_text(encoding="utf-8")
    (link,) = re.findall(r'href="([^"]*\.zip[^"]*)"', page)
    asked = parse_qs(urlsplit(link).query)
    assert (asked["repository"], asked["platforms"]) == (["./index.json"], entry["platforms"])
    sums = dict(line.split()[::-1] for line in (folder / "SHA256SUMS").read_text(encoding="utf-8").splitlines())
    assert sums[archive.name] == digest and sums.keys() == {archive.name, "index.html", "index.json"}


def test_made_again_it_has_the_same_bytes(folder: Path, tmp_path: Path) -> None:
    again = tmp_path / "again"
    for _ in range(2):  # the second time over the first
        repository.make(again, conftest._zip())
    assert {path.name: path.read_bytes() for path in again.iterdir()} == {
        path.name: path.read_bytes() for path in folder.iterdir()
    }


def test_a_folder_with_other_files_is_left_alone(tmp_path: Path) -> None:
    mine = tmp_path / "thesis.txt"
    mine.write_text("mine")
    with pytest.raises(subprocess.CalledProcessError):
        repository.make(tmp_path, conftest._zip())
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.txt"]


# Blender in a process of its own: where the native module doesn't load, and how it ends after all was used.
PLATFORM = {"Linux": "linux-x64", "Windows": "windows-x64"}[platform.system()]  # the zip's


DRAW = """
from extension import ID, module
from test_panel import Layout

assert ID in bpy.context.preferences.addons
assert hasattr(bpy.types, "VIEW3D_PT_fairing_loading")
assert not hasattr(bpy.types, "VIEW3D_PT_fairing")


class Shown:
    layout = Layout()


shown = Shown()
module("loading_panel").VIEW3D_PT_fairing_loading.draw(shown, bpy.context)
print("DRAWN", *shown.layout.reported)
print("WHEEL", module("loading").manifest()["wheels"][0].removeprefix("./wheels/"))
"""


def printed(before: str, scratch: Path) -> tuple[str, str, str]:
    """Enable the extension after these lines; return what the console, the panel and the manifest say."""
    console, rest = own_process.run(DRAW, scratch, "import sys\n" + before).stdout.split("DRAWN ")
    drawn, wheel = rest.split("WHEEL ")
    return console, drawn, wheel.strip()


def engine_name() -> str:
    """The name that the engine has in this extension, and in no other."""
    return f"intrinsic_fairing_{module('loading').manifest()['version'].replace('.', '_')}"


def test_module_is_missing(tmp_path: Path) -> None:
    """No traceback: a panel, and lines in the console, with platform, Python and wheel."""
    console, drawn, wheel = printed(f'sys.modules["{engine_name()}"] = None', tmp_path)
    for text in (engine_name(), platform.machine(), platform.python_version(), PLATFORM, wheel):
        assert text in drawn
    assert wheel in console


def test_another_extensions_module_of_the_usual_name(tmp_path: Path) -> None:
    """Blender has one folder for the wheels of all extensions; the engine's name in there is this version's own."""
    foreign = "import sys, types\nsys.modules['fairing'] = types.ModuleType('fairing')\n"
    lines = 'from extension import module\nprint("ENGINE", module().fairing.__name__, module("loading").problem())'
    printed = own_process.run(lines, tmp_path, foreign).stdout
    assert printed.partition("ENGINE ")[2].strip() == engine_name()


# Blender ends as it should after everything that listens has been used: a process of its own, and its exit status.
