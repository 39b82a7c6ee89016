#include "base/errors.h"

namespace fairing {

namespace {

constexpr auto last = Code::unclear_cells;  // of the codes

constexpr std::array<std::string_view, static_cast<std::size_t>(last) + 1> names{
    "NONFINITE",
    "INDEX_RANGE",
    "NONMANIFOLD_EDGE",
    "NONMANIFOLD_VERTEX",
    "NOT_ORIENTABLE",
    "NO_BOUNDARY",
    "NO_FREE_VERTICES",
    "ZERO_NORMAL",
    "DEGENERATE_FACE",
    "INCONSISTENT_WINDING",
    "OPEN_BORDER_IN_SELECTION",
    "NORMALS_FROM_PATCH",
    "NORMALS_OPPOSE_WINDING",
    "PIN_NORMAL_IGNORED",
    "SHARP_BOUNDARY",
    "FLIPPED_TRIANGLES",
    "FOLDED",
    "SELF_INTERSECTION",
    "REFERENCE_UNUSABLE",
    "NOT_CONVERGED",
    "NO_SOLUTION",
    "PRECISION",
    "G2_NOT_MET",
    "PINS_NOT_SPREAD",
    "OUTLINE_KEPT",
    "NOT_A_LOOP",
    "NOT_A_HOLE",
    "LOOPS_NOT_JOINED",
    "OUT_OF_PROPORTION",
    "NOT_TANGENT",
    "EDGES_LEFT_ALONE",
    "NO_QUAD_ROWS",
    "NO_SEAM",
    "SEAM_ON_BORDER",
    "WIDTH_TOO_LARGE",
    "WIRES_END",
    "WIRES_CROSS",
    "NO_CELL",
    "UNCLEAR_CELLS",
};
static_assert(!names.back().empty(), "each code has a name");

}  // namespace

std::span<const std::string_view> code_names() { return names; }

std::string_view code_name(Code code) { return names[static_cast<std::size_t>(code)]; }

}  // namespace fairing
