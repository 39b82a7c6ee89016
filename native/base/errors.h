// Error and warning vocabulary of the engine: every message carries a code and the elements that it is about.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/types.h"

namespace fairing {

enum class Code {
    nonfinite,
    index_range,
    nonmanifold_edge,
    nonmanifold_vertex,
    not_orientable,
    no_boundary,
    no_free_vertices,
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
    precision,
};

// The upper-case name that callers see, e.g. "NONMANIFOLD_EDGE".
std::string_view code_name(Code code);

// What the indices in `elements` count. Edges are given by their two vertices, one after the other.
enum class ElementKind { vertex, triangle };

struct Diagnostic {
    Code code;
    std::string message;
    Indices elements;
    ElementKind kind = ElementKind::vertex;
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

}  // namespace fairing
