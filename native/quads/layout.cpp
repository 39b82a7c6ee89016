#include "quads/layout.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <Eigen/Geometry>

#include "base/progress.h"
#include "geometry/angle.h"
#include "quads/shapes.h"

namespace fairing {

QuadLayout::QuadLayout(const FlatMap& map, const Patch& patch, const Points& points, const TargetSurface& surface)
    : map_(map), patch_(patch), points_(points), surface_(surface) {
    for (const Indices& loop : map.loops()) rim_.insert(rim_.end(), loop.begin(), loop.end());
    normals_.resize(3, patch.triangle_count());
    Points at_vertex = Points::Zero(3, patch.vertex_count());
    for (int t = 0; t < patch.triangle_count(); ++t) {
        normals_.col(t) = surface.face_normal(t);
        for (const int v : patch.triangles.col(t)) at_vertex.col(v) += normals_.col(t);
    }
    rim_normals_ = at_vertex(Eigen::all, rim_).colwise().normalized();
}

// On the flat triangle.
void QuadLayout::put(LaidOut& laid, int vertex, const SurfacePoint& where) const {
    const auto corners = patch_.triangles.col(where.triangle);
    laid.where[vertex - rim_.size()] = where;
    laid.points.col(vertex) = points_(Eigen::all, corners) * where.weights;
    laid.normals.col(vertex) = normals_.col(where.triangle);
}

LaidOut QuadLayout::laid_out(const QuadPattern& pattern, const Relaxation& effort) const {
    const int rim = pattern.boundary_count;
    const FlatMap::Flat flat = map_.places(pattern);
    LaidOut result;
    result.points.resize(3, pattern.vertex_count);
    result.points.leftCols(rim) = points_(Eigen::all, rim_);
    result.normals.resize(3, pattern.vertex_count);
    result.normals.leftCols(rim) = rim_normals_;
    result.where.resize(static_cast<std::size_t>(pattern.vertex_count - rim));
    for (int v = rim; v < pattern.vertex_count; ++v) put(result, v, map_.located(flat.col(v)));
    SquareSteps steps(pattern);
    for (int sweep = 0; sweep < effort.sweeps; ++sweep) {
        if (sweep % 16 == 0) checkpoint();
        const Points wanted = steps.wanted(result.points, result.normals);
        for (int v = rim; v < pattern.vertex_count; ++v)
            put(result, v, surface_.project(wanted.col(v), result.where[v - rim].triangle));
    }
    mend(result, pattern, effort.passes);
    for (int v = rim; v < pattern.vertex_count; ++v) result.points.col(v) = surface_.position(result.where[v - rim]);
    result.shapes = shapes_of(pattern, result.points, result.normals, map_.edge_length());
    return result;
}

// Vertices of quads with unfit angles go where the fourth powers of the errors around sum to less.
void QuadLayout::mend(LaidOut& laid, const QuadPattern& pattern, int passes) const {
    const int rim = pattern.boundary_count;
    std::vector<Indices> stars(static_cast<std::size_t>(pattern.vertex_count));
    for (std::size_t q = 0; q < pattern.quads.size(); ++q) {
        for (const int v : pattern.quads[q]) stars[v].push_back(static_cast<int>(q));
    }
    const auto angle_at = [&](const std::array<int, 4>& quad, int k) {
        const auto at = [&](int j) -> Vector3 { return laid.points.col(quad[(k + j) % 4]); };
        return angle_of_corner(at(3), at(0), at(1), normal_at(quad, laid.normals));
    };
    const auto error_around = [&](int v) {
        double sum = 0.0;
        for (const int q : stars[v]) {
            for (int k = 0; k < 4; ++k) sum += std::pow(angle_error(angle_at(pattern.quads[q], k)), 4);
        }
        return sum;
    };
    double step = 0.3;  // of the mean distance of the neighbours
    for (int pass = 0; pass < passes; ++pass, step = pass % 12 == 11 ? 0.3 : 0.75 * step) {
        std::set<int> moving;
        for (const auto& quad : pattern.quads) {
            bool unfit = false;
            for (int k = 0; k < 4; ++k) unfit = unfit || is_unfit(angle_at(quad, k));
            for (const int v : quad) {
                if (unfit && v >= rim) moving.insert(v);
            }
        }
        for (const int v : moving) {
            const SurfacePoint before = laid.where[v - rim];
            const Vector3 here = laid.points.col(v);
            const Vector3 n = laid.normals.col(v);
            const auto& quad = pattern.quads[stars[v].front()];
            const double reach = 0.5 * (laid.points.col(quad[0]) - laid.points.col(quad[2])).norm();
            const Vector3 along = (std::abs(n.x()) < 0.8 ? Vector3::UnitX() : Vector3::UnitY()).cross(n).normalized();
            SurfacePoint best = before;
            double least = error_around(v);
            for (int k = 0; k < 8; ++k) {
                const double angle = 45.0 * k * degree;
                const Vector3 away = std::cos(angle) * along + std::sin(angle) * n.cross(along);
                const SurfacePoint there = surface_.project(here + step * reach * away, before.triangle);
                put(laid, v, there);
                const double error = error_around(v);
                if (error >= least) continue;
                least = error;
                best = there;
            }
            put(laid, v, best);
        }
    }
}

}  // namespace fairing
