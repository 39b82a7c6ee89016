"""Which lines of the engine calls reach: a build in which each branch leaves a mark when it runs, read after each call.

Needs clang++-14 with its runtime library and llvm-symbolizer-14 (Debian: clang-14, libclang-rt-14-dev, llvm-14).
"""

from __future__ import annotations

import json
import re
import subprocess
from pathlib import Path
from typing import Any

import numpy as np

OPTIONS = (
    "-DCMAKE_CXX_COMPILER=clang++-14",
    "-DCMAKE_CXX_COMPILER_LAUNCHER=",
    "-DCMAKE_CXX_FLAGS=-g1 -fsanitize-coverage=edge,inline-bool-flag,pc-table,no-prune",
    "-DCMAKE_INTERPROCEDURAL_OPTIMIZATION=OFF",  # the marks of one file are lost otherwise
    "-DCMAKE_STRIP=",  # places are found by what it would take away
    "-DFAIRING_WARNINGS_AS_ERRORS=OFF",
    "-DFAIRING_BUILD_TESTS=OFF",
)
MARKS = """
#include <pybind11/numpy.h>
#include <dlfcn.h>
#include <cstdint>
namespace {
bool* first_mark;
bool* end_of_marks;
const std::uintptr_t* first_place;
}  // namespace
extern "C" void __sanitizer_cov_bool_flag_init(bool* first, bool* end) { first_mark = first, end_of_marks = end; }
extern "C" void __sanitizer_cov_pcs_init(const std::uintptr_t* first, const std::uintptr_t*) { first_place = first; }
"""
FUNCTIONS = """
    module.def("take_marks", [] {
        pybind11::array_t<bool> marks(end_of_marks - first_mark);
        std::copy(first_mark, end_of_marks, marks.mutable_data());
        std::fill(first_mark, end_of_marks, false);
        return marks;
    });
    module.def("places", [] {
        Dl_info module{};
        dladdr(first_mark, &module);
        pybind11::array_t<std::uint64_t> places(end_of_marks - first_mark);
        for (std::ptrdiff_t i = 0; i < places.size(); ++i)
            places.mutable_data()[i] = first_place[2 * i] - reinterpret_cast<std::uintptr_t>(module.dli_fbase);
        return places;
    });
"""


def marked(text: str) -> str:
    """The text of bindings/module.cpp with the functions that read the marks."""
    return MARKS + re.sub(r"(PYBIND11_MODULE\([^{]*\{)", lambda match: match.group(1) + FUNCTIONS, text)


def counted(core: Any, count: int, seed: int, out: Path) -> None:
    """Runs calls of all kinds; a line of JSON and a row of marks for each in `out`."""
    import calls
    import switched

    rows = []
    with out.with_suffix(".jsonl").open("w", encoding="utf-8") as file:
        for kind, call in calls.of_all_kinds(count, seed):
            core.take_marks()
            end = switched.ended(call)
            rows.append(np.packbits(core.take_marks()))
            file.write(json.dumps({"kind": kind, "name": call[0], **vars(end)}) + "\n")
            file.flush()
    np.savez_compressed(out.with_suffix(".npz"), marks=np.array(rows), places=core.places())


def report(folder: Path, native: Path, most: int) -> None:
    """Prints the lines that begin a branch which at most so many of all calls counted in the folder ran."""
    (module,) = (folder / "modules/marks/fairing").glob("_core.*.so")
    reached, count = _by_line(module, sorted(folder.glob("reached, seed *.npz")))
    print(f"{count} calls")
    for (file, number), calls in sorted(reached.items()):
        if calls <= most:
            print(f"{file}:{number} {calls}  {(native / file).read_text().splitlines()[number - 1].strip()}")


def _by_line(module: Path, runs: list[Path]) -> tuple[dict[tuple[str, int], int], int]:
    """For each file and line the calls that ran it; all calls."""
    loaded = [np.load(run) for run in runs]
    places = loaded[0]["places"]
    marks = np.concatenate([np.unpackbits(run["marks"], axis=1, count=len(places)) for run in loaded]).astype(bool)
    by_line: dict[tuple[str, int], Any] = {}
    for place, line in enumerate(_lines(module, places)):
        file, _, number = line.partition("/native/")[2].partition(":")
        at = (file, int(number.split(" ")[0] or 0))  # a discriminator may follow
        if at[1]:
            by_line[at] = marks[:, place] | by_line.get(at, False)
    return {line: int(ran.sum()) for line, ran in by_line.items()}, len(marks)


def _lines(module: Path, places: Any) -> list[str]:
    command = ["llvm-symbolizer-14", f"--obj={module}", "--no-inlines", "--output-style=GNU", "--functions=none"]
    asked = "\n".join(hex(int(place)) for place in places)
    return subprocess.run(command, input=asked, capture_output=True, text=True, check=True).stdout.splitlines()
