#include "api/diagnose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "base/text.h"
#include "geometry/face_geometry.h"
#include "geometry/flips.h"
#include "geometry/outline_angles.h"
#include "geometry/self_intersection.h"

namespace fairing {

namespace {

constexpr double behind = 90.0;  // degrees

void warn_of_flips(const Patch& patch, const Points& points, Diagnostics& warnings) {
    Indices flipped = input_numbers(patch, flipped_triangles(patch, points));
    if (flipped.empty()) return;
    warnings.push_back(
        {Code::flipped_triangles,
         counted(flipped.size(), "triangle of the result is turned over", "triangles of the result are turned over"),
         std::move(flipped), ElementKind::triangle});
}

void warn_of_sharp_outline(const Patch& patch, const Points& prescribed, Diagnostics& warnings) {
    constexpr double widest_turn = 20.0;
    Indices sharp;
    double widest = 0.0;
    for (int e = 0; e < patch.edge_count(); ++e) {
        if (patch.edge_triangles[at(e)][1] != none) continue;
        const auto [a, b] = patch.edge_ends[at(e)];
        const double turn = degrees_between(prescribed.col(a - patch.free_count), prescribed.col(b - patch.free_count));
        widest = std::max(widest, turn);
        if (turn > widest_turn) sharp.insert(sharp.end(), {patch.to_input[at(a)], patch.to_input[at(b)]});
    }
    if (sharp.empty()) return;
    warnings.push_back({Code::sharp_boundary,
                        "the normals along the outline turn by up to " + std::to_string(std::lround(widest)) +
                            "° from one vertex to the next; a finer outline gives a more accurate surface",
                        std::move(sharp)});
}

void warn_of_crossings(const Patch& patch, const Points& points, Diagnostics& warnings) {
    Indices crossing = crossing_triangles(patch.triangles, points);
    if (crossing.empty()) return;
    crossing = input_numbers(patch, std::move(crossing));
    warnings.push_back({Code::self_intersection,
                        counted(crossing.size(), "triangle of the result passes through others of the patch",
                                "triangles of the result pass through others of the patch"),
                        std::move(crossing), ElementKind::triangle});
}

}  // namespace

Indices input_numbers(const Patch& patch, Indices triangles) {
    for (int& t : triangles) t = patch.input_triangle[at(t)];
    return triangles;
}

bool is_usable_reference(const Patch& patch, const Points& reference, Diagnostics& warnings) {
    constexpr double needle = 0.02;  // a right triangle of 90 : 1
    constexpr double tolerated_share = 0.1;
    Indices bad = input_numbers(patch, flipped_triangles(patch, reference));
    std::vector<char> has_area(at(patch.vertex_count()), 0);
    for (int t = 0; t < patch.triangle_count(); ++t) {
        const auto corners = patch.triangles.col(t);
        const double shape =
            triangle_shape(reference.col(corners[0]), reference.col(corners[1]), reference.col(corners[2]));
        if (!(shape >= needle)) bad.push_back(patch.input_triangle[at(t)]);
        for (int v : corners) has_area[at(v)] = has_area[at(v)] || shape > 0.0;
    }
    // A vertex whose whole neighbourhood is a point or a line hangs on nothing.
    const bool collapsed =
        std::find(has_area.begin(), has_area.begin() + patch.free_count, 0) != has_area.begin() + patch.free_count;
    std::sort(bad.begin(), bad.end());
    bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
    if (!collapsed && static_cast<double>(bad.size()) <= tolerated_share * patch.triangle_count()) return true;
    warnings.push_back({Code::reference_unusable,
                        counted(bad.size(), "triangle of the reference mesh is a needle or turned over",
                                "triangles of the reference mesh are needles or turned over") +
                            ", so that no distribution of vertices can be read off it; uniform inner fairness was used",
                        std::move(bad), ElementKind::triangle});
    return false;
}

void warn_of_precision(const Patch& patch, const Points& input, const Precision& wanted, Diagnostics& warnings) {
    constexpr double tolerated_share = 1e-3;  // of the mean border edge
    double length = 0.0;
    int count = 0;
    for (int e = 0; e < patch.edge_count(); ++e) {
        if (patch.edge_triangles[at(e)][1] != none) continue;
        const auto [a, b] = patch.edge_ends[at(e)];
        length += (input.col(patch.to_input[at(a)]) - input.col(patch.to_input[at(b)])).stableNorm();
        ++count;
    }
    double farthest = 0.0;
    for (int v : patch.to_input) farthest = std::max(farthest, input.col(v).cwiseAbs().maxCoeff());
    const double spacing = farthest * std::numeric_limits<double>::epsilon();
    const double edge = count > 0 ? length / count : wanted.diameter;
    if (spacing <= std::min(tolerated_share * edge, wanted.tolerance * wanted.diameter)) return;
    warnings.push_back({Code::precision,
                        "this far from the origin, coordinates can't be told apart as finely as the tolerance and the "
                        "edges ask for: move the mesh nearer to the origin",
                        {}});
}

std::string reason_of(const Solution& solution, const VectorX& angles) {
    if (solution.reached_load > 0.0) {
        return "was solved with " + std::to_string(std::lround(100.0 * solution.reached_load)) +
               " % of the load only and keeps that surface; more load may have no solution";
    }
    switch (solution.flaw) {
        case Flaw::collapsed: return "fell together to a point or a line: fix more vertices around it";
        case Flaw::behind:
            return "runs into its outline from behind at " + std::to_string((angles.array() > behind).count()) +
                   " of " + std::to_string((angles.array() > 0.0).count()) +
                   " vertices, which is not the surface asked for: where little of a shape is left outside, leave "
                   "more of it";
        case Flaw::folded:
        case Flaw::crossing:
            return "has a surface, but its vertices can't be placed on it without folds: " +
                   counted(solution.bad_triangles.size(), "triangle is", "triangles are") +
                   (solution.flaw == Flaw::folded ? " turned over" : " passing through others");
        default: return "did not converge; its positions are the best that were found";
    }
}

void diagnose(const Patch& patch, const Points& points, const Points& prescribed, Diagnostics& warnings) {
    warn_of_flips(patch, points, warnings);
    warn_of_crossings(patch, points, warnings);
    warn_of_sharp_outline(patch, prescribed, warnings);
}

}  // namespace fairing
