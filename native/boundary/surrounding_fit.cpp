#include "boundary/surrounding_fit.h"

#include <algorithm>
#include <limits>

#include "base/progress.h"
#include "boundary/normal_filter.h"
#include "boundary/sided_fits.h"

namespace fairing {

namespace {

// The first place of each vertex in the list, `none` elsewhere.
Indices first_places(const Indices& vertices, Eigen::Index count) {
    Indices place(static_cast<std::size_t>(count), none);
    for (std::size_t k = vertices.size(); k-- > 0;) place[vertices[k]] = static_cast<int>(k);
    return place;
}

OutlineEdges border_edges(const Triangles& triangles, const Indices& place) {
    OutlineEdges sides;
    for (const auto t : triangles.colwise()) {
        for (int k = 0; k < 3; ++k) {
            const int a = place[t[k]];
            const int b = place[t[(k + 1) % 3]];
            if (a != none && b != none && a != b) sides.push_back({std::min(a, b), std::max(a, b)});
        }
    }
    std::sort(sides.begin(), sides.end());
    OutlineEdges border;
    for (auto first = sides.begin(); first != sides.end();) {
        const auto last = std::upper_bound(first, sides.end(), *first);
        if (last - first == 1) border.push_back(*first);
        first = last;
    }
    return border;
}

// A two-sided edge counts twice.
VectorX edge_lengths(const Points& points, const Triangles& triangles, const Indices& vertices) {
    VectorX sum = VectorX::Zero(points.cols());
    VectorX count = VectorX::Zero(points.cols());
    for (const auto t : triangles.colwise()) {
        for (int k = 0; k < 3; ++k) {
            const double length = (points.col(t[k]) - points.col(t[(k + 1) % 3])).norm();
            for (int v : {t[k], t[(k + 1) % 3]}) {
                sum[v] += length;
                count[v] += 1.0;
            }
        }
    }
    return sum.cwiseQuotient(count.cwiseMax(1.0))(vertices);
}

}  // namespace

SurroundingFit blank_fit(const Points& points, const Triangles& triangles, const Indices& vertices, double size) {
    const Indices place = first_places(vertices, points.cols());
    SurroundingFit result{{},
                          points(Eigen::all, vertices),
                          Points(3, static_cast<Eigen::Index>(vertices.size())),
                          edge_lengths(points, triangles, vertices),
                          {},
                          border_edges(triangles, place),
                          size};
    for (const int v : vertices) result.first.push_back(place[v]);
    return result;
}

SurroundingFit fit_surroundings(const Points& given, const Triangles& triangles, const Indices& vertices,
                                const VertexPairs& creases) {
    const auto [points, size] = to_unit_size(given, triangles);
    SidedFits fits(points, triangles, vertices, creases);
    SurroundingFit result = blank_fit(points, triangles, vertices, size);
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        checkpoint();
        result.fits.push_back(fits.at_vertex(vertices[k]));
        result.averaged.col(static_cast<Eigen::Index>(k)) = fits.averaged(vertices[k]);
    }
    return result;
}

SurroundingNormals normals_of(const SurroundingFit& fit) {
    const auto count = static_cast<Eigen::Index>(fit.fits.size());
    SurroundingNormals result{filtered_normals(fit), std::vector<char>(fit.fits.size(), 0),
                              VectorX::Constant(count, std::numeric_limits<double>::infinity()),
                              VectorX::Constant(count, std::numeric_limits<double>::quiet_NaN()),
                              VectorX::Constant(count, std::numeric_limits<double>::infinity())};
    for (Eigen::Index k = 0; k < count; ++k) {
        const auto& here = fit.fits[static_cast<int>(k)];
        if (!here) continue;
        result.fitted[static_cast<int>(k)] = 1;
        result.errors[k] = here->error;
        result.curvatures[k] = here->mean_curvature / fit.size;
        result.curvature_errors[k] = here->curvature_error / fit.size;
    }
    return result;
}

SurroundingNormals surrounding_normals(const Points& points, const Triangles& triangles, const Indices& vertices,
                                       const VertexPairs& creases) {
    return normals_of(fit_surroundings(points, triangles, vertices, creases));
}

}  // namespace fairing
