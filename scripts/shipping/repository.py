"""Makes an extension repository: a folder that any static host, a share or a disk can offer to Blender.

    repository.py FOLDER ZIP…

FOLDER, new or one that this has made before, then holds the zips, `index.json`, which Blender reads, `index.html`, from
which a zip can be dragged into Blender, and SHA256SUMS. Needs bpy beside the Python that runs it: listing and page are
by Blender's own tool. The same zips give the same bytes.
"""

from __future__ import annotations

import hashlib
import importlib.util
import json
import shutil
import subprocess
import sys
from pathlib import Path

TEMPLATE = Path(__file__).with_name("repository.html")
LISTS = ("SHA256SUMS", "index.html", "index.json")


def extension_tool() -> Path:
    """Return Blender's command-line tool for extensions, out of the bpy at hand, which isn't loaded."""
    spec = importlib.util.find_spec("bpy")
    if spec is None or not spec.submodule_search_locations:
        sys.exit(f"{sys.executable} has no bpy: run this with an environment of scripts/setup")
    (tool,) = Path(spec.submodule_search_locations[0]).glob("*/scripts/addons_core/bl_pkg/cli/blender_ext.py")
    return tool


def emptied(folder: Path) -> None:
    """Make the folder, or take out of it what an earlier call has put there."""
    folder.mkdir(parents=True, exist_ok=True)
    for path in folder.iterdir():
        if path.suffix != ".zip" and path.name not in LISTS:
            sys.exit(f"{path} is none of a repository's files: name a folder of its own")
    for path in folder.iterdir():
        path.unlink()


def sort_listing(index: Path) -> None:
    """Blender's tool lists the zips as the folder happens to have them."""
    listing = json.loads(index.read_text(encoding="utf-8"))
    listing["data"].sort(key=lambda package: package["archive_url"])
    index.write_text(json.dumps(listing, indent=2) + "\n", encoding="utf-8")


def make(folder: Path, zips: list[Path]) -> None:
    """Write the repository."""
    emptied(folder)
    for path in zips:
        shutil.copy(path, folder)
    command = [sys.executable, extension_tool(), "server-generate", "--repo-dir", folder]
    subprocess.run([*command, "--html", "--html-template", TEMPLATE], check=True)
    sort_listing(folder / "index.json")
    files = sorted(path for path in folder.iterdir() if path.name != "SHA256SUMS")
    sums = [f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.name}\n" for path in files]
    (folder / "SHA256SUMS").write_text("".join(sums), encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    make(Path(sys.argv[1]), [Path(name) for name in sys.argv[2:]])
