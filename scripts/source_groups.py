"""Which sources may be read as one: those whose private names mean nothing in one another.

    source_groups.py CMAKELISTS.TXT        CMake's groups for the sources that it lists (FAIRING_UNITY)

Libraries' headers take most of the time of compilers and of clang-tidy. Sources that are read as one share them.
"""

from __future__ import annotations

import re
import sys
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
SIZE = 8  # sources: a fresh build takes as long with 16, and an edit compiles its group


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
class Names:
    """What a source declares for itself alone, and what else it and our headers that it includes declare."""

    private: frozenset[str]
    shared: frozenset[str]
    folder: str

    def fit(self, other: Names) -> bool:
        """Whether the sources lie in one folder, and no private name of either means something in the other."""
        clash = self.private & (other.private | other.shared) or self.shared & other.private
        return self.folder == other.folder and not clash


def declared(text: str) -> frozenset[str]:
    return frozenset(name for pair in NAME.findall(SAID.sub("", text)) for name in pair if name)


def names(path: Path) -> Names:
    read = closure(path)
    texts = {each: each.read_text(encoding="utf-8") for each in read}
    private = declared("".join(PRIVATE.findall(texts[path])))
    texts[path] = PRIVATE.sub("", texts[path])
    given = GIVEN if OPENMESH in read else frozenset()
    return Names(private, given.union(*map(declared, texts.values())), path.parent.name)


def groups(paths: list[Path]) -> list[list[Path]]:
    """Sources of one folder to read together, up to SIZE in each group, in their order."""
    all_names = {path: names(path) for path in paths}
    found: list[list[Path]] = []
    for path in paths:
        for group in found:
            if len(group) < SIZE and all(all_names[path].fit(all_names[other]) for other in group):
                group.append(path)
                break
        else:
            found.append([path])
    return found


def main() -> None:
    """Prints a line of CMake for each group."""
    lists = Path(sys.argv[1])
    sources = re.findall(r"^\s+([\w/]+\.cpp)", lists.read_text(encoding="utf-8"), re.MULTILINE)
    for group in groups([lists.parent / name for name in dict.fromkeys(sources)]):
        names = " ".join(path.relative_to(lists.parent).as_posix() for path in group)
        print(f"set_source_files_properties({names} PROPERTIES UNITY_GROUP {group[0].parent.name}_{group[0].stem})")


if __name__ == "__main__":
    main()
