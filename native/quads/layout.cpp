#include "quads/layout.h"

#include <set>

#include <Eigen/Geometry>

#include "base/progress.h"
#include "geometry/triangle.h"

namespace fairing {

namespace {

constexpr double of_squares = 0.3;  // their weight, relative to that of rectangles
constexpr double momentum = 0.7;    // of the last move (Polyak's heavy ball)

// The best square c ± a, c ± n × a and the rectangle with the quad's diagonals, made equally long.
std::array<Vector3, 4> square_near(const std::array<Vector3, 4>& p, const Vector3& n) {
    const Vector3 centre = 0.25 * (p[0] + p[1] + p[2] + p[3]);
    const Vector3 a = 0.5 * (p[0] - p[2]);
    const Vector3 b = 0.5 * (p[1] - p[3]);
    const Vector3 square_a = 0.5 * (a - n.cross(b));
    const Vector3 square_b = 0.5 * (b + n.cross(a));
    const double share = a.cross(b).dot(n) > 0.0 ? of_squares : 1.0;  // a rectangle may be turned over
    const double length = 0.5 * (a.norm() + b.norm());
    const Vector3 wanted_a = share * square_a + (1.0 - share) * length * a.normalized();
    const Vector3 wanted_b = share * square_b + (1.0 - share) * length * b.normalized();
    return {centre + wanted_a, centre + wanted_b, centre - wanted_a, centre - wanted_b};
}

// The best equilateral triangle.
std::array<Vector3, 3> regular_near(const std::array<Vector3, 3>& p, const Vector3& n) {
    const Vector3 centre = (p[0] + p[1] + p[2]) / 3.0;
    const auto turned = [&n](const Vector3& v, int thirds) {
        const double angle = thirds * 120.0 * degree;
        return Vector3(std::cos(angle) * v + std::sin(angle) * n.cross(v));
    };
    Vector3 mean = Vector3::Zero();
    for (int k = 0; k < 3; ++k) mean += turned(p[k] - centre, -k) / 3.0;
    return {centre + mean, centre + turned(mean, 1), centre + turned(mean, 2)};
}

}  // namespace

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

// Moves vertices of quads with unfit angles to where the sum of the fourth powers of the angles' errors is less.
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

Points SquareSteps::wanted(const Points& points, const Points& normals) {
    Points sum = Points::Zero(3, points.cols());
    VectorX count = VectorX::Zero(points.cols());
    const auto add = [&](const auto& face, const auto& places) {
        for (std::size_t k = 0; k < face.size(); ++k) {
            sum.col(face[k]) += places[k];
            count[face[k]] += 1.0;
        }
    };
    for (const auto& quad : pattern_.quads) {
        const std::array<Vector3, 4> p{points.col(quad[0]), points.col(quad[1]), points.col(quad[2]),
                                       points.col(quad[3])};
        add(quad, square_near(p, normal_at(quad, normals)));
    }
    for (const auto& triangle : pattern_.triangles) {
        const std::array<Vector3, 3> p{points.col(triangle[0]), points.col(triangle[1]), points.col(triangle[2])};
        add(triangle, regular_near(p, normal_at(triangle, normals)));
    }
    Points result = points;
    for (Eigen::Index v = pattern_.boundary_count; v < points.cols(); ++v) result.col(v) = sum.col(v) / count[v];
    if (last_.cols() == points.cols())
        result.rightCols(points.cols() - pattern_.boundary_count) +=
            momentum * (points - last_).rightCols(points.cols() - pattern_.boundary_count);
    last_ = points;
    return result;
}

double angle_of_corner(const Vector3& last, const Vector3& here, const Vector3& next, const Vector3& normal) {
    const Vector3 ahead = next - here;
    const Vector3 back = last - here;
    const double angle = degrees_between(ahead, back);
    return ahead.cross(back).dot(normal) < 0.0 ? 360.0 - angle : angle;
}

double angle_error(double angle) { return (angle - 90.0) / 45.0; }

QuadShapes shapes_of(const QuadPattern& pattern, const Points& points, const Points& normals, double length) {
    QuadShapes result;
    for (const auto& quad : pattern.quads) {
        const Vector3 n = normal_at(quad, normals);
        double widest = 0.0;
        for (int k = 0; k < 4; ++k) {
            const Vector3 here = points.col(quad[k]);
            const Vector3 next = points.col(quad[(k + 1) % 4]);
            const double angle = angle_of_corner(points.col(quad[(k + 3) % 4]), here, next, n);
            const double size = std::log(std::max((next - here).norm(), 1e-9 * length) / length);
            result.angle_error += angle_error(angle) * angle_error(angle);
            result.size_error += size * size;
            if (is_unfit(angle)) result.unfit += 1.0;
            widest = std::max(widest, angle);
        }
        result.widest = std::max(result.widest, widest);
        if (widest > most_wide) result.concave += 1.0;
    }
    const double count = static_cast<double>(std::max<std::size_t>(1, pattern.quads.size()));
    result.angle_error /= 4.0 * count;
    result.size_error /= 4.0 * count;
    result.unfit /= 4.0 * count;
    result.concave /= count;
    return result;
}

}  // namespace fairing
