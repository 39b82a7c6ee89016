#include "detail/copied_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Geometry>

#include "base/progress.h"
#include "detail/disc.h"
#include "geometry/frame.h"
#include "geometry/neighbourhood.h"

namespace fairing {

namespace {

constexpr double between_discs = 0.6;              // of their radius; beyond that much of it a disc fades out
constexpr int tried_discs = 12;                    // of the sample, for each disc of the surface
constexpr std::size_t compared_vertices = 64;      // of a disc
constexpr double wider = 1.25;                     // a disc of the sample than one of the surface
constexpr std::mt19937_64::result_type seed = 23;  // any: the same input gives the same bits

// Middles of discs that cover the surface, from what is known inwards.
Indices middles(const BareSurface& surface, const VertexAdjacency& around, double distance) {
    Indices order;
    std::vector<char> met(static_cast<int>(surface.points.cols()), 0);
    const auto meet = [&](int v) {
        if (met[v]) return;
        met[v] = 1;
        order.push_back(v);
    };
    const auto spread = [&](std::size_t begin) {
        for (std::size_t k = begin; k < order.size(); ++k) {
            for (int j = around.begin[order[k]]; j < around.begin[order[k] + 1]; ++j) meet(around.neighbours[j]);
        }
    };
    for (int v = 0; v < static_cast<int>(surface.known.size()); ++v) {
        if (!std::isnan(surface.known[v])) meet(v);
    }
    spread(0);
    for (int v : surface.triangles.reshaped()) {
        const std::size_t begin = order.size();
        meet(v);
        spread(begin);
    }
    BallWalk walk(around, surface.points);
    std::vector<char> covered(met.size(), 0);
    Indices result;
    for (int v : order) {
        if (covered[v]) continue;
        result.push_back(v);
        for (int near : walk.gather(v, distance)) covered[near] = 1;
    }
    return result;
}

// A disc of the surface, with what is known of its heights.
struct Place {
    int middle;
    Indices vertices;
    Points offsets;   // in the tangent plane of the middle, as long as the straight distances
    VectorX weights;  // of the blend
    VectorX known;    // NaN: nothing
};

class Copying {
public:
    Copying(const BareSurface& surface, const SkinSample& sample, double reach)
        : surface_(surface),
          sample_(sample),
          reach_(reach),
          around_(surface.triangles, static_cast<int>(surface.points.cols())),
          walk_(around_, surface.points),
          discs_(sample.base, sample.normals, sample.triangles),
          heights_(VectorX::Zero(surface.points.cols())),
          covered_(VectorX::Zero(surface.points.cols())) {
        for (int v = 0; v < static_cast<int>(sample.depth.size()); ++v) {
            if (sample.depth[v] >= reach) centres_.push_back(v);
        }
    }

    VectorX run() && {
        for (int middle : middles(surface_, around_, between_discs * reach_)) {
            checkpoint();
            const Place place = place_at(middle);
            lay(place, best_heights(place));
        }
        return std::move(heights_);
    }

private:
    Place place_at(int middle) {
        Place place{middle, walk_.gather(middle, reach_), {}, {}, {}};
        const auto count = static_cast<Eigen::Index>(place.vertices.size());
        place.offsets = tangent_offsets(surface_.points, surface_.normals.col(middle), place.vertices);
        const VectorX shares = place.offsets.colwise().norm().transpose() / reach_;
        const Eigen::ArrayXd fall = ((1.0 - shares.array()) / (1.0 - between_discs)).max(0.0).min(1.0);
        place.weights = fall.square() * (3.0 - 2.0 * fall);
        place.known.resize(count);
        for (Eigen::Index k = 0; k < count; ++k) {
            const int v = place.vertices[static_cast<std::size_t>(k)];
            const double laid = covered_[v] > 0.0 ? heights_[v] : NAN;
            place.known[k] = std::isnan(surface_.known[v]) ? laid : surface_.known[v];
        }
        return place;
    }

    VectorX best_heights(const Place& place) {
        Indices compared;
        const std::size_t step = 1 + place.vertices.size() / compared_vertices;
        for (std::size_t k = 0; k < place.vertices.size(); k += step) {
            if (!std::isnan(place.known[static_cast<Eigen::Index>(k)])) compared.push_back(static_cast<int>(k));
        }
        double least = std::numeric_limits<double>::infinity();
        int best = none;
        for (int k = 0; k < (compared.empty() ? 1 : tried_discs); ++k) {
            const int centre = centres_[random_() % centres_.size()];
            discs_.cut(centre, wider * reach_);
            double misfit = 0.0;
            for (int j : compared) {
                const int there = discs_.nearest(turned(place, j, centre));
                misfit += place.weights[j] * std::pow(sample_.heights[there] - place.known[j], 2);
            }
            if (misfit < least) {
                least = misfit;
                best = centre;
            }
        }
        discs_.cut(best, wider * reach_);
        VectorX heights(place.known.size());
        for (int j = 0; j < static_cast<int>(heights.size()); ++j)
            heights[j] = discs_.value(sample_.heights, turned(place, j, best));
        return heights;
    }

    [[nodiscard]] Vector3 turned(const Place& place, int k, int centre) const {
        const Vector3 from = surface_.normals.col(place.middle);
        const Vector3 to = sample_.normals.col(centre);
        return Eigen::Quaterniond::FromTwoVectors(from, to) * Vector3(place.offsets.col(k));
    }

    void lay(const Place& place, const VectorX& heights) {
        const double alike = correlation(place, heights);
        for (std::size_t k = 0; k < place.vertices.size(); ++k) {
            const auto row = static_cast<Eigen::Index>(k);
            const int v = place.vertices[k];
            const double left = place.weights[row] * (1.0 - covered_[v]);
            if (!(left > 0.0)) continue;
            covered_[v] += left;
            const double part = left / covered_[v];
            const double variance = 1.0 - 2.0 * part * (1.0 - part) * (1.0 - alike);
            heights_[v] = ((1.0 - part) * heights_[v] + part * heights[row]) / std::sqrt(variance);
        }
    }

    // Of a disc with what lies there already, 0 … 1.
    [[nodiscard]] double correlation(const Place& place, const VectorX& heights) const {
        double product = 0.0;
        double laid = 0.0;
        double added = 0.0;
        for (std::size_t k = 0; k < place.vertices.size(); ++k) {
            const auto row = static_cast<Eigen::Index>(k);
            const int v = place.vertices[k];
            const double weight = place.weights[row] * covered_[v];
            product += weight * heights_[v] * heights[row];
            laid += weight * heights_[v] * heights_[v];
            added += weight * heights[row] * heights[row];
        }
        return laid > 0.0 && added > 0.0 ? std::clamp(product / std::sqrt(laid * added), 0.0, 1.0) : 0.0;
    }

    const BareSurface& surface_;
    const SkinSample& sample_;
    double reach_;
    VertexAdjacency around_;
    BallWalk walk_;
    Discs discs_;
    VectorX heights_;
    VectorX covered_;  // by the discs laid so far, 0 … 1
    Indices centres_;
    std::mt19937_64 random_{seed};  // NOLINT(bugprone-random-generator-seed): the same input gives the same bits
};

}  // namespace

VectorX copied_heights(const BareSurface& surface, const SkinSample& sample, double reach) {
    return Copying(surface, sample, reach).run();
}

}  // namespace fairing
