#include "start/protrusions.h"

#include <algorithm>
#include <map>
#include <numbers>

#include "mesh/corners.h"
#include "mesh/union_find.h"
#include "operators/laplace_operator.h"
#include "start/clamped_fill.h"
#include "start/level_lines.h"

namespace fairing {

namespace {

constexpr int level_count = 24;
constexpr std::size_t least_triangles = 12;  // of a cap; fewer are no shape

// The torsion function at all vertices.
std::optional<VectorX> torsion(const Patch& patch, const Progress& progress) {
    LaplaceOperator laplace(patch);
    if (!laplace.update(uniform_stiffness(patch), progress)) return std::nullopt;
    VectorX values = VectorX::Zero(patch.vertex_count());
    values.head(patch.free_count) = laplace.solve(Eigen::MatrixXd::Ones(patch.free_count, 1));
    return values;
}

// Levels with as many free vertices between one and the next; just below theirs, so that equal ones stay together.
std::vector<double> even_levels(const Patch& patch, const VectorX& values) {
    std::vector<double> sorted(values.begin(), values.begin() + patch.free_count);
    std::sort(sorted.begin(), sorted.end());
    std::vector<double> levels;
    for (int k = 1; k <= level_count; ++k)
        levels.push_back((1.0 - 1e-9) * sorted[sorted.size() * static_cast<std::size_t>(k) / (level_count + 1)]);
    return levels;
}

// Connected sets of the triangles that reach a level.
std::vector<Indices> pieces_beyond(const Patch& patch, const VectorX& values, double level) {
    const auto reaches = [&](int t) { return t != none && values(patch.triangles.col(t)).maxCoeff() >= level; };
    UnionFind pieces(patch.triangle_count());
    for (const auto& [a, b] : patch.edge_triangles) {
        if (reaches(a) && reaches(b)) pieces.join(a, b);
    }
    std::map<int, Indices> found;
    for (int t = 0; t < patch.triangle_count(); ++t) {
        if (reaches(t)) found[pieces.root(t)].push_back(t);
    }
    std::vector<Indices> result;
    result.reserve(found.size());
    for (auto& [root, triangles] : found) result.push_back(std::move(triangles));
    return result;
}

// By Euler's characteristic.
bool is_disc(const Patch& patch, const Indices& triangles) {
    return corners_of(patch, triangles).size() + triangles.size() == edges_of(patch, triangles).size() + 1;
}

}  // namespace

std::optional<Protrusions> Protrusions::of(const Patch& patch, const Progress& progress) {
    auto levels = torsion(patch, progress);
    if (!levels) return std::nullopt;
    Protrusions result(patch);
    result.levels_ = std::move(*levels);
    for (const double level : even_levels(patch, result.levels_)) result.append_caps(level);
    return result;
}

void Protrusions::append_caps(double level) {
    for (Indices& piece : pieces_beyond(patch_, levels_, level)) {
        if (piece.size() >= least_triangles && is_disc(patch_, piece)) caps_.push_back({std::move(piece), level});
    }
}

Protrusions::Size Protrusions::size_of(const Cap& cap, const Points& points) const {
    Size size;
    Vector3 moment = Vector3::Zero();
    for (const int t : cap.triangles) {
        const LevelPiece piece = level_within(patch_.triangles.col(t), levels_, cap.level, points);
        size.rim += piece.length;
        moment += piece.length * piece.middle;
    }
    if (!(size.rim > 0.0)) return size;
    for (const int t : cap.triangles) {
        for (const int v : patch_.triangles.col(t)) {
            if (levels_[v] < cap.level) continue;
            size.reach = std::max(size.reach, (points.col(v) - moment / size.rim).norm());
        }
    }
    return size;
}

VectorX Protrusions::reaches(const Points& points) const {
    VectorX result(count());
    for (int k = 0; k < count(); ++k) result[k] = size_of(caps_[k], points).reach;
    return result;
}

VectorX Protrusions::bluntness(const Points& points) const {
    VectorX result = VectorX::Zero(count());
    for (int k = 0; k < count(); ++k) {
        const Size size = size_of(caps_[k], points);
        if (size.reach > 0.0) result[k] = size.rim / (2.0 * std::numbers::pi * size.reach);
    }
    return result;
}

}  // namespace fairing
