#include "fill/short_edges.h"

#include "base/columns.h"

namespace fairing {

namespace {

// Which places of a loop are no heads of short edges.
std::vector<char> staying(const LoopShape& loop) {
    constexpr double is_short = 0.02;  // of the edges around
    constexpr int around = 3;  // edges on either side; their median is an ordinary one even among a few short ones
    const int count = loop.size();
    std::vector<char> stays(static_cast<std::size_t>(count), 1);
    for (int k = 0; k < count; ++k) {
        std::vector<double> near;
        for (int step = -around; step <= around; ++step)
            near.push_back(loop.edge((k + step + around * count) % count).norm());
        if (loop.edge(k).norm() < is_short * median(std::move(near))) stays[(k + 1) % count] = 0;
    }
    if (std::count(stays.begin(), stays.end(), 1) < 3) std::fill(stays.begin(), stays.end(), 1);
    return stays;
}

}  // namespace

void share_normals(BoundaryLoop& loop) {
    const std::vector<char> stays = staying(loop.shape);
    const int count = loop.shape.size();
    const auto first = static_cast<int>(std::find(stays.begin(), stays.end(), 1) - stays.begin());
    Points& normals = loop.shape.normals;
    for (int begin = 0; begin < count;) {
        int end = begin + 1;
        while (end < count && !stays[(first + end) % count]) ++end;
        if (end - begin > 1) {
            Vector3 sum = Vector3::Zero();
            for (int k = begin; k < end; ++k) sum += normals.col((first + k) % count);
            for (int k = begin; k < end; ++k) normals.col((first + k) % count) = direction(sum);
        }
        begin = end;
    }
}

void add_thinned(ThinnedLoops& thinned, const Indices& vertices, const LoopShape& shape) {
    const std::vector<char> stays = staying(shape);
    const int count = shape.size();
    Indices& loop = thinned.loops.emplace_back();
    std::vector<Vector3> normals;
    for (int k = 0; k < count; ++k) {
        if (!stays[k]) continue;
        loop.push_back(vertices[k]);
        normals.emplace_back(shape.normals.col(k));
    }
    thinned.normals.push_back(as_columns(normals));
    const auto first = static_cast<int>(std::find(stays.begin(), stays.end(), 1) - stays.begin());
    for (int k = 1; k < count; ++k) {
        const int place = (first + k) % count;
        if (stays[place]) continue;
        int next = k + 1;
        while (!stays[(first + next) % count]) ++next;
        thinned.left_out.push_back(
            {vertices[(place + count - 1) % count], vertices[place], vertices[(first + next) % count]});
    }
}

Triangles ThinnedLoops::with_all(const Triangles& triangles) const {
    Triangles result(3, triangles.cols() + static_cast<Eigen::Index>(left_out.size()));
    result.leftCols(triangles.cols()) = triangles;
    Eigen::Index count = triangles.cols();
    for (const auto& [before, between, after] : left_out) {
        for (Eigen::Index t = 0; t < count; ++t) {
            int k = 0;
            while (k < 3 && !(result(k, t) == before && result((k + 1) % 3, t) == after)) ++k;
            if (k == 3) continue;
            result.col(count) = Eigen::Vector3i(between, after, result((k + 2) % 3, t));
            result((k + 1) % 3, t) = between;
            break;
        }
        ++count;
    }
    return result;
}

}  // namespace fairing
