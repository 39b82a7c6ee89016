#include "quads/layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include "base/errors.h"
#include "base/progress.h"
#include "fill/conformal_map.h"
#include "fill/harmonic_values.h"
#include "geometry/angle.h"
#include "quads/shapes.h"

namespace fairing {

namespace {

// Of twice its area, by its corners in the plane.
double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

std::set<std::pair<int, int>> edges_of(const QuadPattern& pattern) {
    std::set<std::pair<int, int>> edges;
    const auto add = [&edges](const auto& face) {
        for (std::size_t k = 0; k < face.size(); ++k) {
            const int next = face[(k + 1) % face.size()];
            edges.emplace(std::min(face[k], next), std::max(face[k], next));
        }
    };
    for (const auto& quad : pattern.quads) add(quad);
    for (const auto& triangle : pattern.triangles) add(triangle);
    return edges;
}

}  // namespace

QuadLayout::QuadLayout(const Patch& patch, const Points& points, const TargetSurface& surface)
    : patch_(patch), points_(points), surface_(surface), loop_(patch.loops().front()) {
    const Flat round = round_boundary();
    Eigen::MatrixXd given = Eigen::MatrixXd::Zero(patch.vertex_count() - patch.free_count, 2);
    for (std::size_t k = 0; k < loop_.size(); ++k)
        given.row(loop_[k] - patch.free_count) = round.col(static_cast<Eigen::Index>(k)).transpose();
    const std::optional<Eigen::MatrixXd> inner = harmonic_values(patch, points, given);
    if (!inner) throw SolverError("the surface can't be flattened");
    disc_.resize(2, patch.vertex_count());
    disc_.leftCols(patch.free_count) = inner->transpose();
    disc_.rightCols(given.rows()) = given.transpose();
    normals_.resize(3, patch.triangle_count());
    for (int t = 0; t < patch.triangle_count(); ++t) normals_.col(t) = surface.face_normal(t);
    sort_triangles();
}

// On the unit circle, by lengths along it.
QuadLayout::Flat QuadLayout::round_boundary() const {
    const auto count = static_cast<Eigen::Index>(loop_.size());
    VectorX at(count + 1);
    at[0] = 0.0;
    for (Eigen::Index k = 0; k < count; ++k)
        at[k + 1] = at[k] + (points_.col(loop_[(k + 1) % count]) - points_.col(loop_[k])).norm();
    Flat round(2, count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const double angle = 2.0 * std::numbers::pi * at[k] / at[count];
        round.col(k) = Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
    return round;
}

std::array<int, 2> QuadLayout::bin_of(const Eigen::Vector2d& place) const {
    const auto along = [this](double x) { return std::clamp(static_cast<int>(0.5 * (x + 1.0) * bins_), 0, bins_ - 1); };
    return {along(place.x()), along(place.y())};
}

void QuadLayout::sort_triangles() {
    bins_ = std::max(1, static_cast<int>(std::sqrt(patch_.triangle_count())));
    in_bin_.resize(static_cast<std::size_t>(bins_ * bins_));
    for (int t = 0; t < patch_.triangle_count(); ++t) {
        const auto corners = disc_(Eigen::all, patch_.triangles.col(t));
        const auto low = bin_of(corners.rowwise().minCoeff());
        const auto high = bin_of(corners.rowwise().maxCoeff());
        for (int x = low[0]; x <= high[0]; ++x) {
            for (int y = low[1]; y <= high[1]; ++y) in_bin_[x * bins_ + y].push_back(t);
        }
    }
}

// The triangle of the disc's map that a place lies in, or least out of.
SurfacePoint QuadLayout::located(const Eigen::Vector2d& place) const {
    const auto [x, y] = bin_of(place);
    SurfacePoint best;
    double most = -std::numeric_limits<double>::infinity();
    for (const int t : in_bin_[x * bins_ + y]) {
        const auto corners = patch_.triangles.col(t);
        const Eigen::Vector2d a = disc_.col(corners[0]) - place;
        const Eigen::Vector2d b = disc_.col(corners[1]) - place;
        const Eigen::Vector2d c = disc_.col(corners[2]) - place;
        const Vector3 parts(cross(b, c), cross(c, a), cross(a, b));
        const double sum = parts.sum();
        if (!(sum > 0.0) || parts.minCoeff() / sum <= most) continue;
        most = parts.minCoeff() / sum;
        best = {t, (parts / sum).cwiseMax(0.0)};
        best.weights /= best.weights.sum();
    }
    return best;
}

HoleBoundary QuadLayout::boundary() const {
    HoleBoundary result;
    const auto count = static_cast<Eigen::Index>(loop_.size());
    VectorX at = VectorX::Zero(patch_.vertex_count());
    double area = 0.0;
    for (const auto corners : patch_.triangles.colwise()) {
        for (int k = 0; k < 3; ++k) {
            const Vector3 here = points_.col(corners[k]);
            const Vector3 next = points_.col(corners[(k + 1) % 3]) - here;
            const Vector3 last = points_.col(corners[(k + 2) % 3]) - here;
            at[corners[k]] += degrees_between(next, last);
            area += next.cross(last).norm() / 6.0;
        }
    }
    result.angles = at(loop_);
    double length = 0.0;
    for (Eigen::Index k = 0; k < count; ++k)
        length += (points_.col(loop_[(k + 1) % count]) - points_.col(loop_[k])).norm() / static_cast<double>(count);
    result.cells = area / (length * length);
    const int opposite = loop_[loop_.size() / 2];
    Eigen::MatrixXd given = Eigen::MatrixXd::Zero(2, 2);
    given(1, 0) = (points_.col(opposite) - points_.col(loop_[0])).norm();
    const Eigen::MatrixXd flat = conformal_map(points_, patch_.triangles, {loop_[0], opposite}, given);
    result.places = flat(loop_, Eigen::all).transpose();
    return result;
}

QuadLayout::Flat QuadLayout::pattern_on_disc(const QuadPattern& pattern) const {
    const int rim = pattern.boundary_count;
    const int inner = pattern.vertex_count - rim;
    Flat result(2, pattern.vertex_count);
    result.leftCols(rim) = round_boundary();
    if (inner == 0) return result;
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(inner, 2);
    for (const auto& [a, b] : edges_of(pattern)) {
        for (const auto& [v, other] : {std::pair(a, b), std::pair(b, a)}) {
            if (v < rim) continue;
            entries.emplace_back(v - rim, v - rim, 1.0);
            if (other < rim)
                right.row(v - rim) += result.col(other).transpose();
            else
                entries.emplace_back(v - rim, other - rim, -1.0);
        }
    }
    Eigen::SparseMatrix<double> matrix(inner, inner);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
    result.rightCols(inner) = factor.solve(right).transpose();
    return result;
}

// On the flat triangle.
void QuadLayout::put(LaidOut& laid, int vertex, const SurfacePoint& where) const {
    const auto corners = patch_.triangles.col(where.triangle);
    laid.where[vertex - loop_.size()] = where;
    laid.points.col(vertex) = points_(Eigen::all, corners) * where.weights;
    laid.normals.col(vertex) = normals_.col(where.triangle);
}

LaidOut QuadLayout::laid_out(const QuadPattern& pattern, const Effort& effort) const {
    const int rim = pattern.boundary_count;
    const Flat flat = pattern_on_disc(pattern);
    LaidOut result;
    result.points.resize(3, pattern.vertex_count);
    result.points.leftCols(rim) = points_(Eigen::all, loop_);
    result.normals.resize(3, pattern.vertex_count);
    for (int k = 0; k < rim; ++k) result.normals.col(k) = surface_.normal(surface_.at_vertex(loop_[k]));
    result.where.resize(static_cast<std::size_t>(pattern.vertex_count - rim));
    for (int v = rim; v < pattern.vertex_count; ++v) put(result, v, located(flat.col(v)));
    SquareSteps steps(pattern);
    for (int sweep = 0; sweep < effort.sweeps; ++sweep) {
        if (sweep % 16 == 0) checkpoint();
        const Points wanted = steps.wanted(result.points, result.normals);
        for (int v = rim; v < pattern.vertex_count; ++v)
            put(result, v, surface_.project(wanted.col(v), result.where[v - rim].triangle));
    }
    mend(result, pattern, effort.passes);
    for (int v = rim; v < pattern.vertex_count; ++v) result.points.col(v) = surface_.position(result.where[v - rim]);
    result.shapes = shapes_of(pattern, result.points, result.normals);
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
        return corner_angle(at(3), at(0), at(1), normal_at(quad, laid.normals));
    };
    const auto error_around = [&](int v) {
        double sum = 0.0;
        for (const int q : stars[v]) {
            for (int k = 0; k < 4; ++k) sum += std::pow(angle_error(angle_at(pattern.quads[q], k)), 4);
        }
        return sum;
    };
    double step = 0.3;  // of the mean distance of the neighbours
    for (int pass = 0; pass < passes; ++pass, step *= 0.8) {
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
