"""Runs clang-tidy on those sources of native/ that have changed since it last passed them.

    tidy.py BUILD_FOLDER STAMP_FOLDER [WORD…]

A source has changed where its text, that of any header of ours that it includes, its compiler's command, .clang-tidy or
one of the words has: these stand for what isn't read here, the versions of clang-tidy and of the libraries' headers.
Precompiled headers are left out of the commands: clang can't read GCC's, and without them each source has to include
what it needs.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
PRECOMPILED = re.compile(r" -Winvalid-pch| -include \S*cmake_pch\.hxx")


@cache
def included(path: Path) -> frozenset[Path]:
    """Headers of ours that a file includes itself."""
    names = INCLUDE.findall(path.read_text(encoding="utf-8"))
    places = ((folder / name).resolve() for name in names for folder in (path.parent, ROOT / "native"))
    return frozenset(place for place in places if place.is_file())


def closure(path: Path) -> list[Path]:
    """The file and all of ours that it includes, through others too, in a fixed order."""
    found, waiting = {path}, [path]
    while waiting:
        new = included(waiting.pop()) - found
        found |= new
        waiting += new
    return sorted(found)


def key(entry: dict[str, Any], words: list[str]) -> str:
    """One hash of all that decides what clang-tidy says about a source."""
    state = hashlib.sha256()
    for path in [ROOT / ".clang-tidy", *closure(Path(entry["file"]))]:
        state.update(f"{path.relative_to(ROOT)}\n".encode())
        state.update(path.read_bytes())
    state.update("\n".join([entry["command"].replace(str(ROOT), ""), *words]).encode())
    return state.hexdigest()


def commands(build: Path, folder: Path) -> list[dict[str, Any]]:
    """The sources in native/ with their commands, which are written to `folder` for clang-tidy."""
    entries = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    ours = [entry for entry in entries if Path(entry["file"]).is_relative_to(ROOT / "native")]
    for entry in ours:
        entry["command"] = PRECOMPILED.sub("", entry["command"])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "compile_commands.json").write_text(json.dumps(ours, indent=1), encoding="utf-8")
    return ours


def passes(entry: dict[str, Any], folder: Path, words: list[str]) -> bool:
    """Tell whether clang-tidy finds nothing in a source, now or before; prints what it finds."""
    source = Path(entry["file"])
    stamp = folder / str(source.relative_to(ROOT)).replace("/", ".")
    wanted = key(entry, words)
    if stamp.is_file() and stamp.read_text(encoding="utf-8") == wanted:
        return True
    done = subprocess.run(
        ["clang-tidy", "--quiet", "-p", folder, source], capture_output=True, text=True, check=False, cwd=ROOT
    )
    if done.returncode:
        print(done.stdout + done.stderr, flush=True)
        return False
    stamp.write_text(wanted, encoding="utf-8")
    print(f"{source.relative_to(ROOT)}: nothing to say", flush=True)
    return True


def main() -> int:
    """Returns 1 where clang-tidy found something."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=Path)
    parser.add_argument("stamps", type=Path)
    parser.add_argument("words", nargs="*")
    given = parser.parse_args()
    entries = commands(given.build, given.stamps)
    if not entries:
        print(f"{given.build} compiles nothing of native/", file=sys.stderr)
        return 1
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return 0 if all(list(pool.map(lambda entry: passes(entry, given.stamps, given.words), entries))) else 1


if __name__ == "__main__":
    sys.exit(main())
