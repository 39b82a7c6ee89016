#include "fill/first_surface.h"

#include <numeric>

#include "method/ladder.h"
#include "proxy/proxy_mesh.h"

namespace fairing {

namespace {

constexpr Sizing sizing{0.5, 0.06, 20000};  // units of D

Patch outline_patch(const OpenOutline& outline) {
    PatchMembers members;
    members.to_input.resize(static_cast<std::size_t>(outline.points.cols()));
    std::iota(members.to_input.begin(), members.to_input.end(), 0);
    members.input_triangle.resize(static_cast<std::size_t>(outline.triangles.cols()));
    std::iota(members.input_triangle.begin(), members.input_triangle.end(), 0);
    members.pin.assign(members.to_input.size(), 0);
    members.triangles = outline.triangles;
    return Patch(std::move(members));
}

Problem problem_on(const OpenOutline& outline, const Patch& patch, const SolverOptions& options) {
    return {patch, outline.points, outline.normals, uniform_weights(patch), options};
}

}  // namespace

FirstSurface first_surface(const OpenOutline& outline, const SolverOptions& options, const Progress& progress) {
    ProxyMesh mesh(outline_patch(outline), outline.points);
    mesh.adapt(sizing);
    auto snapshot = mesh.snapshot();
    Solution solution = solve_global(problem_on(outline, snapshot.patch, options), progress);
    return {std::move(snapshot.patch), std::move(solution)};
}

}  // namespace fairing
