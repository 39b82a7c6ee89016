#include "law.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace fairing::fuzz {

namespace {

bool same_bits(const Points& one, const Points& other, int column) {
    return std::memcmp(one.col(column).data(), other.col(column).data(), 3 * sizeof(double)) == 0;
}

std::vector<char> used_vertices(const MeshInput& mesh) {
    std::vector<char> used(static_cast<int>(mesh.vertices.cols()), 0);
    for (int v : mesh.triangles.reshaped()) used[v] = 1;
    return used;
}

}  // namespace

void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "== BREACH: %s\n", what);
    std::abort();
}

void check_elements(const Diagnostic& diagnostic, const MeshInput& mesh) {
    require(code_name(diagnostic.code) != "UNKNOWN" && !diagnostic.message.empty(), "a diagnostic says what it is");
    // A vertex that does not exist can't be named otherwise.
    if (diagnostic.code == Code::index_range) return;
    const auto count = diagnostic.kind == ElementKind::vertex ? mesh.vertices.cols() : mesh.triangles.cols();
    for (int element : diagnostic.elements) require(element >= 0 && element < count, "elements of diagnostics exist");
}

void check_fair(const FairResult& result, const MeshInput& mesh, const FairOptions& options) {
    require(result.vertices.cols() == mesh.vertices.cols(), "as many vertices as were given");
    require(result.boundary_angle.size() == static_cast<Eigen::Index>(result.fixed.size()),
            "an angle per fixed vertex");
    std::vector<char> used = used_vertices(mesh);
    for (int v : result.fixed) {
        require(same_bits(result.vertices, mesh.vertices, v), "fixed vertices stay");
        used[v] = 0;
    }
    for (int v = 0; v < static_cast<int>(used.size()); ++v) {
        require(used[v] ? result.vertices.col(v).allFinite() : same_bits(result.vertices, mesh.vertices, v),
                "free vertices are finite, unused ones stay");
    }
    require(result.mean_curvature.allFinite(), "H is finite");
    require((result.boundary_angle.array() >= 0.0).all() && (result.boundary_angle.array() <= 180.0).all(),
            "angles are angles");
    require(result.iterations >= 0 && !result.levels.empty(), "levels and iterations are reported");
    require(result.converged == (result.termination == Termination::converged), "converged means terminated so");
    require(!result.converged || std::isfinite(result.residual), "what converged has a residual");
    require(options.solver.max_iterations > 0, "options are valid");
    for (const Diagnostic& warning : result.warnings) check_elements(warning, mesh);
}

void check_same(const FairResult& one, const FairResult& other) {
    for (int v = 0; v < one.vertices.cols(); ++v) {
        require(same_bits(one.vertices, other.vertices, v), "the same input gives the same bits");
    }
    require(one.iterations == other.iterations && one.residual == other.residual, "the same run is reported");
}

}  // namespace fairing::fuzz
