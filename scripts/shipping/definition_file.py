"""Writes the module definition file of Windows' python3xx.dll from Python's headers.

    definition_file.py HEADERS DLL > OUTPUT

An import library made from it lets a linker bind to the DLL without the DLL. It names all that the
headers declare; the linker takes what the module uses.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

DECLARATION = re.compile(r"\bPyAPI_(FUNC|DATA)\s*\([^)]*\)\s*(?:Py_GCC_ATTRIBUTE\(\(.*?\)\)\s*)?(\w+)")


def exports(headers: Path) -> list[str]:
    """Return an EXPORTS line per function and variable, sorted."""
    lines = set()
    for header in headers.rglob("*.h"):
        for kind, name in DECLARATION.findall(header.read_text(encoding="utf-8")):
            lines.add(f"    {name}{' DATA' if kind == 'DATA' else ''}")
    return sorted(lines)


def main() -> None:
    """Print the file."""
    headers, dll = Path(sys.argv[1]), sys.argv[2]
    found = exports(headers)
    if not found:
        sys.exit(f"no declarations of Python's C interface under {headers}")
    print(f"LIBRARY {dll}\nEXPORTS\n" + "\n".join(found))


if __name__ == "__main__":
    main()
