// A mesh put together from parts.
#pragma once

#include "base/columns.h"

namespace fairing {

// Triangles and vertices of all parts, the old vertices' numbers first.
class Assembly {
public:
    explicit Assembly(int old_count) : old_count_(old_count) {}

    // `to_input`: mesh numbers of the local vertices after `free_points`, which are new.
    void add(const Triangles& triangles, const Points& free_points, std::span<const int> to_input) {
        const int first = old_count_ + static_cast<int>(points_.size());
        const int free_count = static_cast<int>(free_points.cols());
        for (int v = 0; v < free_count; ++v) points_.emplace_back(free_points.col(v));
        for (const auto corners : triangles.colwise()) {
            Eigen::Vector3i& added = triangles_.emplace_back();
            for (int k = 0; k < 3; ++k)
                added[k] = corners[k] < free_count ? first + corners[k] : to_input[corners[k] - free_count];
        }
    }
    void keep(const Eigen::Vector3i& triangle) { triangles_.push_back(triangle); }

    [[nodiscard]] Points points() const { return as_columns(points_); }
    [[nodiscard]] Triangles triangles() const { return as_columns(triangles_); }

private:
    int old_count_;
    std::vector<Vector3> points_;
    std::vector<Eigen::Vector3i> triangles_;
};

}  // namespace fairing
