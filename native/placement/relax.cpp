#include "placement/relax.h"

#include "base/limits.h"
#include "linear/anderson.h"
#include "linear/limits.h"
#include "linear/sparse_cholesky.h"
#include "problem/surface_state.h"

namespace fairing {

namespace {

constexpr double done = 1e-7;  // units of D

class Relaxation {
public:
    Relaxation(const TangentialStep& tangential, const TargetSurface& target, Placement& placement)
        : tangential_(tangential),
          target_(target),
          placement_(placement),
          merit_(tangential.merit(placement.points)),
          anderson_(history_depth) {}

    void run() {
        for (int step = 0; step < most_iterations; ++step) {
            const Points d = tangential_.displacement(placement_.points, normals_at(placement_, target_));
            const double largest = largest_length(d);
            if (largest < done || !improve(d, largest)) break;
        }
    }

private:
    // Where the surface is curved, plain steps are too short by the same share each time: acceleration learns it.
    bool improve(const Points& d, double largest) {
        const auto as_vector = [](const auto& points) { return VectorX(points.reshaped()); };
        const VectorX far = anderson_.step(as_vector(placement_.points.leftCols(d.cols())), as_vector(d));
        Points move = Eigen::Map<const Points>(far.data(), 3, d.cols());
        if (accepts(move * std::min(1.0, longest_step / largest_length(move)))) return true;
        double length = std::min(1.0, longest_step / largest);
        for (int halving = 0; halving < most_halvings; ++halving, length *= 0.5) {
            if (accepts(length * d)) return true;
        }
        return false;
    }

    bool accepts(const Points& move) {
        Placement trial = moved(placement_, target_, move);
        const double reached = tangential_.merit(trial.points);
        if (!(reached < merit_)) return false;
        merit_ = reached;
        placement_ = std::move(trial);
        return true;
    }

    const TangentialStep& tangential_;
    const TargetSurface& target_;
    Placement& placement_;
    double merit_;
    Anderson anderson_;
};

using Triplets = std::vector<Eigen::Triplet<double>>;

// The free vertices near the triangles.
Indices unknowns_near(const Patch& patch, const Indices& triangles, int rings) {
    std::vector<char> near(patch.vertex_count(), 0);
    for (const int t : triangles) {
        for (const int v : patch.triangles.col(t)) near[v] = 1;
    }
    for (int k = 0; k < rings; ++k) {
        const std::vector<char> before = near;
        for (int v = 0; v < patch.vertex_count(); ++v) {
            if (!before[v]) continue;
            for (const int w : patch.ring(v).vertices) near[w] = 1;
        }
    }
    Indices unknowns;
    for (int v = 0; v < patch.free_count; ++v) {
        if (near[v]) unknowns.push_back(v);
    }
    return unknowns;
}

}  // namespace

void relax(const TangentialStep& tangential, const TargetSurface& target, Placement& placement) {
    Relaxation(tangential, target, placement).run();
}

Points refilled(const Patch& patch, const Points& points, const Indices& triangles, int rings) {
    const Indices unknowns = unknowns_near(patch, triangles, rings);
    if (unknowns.empty()) return points;
    Indices number(patch.vertex_count(), none);
    for (std::size_t k = 0; k < unknowns.size(); ++k) number[unknowns[k]] = static_cast<int>(k);
    Triplets entries;
    Eigen::MatrixXd known = Eigen::MatrixXd::Zero(patch.vertex_count(), 3);
    const auto add = [&](int row, int vertex, double value) {
        if (number[vertex] != none)
            entries.emplace_back(row, number[vertex], value);
        else
            known.row(row) += value * points.col(vertex).transpose();
    };
    for (int v = 0; v < patch.vertex_count(); ++v) {
        const auto& ring = patch.ring(v).vertices;
        add(v, v, static_cast<double>(ring.size()));
        for (const int w : ring) add(v, w, -1.0);
    }
    SparseMatrix umbrellas(patch.vertex_count(), static_cast<Eigen::Index>(unknowns.size()));
    umbrellas.setFromTriplets(entries.begin(), entries.end());
    const SparseMatrix normal = umbrellas.transpose() * umbrellas;
    SparseCholesky factor(points(Eigen::all, unknowns));
    if (!factor.factorise(normal.triangularView<Eigen::Lower>(), "placement", Progress())) return points;
    Points result = points;
    result(Eigen::all, unknowns) = factor.solve(-umbrellas.transpose() * known).transpose();
    return result;
}

}  // namespace fairing
