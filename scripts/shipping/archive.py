"""Zip archives whose bytes depend on names and contents alone: sorted, dated SOURCE_DATE_EPOCH.

archive.py FOLDER ZIP: puts everything under FOLDER into ZIP.
"""

from __future__ import annotations

import base64
import hashlib
import os
import sys
import time
import zipfile
from collections.abc import Mapping
from pathlib import Path

FIRST_DATE = 315532800  # 1980-01-01, the first that a zip can hold


def date() -> tuple[int, ...]:
    """Return the date of every entry, UTC."""
    return time.gmtime(max(int(os.environ.get("SOURCE_DATE_EPOCH", "0")), FIRST_DATE))[:6]


def files(folder: Path) -> dict[str, bytes]:
    """Return the contents of all files under a folder by their path in it, caches of Python left out."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }


def write(target: Path, contents: Mapping[str, bytes]) -> None:
    """Write the zip."""
    target.unlink(missing_ok=True)
    with zipfile.ZipFile(target, "w") as archive:
        for name in sorted(contents):
            entry = zipfile.ZipInfo(name, date())
            entry.external_attr = 0o100644 << 16
            archive.writestr(entry, contents[name], zipfile.ZIP_DEFLATED, 9)


def record(contents: dict[str, bytes], path: str) -> bytes:
    """Return a wheel's list of all files with their hashes; its own line, at `path`, has none."""
    lines = []
    for name in sorted(contents):
        digest = base64.urlsafe_b64encode(hashlib.sha256(contents[name]).digest()).rstrip(b"=").decode()
        lines.append(f"{name},sha256={digest},{len(contents[name])}")
    return "\n".join([*lines, f"{path},,", ""]).encode()


if __name__ == "__main__":
    write(Path(sys.argv[2]), files(Path(sys.argv[1])))
