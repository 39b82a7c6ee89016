"""Turns a report of `pip install --report` into a requirements file with hashes: python scripts/pin.py REPORT."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any


def locked(package: dict[str, Any]) -> str:
    """The line of one package: name, version and the hash of the file that was chosen."""
    metadata = package["metadata"]
    digest = package["download_info"]["archive_info"]["hashes"]["sha256"]
    return f"{metadata['name'].lower()}=={metadata['version']} --hash=sha256:{digest}"


def main() -> None:
    report = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    print("# Written by scripts/pin; not to be edited.")
    print("\n".join(sorted(locked(package) for package in report["install"])))


if __name__ == "__main__":
    main()
