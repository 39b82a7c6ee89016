"""Gives a staged extension an engine of its own: no other extension's wheel, and no other version of this one, can
take its place, and an update works while the old one is still loaded.

    private.py FOLDER

FOLDER holds the add-on and, in wheels/, the ordinary wheels. The package `fairing` in them gets a name made of the
extension's id and version, in the wheels and wherever the add-on imports it. Blender keeps of all wheels with one name
the newest: this name is nobody else's.
"""

from __future__ import annotations

import re
import sys
import tomllib
import zipfile
from pathlib import Path

import archive

MODULE = "fairing"
FROM = re.compile(rf"^(\s*from ){MODULE}(?=[ .])", re.M)
IMPORT = re.compile(rf"^(\s*)import {MODULE}(?=[ \t]*(#.*)?$)", re.M)
LEFT = re.compile(rf"^\s*(import|from) {MODULE}\b(?! *\w+ as {MODULE})", re.M)


def name_of(folder: Path) -> str:
    """Return the name that the package gets."""
    manifest = tomllib.loads((folder / "blender_manifest.toml").read_text(encoding="utf-8"))
    return f"{manifest['id']}_{re.sub(r'[^0-9a-z]+', '_', manifest['version'])}"


def renamed(source: str, name: str, where: str) -> str:
    """Return Python source that imports the package by its new name and calls it as before."""
    text = IMPORT.sub(rf"\1import {name} as {MODULE}", FROM.sub(rf"\1{name}", source))
    if LEFT.search(text):
        sys.exit(f"{where} imports {MODULE} in a way that {Path(__file__).name} doesn't know: use 'import {MODULE}'")
    return text


def moved(path: str, info: str, name: str, version: str) -> str:
    """Return where a file of the wheel goes; the libraries' folder stays where the module looks for it."""
    head, _, rest = path.partition("/")
    return {MODULE: f"{name}/{rest}", info: f"{name}-{version}.dist-info/{rest}"}.get(head, path)


def rename_wheel(wheel: Path, name: str) -> Path:
    """Write the wheel again under the new name, beside the old one, which goes; return where it is."""
    _, version, *tags = wheel.name.split("-")
    with zipfile.ZipFile(wheel) as opened:
        old = {entry: opened.read(entry) for entry in opened.namelist() if not entry.endswith("/")}
    (info,) = {entry.partition("/")[0] for entry in old if entry.partition("/")[0].endswith(".dist-info")}
    contents = {}
    for path, content in old.items():
        if path.endswith((".py", ".pyi")):
            content = renamed(content.decode(), name, path).encode()
        if path == f"{info}/METADATA":
            content = re.sub(rb"^Name: .*$", f"Name: {name}".encode(), content, count=1, flags=re.M)
        contents[moved(path, info, name, version)] = content
    lines = f"{name}-{version}.dist-info/RECORD"
    del contents[lines]
    contents[lines] = archive.record(contents, lines)
    target = wheel.with_name("-".join([name, version, *tags]))
    archive.write(target, contents)
    wheel.unlink()
    return target


def main() -> None:
    """Rename in the whole folder."""
    folder = Path(sys.argv[1])
    name = name_of(folder)
    for source in sorted(folder.rglob("*.py")):
        text = source.read_text(encoding="utf-8")
        source.write_text(renamed(text, name, str(source)), encoding="utf-8")
    for wheel in sorted((folder / "wheels").glob("*.whl")):
        rename_wheel(wheel, name)


if __name__ == "__main__":
    main()
