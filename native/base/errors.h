// Reports to callers: findings about a mesh, and exceptions.
#pragma once

#include <map>
#include <stdexcept>
#include <string_view>

#include "base/types.h"

namespace fairing {

// Error and warning vocabulary of the engine: a code, the elements that it is about, and the figures of the case.
enum class Code {
    nonfinite,
    index_range,
    nonmanifold_edge,
    nonmanifold_vertex,
    not_orientable,
    no_boundary,
    no_free_vertices,
    zero_normal,
    degenerate_face,
    inconsistent_winding,
    open_border_in_selection,
    normals_from_patch,
    normals_oppose_winding,
    pin_normal_ignored,
    sharp_boundary,
    flipped_triangles,
    folded,
    self_intersection,
    reference_unusable,
    not_converged,
    no_solution,
    precision,
    g2_not_met,
    pins_not_spread,
    boundary_kept,
    not_a_loop,
    not_a_hole,
    loops_not_joined,
    out_of_proportion,
    not_tangent,
    edges_left_alone,
    no_quad_rows,
    no_seam,
    seam_on_border,
    width_too_large,
    wires_end,
    wires_cross,
    no_cell,
    unclear_cells,
};

// The upper-case names that callers see, e.g. "NONMANIFOLD_EDGE", in the order of the enumeration.
std::span<const std::string_view> code_names();
std::string_view code_name(Code code);
// The kind of element that `elements` indexes. Edges are given by their two vertices, one after the other.
enum class ElementKind { vertex, triangle };

// The figures of a message by name: counts, degrees, shares of 1; documented where a diagnostic is made.
using Figures = std::map<std::string, double>;

inline double size_of(const Indices& elements) { return static_cast<double>(elements.size()); }
// `message` is for users of the library; others make their own words from code, elements and figures.
struct Diagnostic {
    Code code;
    std::string message;
    Indices elements;
    ElementKind kind = ElementKind::vertex;
    Figures figures;
};

using Diagnostics = std::vector<Diagnostic>;

// Input that can't be faired; the caller's data is untouched.
class MeshError : public std::invalid_argument {
public:
    explicit MeshError(Diagnostic diagnostic)
        : std::invalid_argument(diagnostic.message), diagnostic_(std::move(diagnostic)) {}
    [[nodiscard]] const Diagnostic& diagnostic() const noexcept { return diagnostic_; }

private:
    Diagnostic diagnostic_;
};

// A numerical breakdown (a factorisation that fails); the caller's data is untouched.
class SolverError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// The progress callback asked to stop; the caller's data is untouched.
class Cancelled : public std::runtime_error {
public:
    Cancelled() : std::runtime_error("cancelled by the progress callback") {}
};

// The number and the phrase in singular or plural.
inline std::string counted(std::size_t count, std::string_view one, std::string_view many) {
    return std::to_string(count) + " " + std::string(count == 1 ? one : many);
}

// About these elements, whose number is the figure of that name.
inline Diagnostic about(Code code, std::string message, Indices elements, ElementKind kind, const char* figure) {
    const double count = size_of(elements);
    return {code, std::move(message), std::move(elements), kind, {{figure, count}}};
}

}  // namespace fairing
