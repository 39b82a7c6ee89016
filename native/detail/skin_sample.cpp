#include "detail/skin_sample.h"

#include <limits>
#include <numeric>

#include "base/direction.h"
#include "detail/low_pass.h"
#include "detail/skin.h"
#include "geometry/averages.h"
#include "geometry/neighbourhood.h"

namespace fairing {

namespace {

// Along edges, with a correction: from each vertex of the edge straight to those that it is handed on to.
VectorX distances_from_edge(const Points& points, const Triangles& triangles, const Indices& edge) {
    const VertexAdjacency around(triangles, static_cast<int>(points.cols()));
    VectorX distance = VectorX::Constant(points.cols(), std::numeric_limits<double>::infinity());
    Indices source(static_cast<int>(points.cols()), none);
    Indices queue = edge;
    for (int v : edge) {
        distance[v] = 0.0;
        source[v] = v;
    }
    for (std::size_t k = 0; k < queue.size(); ++k) {
        const int v = queue[k];
        for (int j = around.begin[v]; j < around.begin[v + 1]; ++j) {
            const int other = around.neighbours[j];
            const double straight = (points.col(other) - points.col(source[v])).norm();
            if (!(straight < distance[other])) continue;
            distance[other] = straight;
            source[other] = source[v];
            queue.push_back(other);
        }
    }
    return distance;
}

}  // namespace

std::optional<SkinSample> sample_of(const Patch& patch, const Points& points, double wavelength,
                                    const Progress& progress) {
    Indices edge(patch.vertex_count() - patch.free_count);
    std::iota(edge.begin(), edge.end(), patch.free_count);
    const Points outline = low_pass(points, patch.triangles, edge, wavelength).points;
    const auto skin = Skin::read(patch, {points, outline}, wavelength, progress);
    if (!skin) return std::nullopt;
    SkinSample sample;
    sample.base = skin->base();
    sample.triangles = patch.triangles;
    sample.normals = summed_normals(sample.base, patch.triangles);
    for (auto normal : sample.normals.colwise()) normal = direction(normal);
    sample.heights = (points - sample.base).cwiseProduct(sample.normals).colwise().sum().transpose();
    sample.depth = distances_from_edge(sample.base, patch.triangles, edge);
    sample.edge = mean_edge(patch, sample.base);
    return sample;
}

}  // namespace fairing
