"""Runs clang-tidy on those sources of native/ that have changed since it last passed them.

    tidy.py BUILD_FOLDER STAMP_FOLDER [WORD…]

A source has changed where its text, that of any header of ours that it includes, its compiler's command, .clang-tidy or
one of the words has: these stand for what isn't read here, the versions of clang-tidy and of the libraries' headers.
Precompiled headers are left out of the commands: clang can't read GCC's, and without them each source has to include
what it needs.

Where many sources have changed they are read in groups (source_groups.py). What clang-tidy finds in a group, it has to
find again in a source by itself.
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
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from source_groups import ROOT, closure, groups

PRECOMPILED = re.compile(r" -Winvalid-pch| -include \S*cmake_pch\.hxx")
FEW = 24  # sources: read by themselves


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


@dataclass(frozen=True)
class Source:
    """A source that has changed."""

    entry: dict[str, Any]
    path: Path
    stamp: Path
    key: str


def changed(entry: dict[str, Any], folder: Path, words: list[str]) -> Source | None:
    """The source, or None where it has passed as it is."""
    path = Path(entry["file"])
    stamp, wanted = folder / str(path.relative_to(ROOT)).replace("/", "."), key(entry, words)
    if stamp.is_file() and stamp.read_text(encoding="utf-8") == wanted:
        return None
    return Source(entry, path, stamp, wanted)


def grouped(sources: list[Source]) -> list[list[Source]]:
    """Sources to read together; each by itself where they are few."""
    if len(sources) <= FEW:
        return [[source] for source in sources]
    of = {source.path: source for source in sources}
    return [[of[path] for path in group] for group in groups(list(of))]


def as_one(group: list[Source], folder: Path) -> Path:
    """A folder with the command for a source that includes those of the group."""
    place = folder / f"group-{group[0].stamp.name}"
    place.mkdir(exist_ok=True)
    joint = place / "group.cpp"
    lines = [f'#include "{source.path}"  // NOLINT(bugprone-suspicious-include)\n' for source in group]
    joint.write_text("".join(lines), encoding="utf-8")
    entry = group[0].entry
    entry = {**entry, "file": str(joint), "command": entry["command"].replace(str(group[0].path), str(joint))}
    (place / "compile_commands.json").write_text(json.dumps([entry]), encoding="utf-8")
    return joint


def passes(group: list[Source], folder: Path) -> bool:
    """Tell whether clang-tidy finds nothing in these sources; prints what it finds in each by itself."""
    one = group[0].path if len(group) == 1 else as_one(group, folder)
    place = folder if len(group) == 1 else one.parent
    done = subprocess.run(
        ["clang-tidy", "--quiet", "-p", place, one], capture_output=True, text=True, check=False, cwd=ROOT
    )
    if done.returncode and len(group) > 1:
        alone = [passes([source], folder) for source in group]
        return all(alone)
    if done.returncode:
        print(done.stdout + done.stderr, flush=True)
        return False
    for source in group:
        source.stamp.write_text(source.key, encoding="utf-8")
        print(f"{source.path.relative_to(ROOT)}: nothing to say", flush=True)
    return True


def main() -> int:
    """Returns 1 where clang-tidy found something."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=Path)
    parser.add_argument("stamps", type=Path)
    parser.add_argument("words", nargs="*")
    given = parser.parse_args()
    stamps = given.stamps.resolve()
    entries = commands(given.build, stamps)
    if not entries:
        print(f"{given.build} compiles nothing of native/", file=sys.stderr)
        return 1
    stale = [source for entry in entries if (source := changed(entry, stamps, given.words))]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return 0 if all(list(pool.map(lambda group: passes(group, stamps), grouped(stale)))) else 1


if __name__ == "__main__":
    sys.exit(main())
