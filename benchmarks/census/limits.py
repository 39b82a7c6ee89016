"""The engine with limits that can be set while it runs: one build for all rows of limits.toml.

In a copy of the sources every `constexpr double name = …` (int and the like, too) becomes a reference into a table,
which two functions of the module read and set. Array sizes and the innermost rooms stay as they are.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from pathlib import Path

ROOMS_AS_THEY_ARE = ("base", "linear", "mesh")
FILES_AS_THEY_ARE = ("boundary/least_variation_curve.cpp",)
NAMES_AS_THEY_ARE = (
    "geometry/box_tree.cpp:bits", "geometry/box_tree.cpp:digits", "geometry/box_tree.cpp:last",
    "geometry/box_tree.cpp:passes", "geometry/neighbourhood.h:most_rings", "geometry/slope_fit.cpp:cubic_terms",
    "geometry/slope_fit.cpp:quadratic_terms", "geometry/slope_fit.cpp:sphere_terms",
    "geometry/tall_system.h:most_columns", "multigrid/tangential_multigrid.cpp:largest_eigenvalue",
    "multigrid/tangential_multigrid.cpp:first", "multigrid/tangential_multigrid.cpp:keep",
    "multigrid/tangential_multigrid.cpp:add", "shape/girth.cpp:first", "shape/girth.cpp:section_count",
    "variation/newton.h:raised_damping", "variation/stencil.h:stencil_size",
)  # fmt: skip
LIMIT = re.compile(
    r"^(\s*)((?:inline |static )*)constexpr (double|int|std::size_t) ([a-z_0-9]+) ?(?:=\s*|\{)(.*?)\}?;", re.MULTILINE
)
AGGREGATE = re.compile(r"^(\s*(?:inline |static )*)constexpr ((?:[A-Z]\w*|std::array) ?[a-z_]*\{)", re.MULTILINE)
TABLE = """#pragma once
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
namespace census {
struct Limit { std::string name; std::function<double()> get; std::function<void(double)> set; };
inline std::deque<Limit>& limits() { static std::deque<Limit> all; return all; }
inline std::map<std::string, double>& wanted() { static std::map<std::string, double> all; return all; }
template <class T, class V> const T& limit(const char* name, V value) {
    static std::mutex mutex;
    const std::lock_guard<std::mutex> lock(mutex);
    T* place = new T(static_cast<T>(value));
    if (const auto found = wanted().find(name); found != wanted().end()) *place = static_cast<T>(found->second);
    limits().push_back({name, [place] { return static_cast<double>(*place); },
                        [place](double to) { *place = static_cast<T>(to); }});
    return *place;
}
}  // namespace census
"""
FUNCTIONS = """
    module.def("limits", [] {
        std::map<std::string, double> all;
        for (const auto& each : census::limits()) all[each.name] = each.get();
        return all;
    });
    module.def("set_limit", [](const std::string& name, double value) {
        census::wanted()[name] = value;
        for (const auto& each : census::limits()) if (each.name == name) each.set(value);
    });
"""


def make_settable(native: Path, files: Collection[str] | None = None) -> int:
    """Rewrites the sources of a copy, or those named; the number of limits."""
    (native / "base/census_limits.h").write_text(TABLE)
    count = 0
    for path in sorted([*native.rglob("*.h"), *native.rglob("*.cpp")]):
        name = path.relative_to(native).as_posix()
        text = path.read_text()
        changed, found = text, 0
        if files is None or name in files:
            changed, found = LIMIT.subn(lambda match, name=name: _settable(match, name), text)
            changed = AGGREGATE.sub(r"\1const \2", changed)  # of members that can be set now
        count += found if changed != text else 0
        if name == "bindings/module.cpp":
            changed = re.sub(r"(PYBIND11_MODULE\([^{]*\{)", lambda match: match.group(1) + FUNCTIONS, text)
            changed = f"#include <pybind11/stl.h>\n{changed}"
        if changed != text:
            path.write_text(_including(changed, is_header=name.endswith(".h")))
    return count


def _settable(match: re.Match[str], file: str) -> str:
    indent, words, kind, name, value = match.groups()
    key = f"{file}:{name}"
    if file.split("/")[0] in ROOMS_AS_THEY_ARE or file in FILES_AS_THEY_ARE or key in NAMES_AS_THEY_ARE:
        return match.group(0)
    inside = "static inline " if "static" in words else "static "
    outside = "inline " if file.endswith(".h") else "static "
    return f'{indent}{inside if indent else outside}const {kind}& {name} = census::limit<{kind}>("{key}", {value});'


def _including(text: str, *, is_header: bool) -> str:
    line = '#include "base/census_limits.h"\n'
    return text.replace("#pragma once\n", f"#pragma once\n{line}", 1) if is_header else line + text
