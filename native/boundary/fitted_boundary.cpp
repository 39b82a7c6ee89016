#include "boundary/fitted_boundary.h"

#include <Eigen/Geometry>

#include "base/columns.h"
#include "geometry/triangle.h"

namespace fairing {

namespace {

constexpr double least_noise = 0.02;  // edges
constexpr double farthest = 0.25;     // edges
constexpr int rings_outside = 2;      // move by part of the distance

// How much of the distance each vertex goes: 1 on the boundary, ⅔ and ⅓ on the rings outside, 0 beyond.
VectorX shares(const Triangles& triangles, const Indices& boundary, Eigen::Index count) {
    VectorX share = VectorX::Zero(count);
    share(boundary).setOnes();
    for (int ring = 1; ring <= rings_outside; ++ring) {
        const VectorX before = share;
        const double here = 1.0 - ring / (rings_outside + 1.0);
        for (const auto t : triangles.colwise()) {
            if (!(before(t).maxCoeff() > 0.0)) continue;
            for (int v : t) {
                if (before[v] == 0.0) share[v] = here;
            }
        }
    }
    return share;
}

double noise_of(const SurroundingFit& fit) {
    std::vector<double> scatters;
    for (std::size_t k = 0; k < fit.fits.size(); ++k) {
        const double length = fit.lengths[static_cast<Eigen::Index>(k)];
        if (fit.fits[k] && length > 0.0) scatters.push_back(fit.fits[k]->scatter / length);
    }
    return median(std::move(scatters));
}

// The moves of the vertices with a share, 3 × n, in the caller's units.
Points moves(const Points& points, const Triangles& triangles, const VectorX& share) {
    Indices moving;
    for (int v = 0; v < share.size(); ++v) {
        if (share[v] > 0.0) moving.push_back(v);
    }
    const SurroundingFit fit = fit_surroundings(points, triangles, moving);
    Points result = Points::Zero(3, points.cols());
    for (std::size_t k = 0; k < moving.size(); ++k) {
        if (!fit.fits[k] || fit.parted[k]) continue;  // hard edges stay
        const double bound = farthest * fit.lengths[static_cast<Eigen::Index>(k)];
        const double height = std::clamp(fit.fits[k]->height, -bound, bound);
        result.col(moving[k]) = share[moving[k]] * fit.size * height * fit.fits[k]->normal;
    }
    return result;
}

Vector3 face_normal(const Points& points, const Eigen::Vector3i& t) { return direction(area_vector(points, t)); }

// Takes back the moves at triangles that turn by more than 90°, until there are none. Returns the vertices.
Indices hold_folds(const Points& points, const Triangles& triangles, Points& move) {
    Indices held;
    for (bool folded = true; folded;) {
        folded = false;
        const Points moved = points + move;
        for (const auto t : triangles.colwise()) {
            const bool moves = std::any_of(t.begin(), t.end(), [&](int v) { return !move.col(v).isZero(0.0); });
            if (!moves || face_normal(moved, t).dot(face_normal(points, t)) >= 0.0) continue;
            for (int v : t) {
                if (move.col(v).isZero(0.0)) continue;
                move.col(v).setZero();
                held.push_back(v);
            }
            folded = true;
        }
    }
    std::sort(held.begin(), held.end());
    held.erase(std::unique(held.begin(), held.end()), held.end());
    return held;
}

constexpr double least_error = 0.15;    // radians
constexpr double least_height = 0.3;    // edges
constexpr double times_median = 4.0;    // the median is what is usual here
constexpr double largest_share = 0.15;  // of the boundary

// For places with triangles: standard errors and heights over the fit, in edges; infinite without a fit.
struct Doubts {
    Indices places;
    std::vector<double> errors;
    std::vector<double> heights;
};

Doubts doubts_of(const SurroundingFit& fit) {
    Doubts result;
    for (std::size_t k = 0; k < fit.fits.size(); ++k) {
        const double length = fit.lengths[static_cast<Eigen::Index>(k)];
        if (!(length > 0.0)) continue;
        result.places.push_back(static_cast<int>(k));
        result.errors.push_back(fit.fits[k] ? fit.fits[k]->error : HUGE_VAL);
        result.heights.push_back(fit.fits[k] ? std::abs(fit.fits[k]->height) / length : HUGE_VAL);
    }
    return result;
}

}  // namespace

FittedBoundary fitted_boundary(const Points& points, const Triangles& triangles, const Indices& boundary) {
    const SurroundingFit fit = fit_surroundings(points, triangles, boundary);
    FittedBoundary result{points, {}, {}, noise_of(fit), normals_of(fit)};
    if (result.noise < least_noise) return result;
    Points move = moves(points, triangles, shares(triangles, boundary, points.cols()));
    result.held = hold_folds(points, triangles, move);
    for (int v = 0; v < move.cols(); ++v) {
        if (move.col(v).isZero(0.0)) continue;
        result.vertices.col(v) += move.col(v);
        result.moved.push_back(v);
    }
    return result;
}

Indices bad_vertices(const SurroundingFit& fit) {
    const Doubts doubts = doubts_of(fit);
    const double error_bound = std::max(least_error, times_median * median(doubts.errors));
    const double height_bound = std::max(least_height, times_median * median(doubts.heights));
    std::vector<std::pair<double, int>> bad;  // by how much, negative, so that the worst come first
    for (std::size_t k = 0; k < doubts.places.size(); ++k) {
        const double excess = std::max(doubts.errors[k] / error_bound, doubts.heights[k] / height_bound);
        if (excess > 1.0) bad.emplace_back(-excess, doubts.places[k]);
    }
    std::sort(bad.begin(), bad.end());
    const auto most = static_cast<std::size_t>(std::ceil(largest_share * static_cast<double>(doubts.places.size())));
    bad.resize(std::min(bad.size(), most));
    Indices places;
    for (const auto& [excess, place] : bad) places.push_back(place);
    std::sort(places.begin(), places.end());
    return places;
}

}  // namespace fairing
