"""Checks what Windows' modules in wheels import: Python, Windows itself and the universal C runtime.

imports.py WHEEL…
"""

from __future__ import annotations

import re
import sys
import zipfile
from pathlib import Path

import pefile

ALLOWED = re.compile(r"python3\d+\.dll|kernel32\.dll|ntdll\.dll|advapi32\.dll|api-ms-win-crt-[a-z]+-l1-1-0\.dll", re.I)


def imported(wheel: Path) -> list[str]:
    """Return the names of the libraries that the wheel's module asks for."""
    with zipfile.ZipFile(wheel) as archive:
        (name,) = (name for name in archive.namelist() if name.endswith(".pyd"))
        module = pefile.PE(data=archive.read(name))
    return sorted(entry.dll.decode() for entry in module.DIRECTORY_ENTRY_IMPORT)


def main() -> int:
    """Return 1 where a library is asked for that Windows 10 doesn't bring."""
    strange = 0
    for wheel in map(Path, sys.argv[1:]):
        names = imported(wheel)
        print(f"{wheel.name} imports {', '.join(names)}")
        strange += sum(not ALLOWED.fullmatch(name) for name in names)
    return int(strange > 0)


if __name__ == "__main__":
    sys.exit(main())
