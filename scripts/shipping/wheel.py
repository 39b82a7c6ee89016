"""Writes the wheel of one platform and Python from what CMake installed.

    wheel.py --content FOLDER --licences FOLDER --tag cp311-cp311-win_amd64 --output FOLDER

Name, version and the other metadata come from pyproject.toml, through the backend that builds the
ordinary wheel; run from the repository's root.
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

from scikit_build_core.build import prepare_metadata_for_build_wheel

import archive


def metadata() -> tuple[str, dict[str, bytes]]:
    """Return the name of the wheel's .dist-info folder, with METADATA and, where there are commands, their list."""
    with tempfile.TemporaryDirectory() as folder:
        name = prepare_metadata_for_build_wheel(folder)
        found = archive.files(Path(folder) / name)
        return name, {path: found[path] for path in ("METADATA", "entry_points.txt") if path in found}


def main() -> None:
    """Write the wheel; print its path."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--content", type=Path, required=True, help="folder that holds the package")
    parser.add_argument("--licences", type=Path, required=True)
    parser.add_argument("--tag", required=True)
    parser.add_argument("--output", type=Path, required=True)
    given = parser.parse_args()
    info, texts = metadata()
    contents = archive.files(given.content)
    contents.update({f"{info}/{path}": text for path, text in texts.items()})
    contents[f"{info}/WHEEL"] = (
        f"Wheel-Version: 1.0\nGenerator: scripts/package\nRoot-Is-Purelib: false\nTag: {given.tag}\n"
    ).encode()
    for name, licence in archive.files(given.licences).items():
        contents[f"{info}/licenses/{name}"] = licence
    contents[f"{info}/RECORD"] = archive.record(contents, f"{info}/RECORD")
    target = given.output / f"{info.removesuffix('.dist-info')}-{given.tag}.whl"
    archive.write(target, contents)
    print(target)


if __name__ == "__main__":
    main()
