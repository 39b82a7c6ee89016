#include "fill/first_surface.h"

#include <set>

#include "accept/accept.h"
#include "fill/ball_start.h"
#include "fill/edge_lengths.h"
#include "fill/equal_edge_mesh.h"
#include "fill/joined_loops.h"
#include "fill/tube_start.h"
#include "geometry/face_geometry.h"
#include "geometry/triangle.h"
#include "method/solve.h"
#include "problem/surface_state.h"
#include "proxy/proxy_mesh.h"
#include "reuse/warm_start.h"
#include "stand_in/stand_in.h"

namespace fairing {

namespace {

constexpr Sizing usual_sizing{0.5, 0.06, 20000};    // units of D
constexpr Sizing sizing_at_once{0.5, 0.12, 20000};  // likewise, of a mesh that is never solved on
constexpr double first_count = 400.0;  // vertices of a mesh of equal edges, about, where the boundary is no finer

Patch made_patch(int free_count, Triangles triangles, Eigen::Index vertex_count) {
    PatchMembers members;
    members.free_count = free_count;
    members.to_input.resize(static_cast<std::size_t>(vertex_count));
    std::iota(members.to_input.begin(), members.to_input.end(), 0);
    members.input_triangle.resize(static_cast<std::size_t>(triangles.cols()));
    std::iota(members.input_triangle.begin(), members.input_triangle.end(), 0);
    members.pin.assign(members.to_input.size(), 0);
    members.triangles = std::move(triangles);
    return Patch(std::move(members));
}

// Mean cosine between the triangles and the normals at their corners, by area.
double agreement(const OpenBoundary& boundary, const Triangles& triangles) {
    double along = 0.0;
    double whole = 0.0;
    for (const auto corners : triangles.colwise()) {
        const Vector3 area = area_vector(boundary.points, corners);
        for (const int v : corners) along += area.dot(boundary.normals.col(v)) / 3.0;
        whole += area.norm();
    }
    return whole > 0.0 ? along / whole : 1.0;
}

// Whether no edge has more than two triangles, nor two of the same direction. A triangulation that follows the normals
// of two walls caps both of them and has the link between the caps four times.
bool is_surface(const Triangles& triangles) {
    std::set<std::array<int, 2>> sides;
    for (const auto corners : triangles.colwise()) {
        for (int k = 0; k < 3; ++k) {
            if (!sides.insert({corners[k], corners[(k + 1) % 3]}).second) return false;
        }
    }
    return true;
}

// The triangulation of least area. Where that closes a limb instead of going around it: the one that follows the
// normals, which a minimal surface has none of.
Triangles triangulated(const OpenBoundary& boundary, Equation equation) {
    constexpr double better = 0.25;  // of the mean cosine
    const Triangles least = joined_loops(boundary.points, boundary.loops);
    const double before = agreement(boundary, least);
    if (before + better >= 1.0 || equation == Equation::soap_film) return least;
    const Triangles along = joined_loops(boundary.points, boundary.loops, &boundary.normals);
    return agreement(boundary, along) > before + better && is_surface(along) ? along : least;
}

// A mesh whose first patch.free_count vertices are free.
struct Meshed {
    Patch patch;
    Points points;
};

Meshed meshed(const EqualEdgeMesh& mesh, const Points& boundary) {
    EqualEdgeMesh::Result made = mesh.result();
    Points points(3, made.points.cols() + boundary.cols());
    points << made.points, boundary;
    const int free_count = static_cast<int>(made.points.cols());
    return {made_patch(free_count, std::move(made.triangles), points.cols()), std::move(points)};
}

// With a vertex in the middle of the largest triangle, where no vertex is free: between chords at sharp corners.
Meshed with_free_vertex(const Triangles& triangles, const Points& boundary) {
    FaceGeometry faces(boundary, triangles);
    Eigen::Index largest = 0;
    faces.areas.maxCoeff(&largest);
    Triangles fan(3, triangles.cols() + 2);
    fan << triangles, triangles.col(largest), triangles.col(largest);
    fan.array() += 1;
    fan(0, largest) = fan(1, triangles.cols()) = fan(2, triangles.cols() + 1) = 0;
    Points points(3, boundary.cols() + 1);
    points << boundary(Eigen::all, triangles.col(largest)).rowwise().mean(), boundary;
    return {made_patch(1, std::move(fan), points.cols()), std::move(points)};
}

// Coarse and flat, no two vertices of the boundary joined across it but at sharp corners.
Meshed first_mesh(const OpenBoundary& boundary, Equation equation, const Sizing& sizing) {
    const Triangles triangles = triangulated(boundary, equation);
    ProxyMesh mesh(made_patch(0, triangles, boundary.points.cols()), boundary.points);
    mesh.adapt(sizing);
    const auto snapshot = mesh.snapshot();
    const Points flat = Points::Zero(3, snapshot.points.cols());
    const TargetSurface surface(snapshot.patch, snapshot.points, flat);
    const VectorX lengths = VectorX::Ones(snapshot.points.cols());
    EqualEdgeMesh chordless(snapshot.patch, snapshot.points, surface, lengths, {}, boundary.taken);
    chordless.split_chords();
    Meshed made = meshed(chordless, boundary.points);
    return made.patch.free_count > 0 ? made : with_free_vertex(made.patch.triangles, boundary.points);
}

Problem problem_on(const OpenBoundary& boundary, const Patch& patch, const SolverOptions& options) {
    return {patch, boundary.points, boundary.normals, uniform_weights(patch), options};
}

VectorX equal_lengths(const Patch& patch, const Points& points) {
    FaceGeometry faces(points, patch.triangles);
    return edge_lengths(patch, points,
                        {std::sqrt(vertices_per_square * faces.areas.sum() / first_count), 0, Spread::equal});
}

// A mesh of some 400 vertices on the surface found, or more where the boundary is fine.
Meshed with_equal_edges(const OpenBoundary& boundary, const Patch& patch, const Points& points,
                        const SolverOptions& options) {
    const SurfaceState state = measured_surface(problem_on(boundary, patch, options), points);
    const TargetSurface surface(patch, points, state.normals);
    const VectorX lengths = equal_lengths(patch, points);
    EqualEdgeMesh mesh(patch, points, surface, lengths, {}, boundary.taken);
    mesh.equalise();
    return meshed(mesh, boundary.points);
}

// Where the surface bulges out so far that it is found from a ball only.
std::optional<FirstSurface> from_ball(const OpenBoundary& boundary, const Meshed& flat, const SolverOptions& options,
                                      const Progress& progress) {
    if (options.equation == Equation::soap_film) return std::nullopt;
    const std::optional<Points> ball = ball_start(flat.patch, flat.points, boundary.normals);
    if (!ball) return std::nullopt;
    Meshed equal = with_equal_edges(boundary, flat.patch, *ball, options);
    std::optional<Solution> solution =
        solve_near(problem_on(boundary, equal.patch, options), {equal.points, true}, progress);
    if (!solution) return std::nullopt;
    return FirstSurface{std::move(equal.patch), std::move(*solution)};
}

Meshed tube_mesh(const OpenBoundary& boundary, const SweptTube& swept, const SolverOptions& options) {
    TubeMesh tube = tube_start(swept);
    const auto added = tube.points.cols();
    Points points(3, added + boundary.points.cols());
    points << tube.points, boundary.points;
    const Patch patch = made_patch(static_cast<int>(added), std::move(tube.triangles), points.cols());
    return with_equal_edges(boundary, patch, points, options);
}

bool may_be_replaced(const SolverOptions& options) {
    const bool has_stand_in = options.equation != Equation::least_variation && options.equation != Equation::soap_film;
    return has_stand_in && options.otherwise != Otherwise::stop;
}

// Where a tube bends so much that the flat mesh grows into something else. The harmonic surface, or that of least
// variation where it has none. Where a wide bend has neither, a loft: other meshes found it no other surface,
// in 4 to 15 s.
std::optional<FirstSurface> from_tube(const OpenBoundary& boundary, const SolverOptions& options,
                                      const Progress& progress) {
    const auto swept = SweptTube::between(boundary.loops, boundary.points, boundary.normals);
    if (!swept) return std::nullopt;
    Meshed equal = tube_mesh(boundary, *swept, options);
    const Problem problem = problem_on(boundary, equal.patch, options);
    std::optional<Solution> solution;
    if (options.equation != Equation::least_variation)
        solution = solve_near(problem, {equal.points, true}, progress.range(0.0, 0.3));
    if (!solution && options.equation != Equation::soap_film)
        solution = solve_stand_in_roughly(problem, equal.points, progress.range(0.3, 1.0));
    if (!solution && swept->turn() > wide_bend && may_be_replaced(options)) solution = lofted(problem, progress.here());
    if (!solution) return std::nullopt;
    return FirstSurface{std::move(equal.patch), std::move(*solution)};
}

// From a coarse and flat mesh.
FirstSurface from_flat(const OpenBoundary& boundary, const SolverOptions& options, const Progress& progress) {
    Meshed flat = first_mesh(boundary, options.equation, usual_sizing);
    std::optional<FirstSurface> found = from_ball(boundary, flat, options, progress.range(0.0, 0.2));
    if (found) return std::move(*found);
    Solution solution = solve(problem_on(boundary, flat.patch, options), 0.0, progress.range(0.2, 1.0));
    return {std::move(flat.patch), std::move(solution)};
}

FirstSurface sought(const OpenBoundary& boundary, const SolverOptions& options, const Progress& progress) {
    std::optional<FirstSurface> begun = from_tube(boundary, options, progress.range(0.0, 0.2));
    return begun ? std::move(*begun) : from_flat(boundary, options, progress.range(0.2, 1.0));
}

// Joined by a loft over the mesh of a tube, or over the last mesh, if there is one.
FirstSurface with_loft(const OpenBoundary& boundary, const SolverOptions& options, FirstSurface last,
                       const Progress& progress) {
    if (const auto swept = SweptTube::between(boundary.loops, boundary.points, boundary.normals)) {
        Meshed equal = tube_mesh(boundary, *swept, options);
        if (auto loft = lofted(problem_on(boundary, equal.patch, options), progress))
            return {std::move(equal.patch), std::move(*loft)};
    }
    if (auto loft = lofted(problem_on(boundary, last.patch, options), progress)) last.solution = std::move(*loft);
    return last;
}

}  // namespace

FirstSurface flat_surface(const OpenBoundary& boundary) {
    Meshed flat = first_mesh(boundary, Equation::harmonic, sizing_at_once);
    Solution solution;
    const bool is_ball = ball_start(flat.patch, flat.points, boundary.normals).has_value();
    solution.termination = is_ball ? Termination::stalled : Termination::converged;
    solution.points = std::move(flat.points);
    return {std::move(flat.patch), std::move(solution)};
}

FirstSurface first_surface(const OpenBoundary& boundary, const SolverOptions& asked, const Progress& progress) {
    SolverOptions options = asked;  // automatic chooses where the solution is sought
    if (asked.equation == Equation::automatic) options.equation = Equation::harmonic;
    FirstSurface result = sought(boundary, options, progress.range(0.0, 0.8));
    if (end_of(result.solution) == Termination::converged || !may_be_replaced(options) || boundary.loops.size() < 2)
        return result;
    return with_loft(boundary, options, std::move(result), progress.range(0.8, 1.0));
}

}  // namespace fairing
