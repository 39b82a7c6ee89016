#include "fairness/ring_weights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "base/progress.h"
#include "geometry/angle.h"
#include "geometry/cotangent.h"

namespace fairing {

namespace {

// A spoke shorter than this part of the longest one counts as that long: a finite weight in any ring.
constexpr double shortest_spoke = 1e-9;

void normalise_or_uniform(std::vector<double>& weights) {
    double sum = 0.0;
    for (double w : weights) sum += w;
    if (!(sum > 0.0) || !std::isfinite(sum)) return uniform_ring_weights(weights.size(), weights);
    for (double& w : weights) w /= sum;
}

// The ring in the plane around the origin: lengths kept, angles scaled to 2π.
std::vector<Eigen::Vector2d> lay_out(const OneRing& ring) {
    const std::size_t m = ring.points.size();
    std::vector<double> turn(m + 1, 0.0);
    for (std::size_t k = 0; k < m; ++k) {
        turn[k + 1] = turn[k] + radians_between(ring.points[k] - ring.centre, ring.points[(k + 1) % m] - ring.centre);
    }
    std::vector<Eigen::Vector2d> flat(m);
    for (std::size_t k = 0; k < m; ++k) {
        const double angle = turn[k] * 2.0 * std::numbers::pi / turn[m];
        const double length = (ring.points[k] - ring.centre).norm();
        flat[k] = {length * std::cos(angle), length * std::sin(angle)};
    }
    return flat;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Adds the barycentric coordinates of the origin in the triangle of point k and the edge of the ring opposite to it.
bool add_barycentric(const std::vector<Eigen::Vector2d>& flat, std::size_t k, std::vector<double>& weights) {
    const std::size_t m = flat.size();
    for (std::size_t s = 1; s + 1 < m; ++s) {
        const std::size_t a = (k + s) % m;
        const std::size_t b = (k + s + 1) % m;
        const double wk = cross(flat[a], flat[b]);
        const double wa = cross(flat[b], flat[k]);
        const double wb = cross(flat[k], flat[a]);
        const double sum = wk + wa + wb;
        const double slack = -1e-12 * std::abs(sum);
        if (!(sum > 0.0) || wk < slack || wa < slack || wb < slack) continue;
        weights[k] += std::max(wk, 0.0) / sum;
        weights[a] += std::max(wa, 0.0) / sum;
        weights[b] += std::max(wb, 0.0) / sum;
        return true;
    }
    return false;
}

}  // namespace

void uniform_ring_weights(std::size_t valence, std::vector<double>& result) {
    result.assign(valence, 1.0 / static_cast<double>(std::max<std::size_t>(valence, 1)));
}

void inverse_distance_ring_weights(const OneRing& ring, std::vector<double>& result) {
    result.clear();
    double longest = 0.0;
    for (const Vector3& p : ring.points) {
        result.push_back((p - ring.centre).norm());
        longest = std::max(longest, result.back());
    }
    for (double& w : result) w = 1.0 / std::max(w, shortest_spoke * longest);
    normalise_or_uniform(result);
}

void conformal_ring_weights(const OneRing& ring, std::vector<double>& result) {
    const std::size_t m = ring.points.size();
    result.assign(m, 0.0);
    for (std::size_t k = 0; k < m; ++k) {
        const Vector3& a = ring.points[k];
        const Vector3& b = ring.points[(k + 1) % m];
        result[(k + 1) % m] += cotangent(ring.centre - a, b - a);
        result[k] += cotangent(ring.centre - b, a - b);
    }
    for (double& w : result) w = std::max(w, 0.0);
    normalise_or_uniform(result);
}

void shape_preserving_ring_weights(const OneRing& ring, std::vector<double>& result) {
    const std::vector<Eigen::Vector2d> flat = lay_out(ring);
    result.assign(ring.points.size(), 0.0);
    for (std::size_t k = 0; k < flat.size(); ++k) {
        if (k % 64 == 63) checkpoint();  // of large rings: each search passes along all of it
        if (!flat[k].allFinite()) return uniform_ring_weights(flat.size(), result);
        add_barycentric(flat, k, result);
    }
    normalise_or_uniform(result);
}

void ring_weights(const OneRing& ring, InnerFairness kind, std::vector<double>& result) {
    switch (kind) {
        case InnerFairness::inverse_distance: return inverse_distance_ring_weights(ring, result);
        case InnerFairness::conformal: return conformal_ring_weights(ring, result);
        case InnerFairness::shape_preserving: return shape_preserving_ring_weights(ring, result);
        case InnerFairness::uniform:
        case InnerFairness::custom: return uniform_ring_weights(ring.points.size(), result);
    }
}

}  // namespace fairing
