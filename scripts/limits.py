"""Every constant of the engine with its reason, module by module: what there is to tune, and why it is as it is.

    python scripts/limits.py [MODULE…]

A limit that several files of a module share stands in the module's limits.h, every other one beside its only use.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

NATIVE = Path(__file__).parents[1] / "native"
CONSTANT = re.compile(r"^(?:inline |static )*constexpr (?!Words<)[^(]*?(\w+)\s*(?:=|\{)(.*)$")


@dataclass(frozen=True)
class Limit:
    """A constant: its file, the line (from 1), its name and value, and the comment on its line or over its lines."""

    file: Path
    line: int
    name: str
    value: str
    reason: str


def limits(folder: Path) -> Iterator[Limit]:
    """Yield those of all sources in a folder."""
    for file in sorted(folder.rglob("*")):
        if file.suffix in {".h", ".cpp"}:
            yield from _limits_of(file)


def _limits_of(file: Path) -> Iterator[Limit]:
    above: list[str] = []  # the comment over a run of constants holds for all of them
    in_run = False
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        code, _, comment = line.strip().partition("//")
        if comment and not code:
            above = [*above, comment.strip()] if not in_run else [comment.strip()]
            in_run = False
        elif found := CONSTANT.match(code.strip()):
            in_run = True
            value = found[2].strip().rstrip(";").removesuffix("}").strip()
            yield Limit(file, number, found[1], value, comment.strip() or " ".join(above))
        else:
            above, in_run = [], False


def main(modules: list[str]) -> None:
    """Print those of the modules named, or of all."""
    names = modules or sorted(path.name for path in NATIVE.iterdir() if path.is_dir())
    for module in names:
        found = list(limits(NATIVE / module))
        if found:
            print(f"{module}: {len(found)}")
        for limit in found:
            place = f"{limit.file.relative_to(NATIVE)}:{limit.line}"
            print(f"  {limit.name} = {limit.value or '…'}  ({place})  {limit.reason}")


if __name__ == "__main__":
    main(sys.argv[1:])
