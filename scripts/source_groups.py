"""Which of the engine's sources may be read as one: those whose private names mean nothing in one another.

    source_groups.py        CMake's groups for a unity build of native/ (FAIRING_UNITY)

Libraries' headers take most of the time of compilers and of clang-tidy. Sources that are read as one share them.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[1]
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
PRIVATE = re.compile(r"^namespace \{\n(.*?)^\}  // namespace$", re.MULTILINE | re.DOTALL)
NAME = re.compile(
    r"^(?:template <.*> )?(?:(?:struct|class|enum class|using) (\w+)|[A-Za-z].*?\b(\w+)(?: = |[({;[]))", re.MULTILINE
)
SAID = re.compile(r'//[^\n]*|"(?:\\.|[^"\\\n])*"')  # comments and strings, names of headers among them
OPENMESH = ROOT / "native/mesh/surface_mesh.h"
GIVEN = frozenset(("dot", "cross", "norm", "sqrnorm", "normalize", "vectorize"))  # what it declares for Eigen's types
SIZE = 16  # sources


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


@dataclass(frozen=True)
class Words:
    """What a source declares for itself alone, and all words of the code in it and in our headers that it includes."""

    private: frozenset[str]
    every: frozenset[str]
    room: str

    def fit(self, other: Words) -> bool:
        """Whether no private name of either stands in the other; bindings have libraries of their own."""
        alike = (self.room == "bindings") == (other.room == "bindings")
        return alike and not (self.private & other.every or other.private & self.every)


def words(path: Path) -> Words:
    own = "".join(PRIVATE.findall(path.read_text(encoding="utf-8")))
    private = frozenset(name for pair in NAME.findall(own) for name in pair if name)
    read = closure(path)
    text = "".join(SAID.sub("", each.read_text(encoding="utf-8")) for each in read)
    given = GIVEN if OPENMESH in read else frozenset()
    return Words(private, given.union(re.findall(r"\w+", text)), path.parent.name)


def groups(paths: list[Path]) -> list[list[Path]]:
    """Sources to read together, up to SIZE in each group: those that fit the fewest others come first."""
    all_words = {path: words(path) for path in paths}
    clashes = {path: sum(not mine.fit(other) for other in all_words.values()) for path, mine in all_words.items()}
    found: list[list[Path]] = []
    for path in sorted(paths, key=lambda path: -clashes[path]):
        for group in found:
            if len(group) < SIZE and all(all_words[path].fit(all_words[other]) for other in group):
                group.append(path)
                break
        else:
            found.append([path])
    return found


def main() -> None:
    """Prints a line of CMake for each group of the engine's sources."""
    listed = (
        (ROOT / "native" / "CMakeLists.txt").read_text(encoding="utf-8").split("add_library(fairing_engine STATIC")[1]
    )
    sources = [ROOT / "native" / name for name in re.findall(r"^\s+(\w+/\w+\.cpp)", listed.split(")")[0], re.MULTILINE)]
    for number, group in enumerate(groups(sources)):
        if len(group) > 1:
            names = " ".join(path.relative_to(ROOT / "native").as_posix() for path in group)
            print(f"set_source_files_properties({names} PROPERTIES UNITY_GROUP {number})")


if __name__ == "__main__":
    main()
