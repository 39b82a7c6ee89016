"""Extension repositories for tests, and what a user does with one, in a Blender of its own."""

import http.server
import io
import os
import subprocess
import sys
import threading
import tomllib
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
TOOL = ROOT / "scripts" / "shipping" / "repository.py"
VERSION = tomllib.loads((ROOT / "addon" / "blender_manifest.toml").read_text(encoding="utf-8"))["version"]
NEXT = VERSION[:-1] + str(int(VERSION[-1]) + 1)  # as long as the other: both stand in a compiled module

# Online access is off, as in a Blender that is new, until a line switches it on.
BEGIN = """
import os
import sys
import time
from functools import partial
import conftest  # before bpy: it sets Blender's scratch folder
import bpy

preferences = bpy.context.preferences
repositories = preferences.extensions.repos


def add(url):
    bpy.ops.preferences.extension_repo_add(type="REMOTE", remote_url=url)
    return len(repositories) - 1


def half_a_sphere():
    import meshes
    import numpy as np

    ball = meshes.sphere()
    points = meshes.positions(ball)
    upper = meshes.faces_where(ball, lambda centre: centre.z > 0.0)
    points *= 1.0 - 0.3 * np.clip(points[:, 2:], 0.0, None) ** 2
    meshes.move(ball, points)
    meshes.fair(ball, upper)
    return float(np.abs(np.linalg.norm(meshes.positions(ball), axis=1) - 1.0).max())


def enabled():
    return [name for name in preferences.addons.keys() if name.endswith("intrinsic_fairing")]


def engine():
    return sys.modules[enabled()[0]].fairing


def left():
    folder = conftest.SCRATCH / "extensions"
    return [path for path in folder.rglob("*") if "fairing" in path.name and path.is_file()]


"""


def make(folder: Path, *zips: Path) -> Path:
    """Write a repository of these zips; return the path of its listing."""
    subprocess.run([sys.executable, TOOL, folder, *zips], check=True, capture_output=True)
    return folder / "index.json"


def newer(archive: Path, folder: Path) -> Path:
    """Write the zip's next version: with the same content, the compiled module's word for its version too."""
    target = folder / archive.name.replace(VERSION, NEXT)
    target.write_bytes(said_newer(archive.read_bytes()))
    return target


def said_newer(content: bytes) -> bytes:
    """The same for the content of any file, archives within archives included."""
    if not content.startswith(b"PK\3\4"):
        for dot in (".", "_"):
            content = content.replace(VERSION.replace(".", dot).encode(), NEXT.replace(".", dot).encode())
        return content
    written = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(content)) as opened, zipfile.ZipFile(written, "w") as target:
        for name in opened.namelist():
            path = said_newer(name.encode()).decode()
            target.writestr(path, said_newer(opened.read(name)))
    return written.getvalue()


@contextmanager
def served(folder: Path) -> Iterator[str]:
    """Yield the address of a folder on a server of this machine."""

    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_: object) -> None:
            pass

    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=str(folder))) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            yield f"http://127.0.0.1:{server.server_port}"
        finally:
            server.shutdown()
            thread.join()


def run(lines: str, scratch: Path, *arguments: str, offline: bool = False) -> str:
    """Run the lines in a new Blender; return what is printed after DONE, which the lines print themselves."""
    path = os.pathsep.join([str(HERE), os.environ.get("PYTHONPATH", "")])  # bpy may be found by it
    environment = {**os.environ, "PYTHONPATH": path, "TMPDIR": str(scratch)}
    command = [sys.executable, "-c", BEGIN + lines, *arguments]
    if offline:
        command = ["unshare", "--map-root-user", "--net", *command]
    ended = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=600, check=False)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    return ended.stdout.partition("DONE")[2].strip()
