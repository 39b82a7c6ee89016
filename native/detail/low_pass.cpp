#include "detail/low_pass.h"

#include <Eigen/Geometry>

#include "base/columns.h"
#include "base/errors.h"
#include "geometry/face_geometry.h"
#include "geometry/limits.h"
#include "geometry/neighbourhood.h"
#include "geometry/surface_fit.h"
#include "operators/bending.h"

namespace fairing {

namespace {

constexpr std::array<double, 4> reaches = {0.5, 0.8, 1.25, 2.0};  // wavelengths
constexpr double spacing = 0.35;                                  // of fits, and the width of means: wavelengths
constexpr double farthest_mean = 3.0;                             // of that spacing
constexpr double contradiction = 4.0;                             // standard errors

// The vertices that a walk within a ball reaches, nearest first.
class Ball {
public:
    Ball(const Points& points, const Triangles& triangles)
        : points_(points),
          normals_(summed_normals(points, triangles)),
          around_(triangles, static_cast<int>(points.cols())),
          walk_(around_, points_) {}

    void gather(int centre, double radius) {
        std::vector<std::pair<double, int>> order;
        for (int v : walk_.gather(centre, radius)) order.emplace_back(distance(centre, v), v);
        std::sort(order.begin(), order.end());
        near_.clear();
        distances_.clear();
        sums_.assign(1, normals_.col(centre));
        for (std::size_t k = 1; k < order.size(); ++k) {
            near_.emplace_back(points_.col(order[k].second));
            distances_.push_back(order[k].first);
            sums_.emplace_back(sums_.back() + normals_.col(order[k].second));
        }
    }

    [[nodiscard]] std::span<const Vector3> within(double radius) const { return std::span(near_).first(count(radius)); }
    [[nodiscard]] Vector3 mean_normal(double radius) const { return direction(sums_[count(radius)]); }
    // Whether the centre lies on the side that most of it shows.
    [[nodiscard]] bool is_flat(double radius) const {
        return mean_normal(radius).dot(direction(sums_.front())) > cos_of_widest_turn;
    }

private:
    [[nodiscard]] double distance(int a, int b) const { return (points_.col(a) - points_.col(b)).norm(); }
    [[nodiscard]] std::size_t count(double radius) const {
        return static_cast<std::size_t>(std::upper_bound(distances_.begin(), distances_.end(), radius) -
                                        distances_.begin());
    }

    const Points& points_;
    Points normals_;
    VertexAdjacency around_;
    BallWalk walk_;
    std::vector<Vector3> near_;
    std::vector<double> distances_;
    std::vector<Vector3> sums_;
};

// Fits of one vertex, the narrow ones first.
using Fits = std::vector<SlopeFit>;

// Whether a quadric of no wider reach says something else: `quadrics` are those.
bool contradicted(const SlopeFit& fit, const Fits& quadrics) {
    return std::any_of(quadrics.begin(), quadrics.end(), [&](const SlopeFit& other) {
        return (other.normal - fit.normal).norm() > contradiction * std::hypot(other.error, fit.error);
    });
}

// A reach with few points is no guide: the narrow fits for noisy boundaries take its place.
std::optional<SlopeFit> best_fit(const Vector3& centre, const Ball& ball, double length,
                                 const std::optional<SlopeFit>& narrow) {
    const Vector3 start = narrow ? narrow->normal : ball.mean_normal(reaches.front() * length);
    Fits quadrics;
    if (narrow) quadrics.push_back(*narrow);
    std::optional<SlopeFit> best = narrow;
    for (const double reach : reaches) {
        const auto points = ball.within(reach * length);
        if (points.size() < points_of_fit) continue;
        for (const Degree degree : {Degree::quadratic, Degree::sphere}) {
            const auto fit = fit_slopes(centre, points, start, degree, Centre::free);
            if (!fit) continue;
            if (!contradicted(*fit, quadrics) && (!best || fit->error < best->error)) best = fit;
            if (degree == Degree::quadratic) quadrics.push_back(*fit);
        }
    }
    return best;
}

struct Anchor {
    Vector3 centre;
    SlopeFit fit;
};

// Vertices of the list that are not near one before them.
Indices spaced(const Points& points, const Indices& vertices, double distance) {
    Indices result;
    for (int v : vertices) {
        const bool near = std::any_of(result.begin(), result.end(),
                                      [&](int w) { return (points.col(v) - points.col(w)).norm() < distance; });
        if (!near) result.push_back(v);
    }
    return result;
}

std::vector<Anchor> anchors_at(const Points& points, const Triangles& triangles, const Indices& vertices,
                               double wavelength) {
    Ball ball(points, triangles);
    SurfaceFits narrow(points, triangles, Centre::free);
    std::vector<Anchor> anchors;
    for (int v : spaced(points, vertices, spacing * wavelength)) {
        checkpoint();
        ball.gather(v, reaches.back() * wavelength);
        const double first = reaches.front() * wavelength;
        const bool crowded = ball.within(first).size() >= points_of_fit && ball.is_flat(first);
        const auto fit =
            best_fit(points.col(v), ball, wavelength, crowded ? std::optional<SlopeFit>() : narrow.at_vertex(v));
        if (fit) anchors.push_back({points.col(v), *fit});
    }
    return anchors;
}

struct Mean {
    Vector3 place;
    Vector3 normal;
};

// The mean of what the fits around a point say there, by certainty and nearness.
std::optional<Mean> mean_at(const Vector3& here, const std::vector<Anchor>& anchors, double width) {
    Mean sum{Vector3::Zero(), Vector3::Zero()};
    double weights = 0.0;
    for (const Anchor& anchor : anchors) {
        const Vector3 offset = here - anchor.centre;
        const double apart = offset.norm() / width;
        if (apart > farthest_mean) continue;
        const double weight = std::exp(-apart * apart) / (std::pow(anchor.fit.error, 2) + least_error * least_error);
        sum.place += weight * (anchor.centre + anchor.fit.foot(offset));
        sum.normal += weight * anchor.fit.normal_at(offset);
        weights += weight;
    }
    if (!(weights > 0.0)) return std::nullopt;
    return Mean{sum.place / weights, direction(sum.normal)};
}

// l⁴. Two passes leave 1 − (q/(1 + q))² of a wave, q = (2π l/wavelength)⁴: all but 1 % at q = 1/9.
double bending_weight(double size) { return std::pow(size / (2.0 * std::numbers::pi), 4) / 9.0; }

}  // namespace

LowPass low_pass(const Points& points, const Triangles& triangles, const Indices& vertices, double wavelength) {
    const std::vector<Anchor> anchors = anchors_at(points, triangles, vertices, wavelength);
    LowPass result{points(Eigen::all, vertices), Points::Zero(3, static_cast<Eigen::Index>(vertices.size())),
                   std::vector<char>(vertices.size(), 0)};
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        const auto mean = mean_at(points.col(vertices[k]), anchors, spacing * wavelength);
        if (!mean) continue;
        result.points.col(static_cast<Eigen::Index>(k)) = mean->place;
        result.normals.col(static_cast<Eigen::Index>(k)) = mean->normal;
        result.found[k] = 1;
    }
    return result;
}

// (K + A) u = −K x, and what the second pass puts back, −(K + A)⁻¹ A u.
Points denoised(const NoisySurface& surface, const VectorX& sizes, const Progress& progress) {
    const Points& points = surface.points;
    Bending bending(points, surface.triangles, surface.fixed, sizes.unaryExpr(&bending_weight));
    const Indices& free = bending.free();
    if (free.empty()) return points;
    if (!bending.factorise(VectorX::Ones(static_cast<Eigen::Index>(free.size())), "denoise", progress))
        throw SolverError("the roughness could not be taken away: the mesh has triangles without area");
    const Points once = bending.solve(-bending.force(points));
    Points result = points;
    result(Eigen::all, free) += once - bending.solve(once * bending.free_areas().asDiagonal());
    return result;
}

}  // namespace fairing
