#include "shape/grain.h"

#include <algorithm>
#include <array>

#include "base/direction.h"
#include "geometry/angle.h"
#include "geometry/averages.h"
#include "geometry/dihedral_bands.h"
#include "mesh/collapsed.h"
#include "mesh/edges.h"
#include "shape/limits.h"

namespace fairing {

namespace {

constexpr int steps = 8;           // of smoothing: what is longer than some six edges is shape
constexpr int mixed_rings = 2;     // from the outline on, where normals know the other side
constexpr std::size_t fewest = 4;  // vertices that say something

using Marks = std::vector<char>;

Marks corners(const Triangles& triangles, Eigen::Index vertex_count) {
    Marks found(static_cast<std::size_t>(vertex_count), 0);
    for (const int v : triangles.reshaped()) found[v] = 1;
    return found;
}

void grow(const EdgeTable& edges, int rings, Marks& marked) {
    for (int ring = 0; ring < rings; ++ring) {
        Marks next = marked;
        for (const auto& [a, b] : edges.ends) {
            if (marked[a]) next[b] = 1;
            if (marked[b]) next[a] = 1;
        }
        marked = std::move(next);
    }
}

// Degrees between each vertex's normal and the mean of those around it.
VectorX deviations(const Points& points, const Triangles& triangles, const EdgeTable& edges) {
    const Points normals = averaged_normals(points, triangles);
    VectorX valence = VectorX::Zero(points.cols());
    for (const auto& [a, b] : edges.ends) {
        valence[a] += 1.0;
        valence[b] += 1.0;
    }
    Points smooth = normals;
    for (int step = 0; step < steps; ++step) {
        Points sums = Points::Zero(3, points.cols());
        for (const auto& [a, b] : edges.ends) {
            sums.col(a) += smooth.col(b);
            sums.col(b) += smooth.col(a);
        }
        smooth = 0.5 * (smooth + sums * valence.cwiseMax(1.0).cwiseInverse().asDiagonal());
    }
    VectorX degrees(points.cols());
    for (Eigen::Index v = 0; v < degrees.size(); ++v) {
        degrees[v] = degrees_between(normals.col(v), Vector3(smooth.col(v)));
    }
    return degrees;
}

struct Quartiles {
    double lower = 0.0;
    double median = 0.0;
    double upper = 0.0;
};

Quartiles quartiles(const VectorX& values, const Marks& where) {
    std::vector<double> chosen;
    for (Eigen::Index v = 0; v < values.size(); ++v) {
        if (where[static_cast<std::size_t>(v)]) chosen.push_back(values[v]);
    }
    std::sort(chosen.begin(), chosen.end());
    return {chosen[chosen.size() / 4], chosen[chosen.size() / 2], chosen[3 * chosen.size() / 4]};
}

struct Parts {
    Marks inside;
    Marks around;
};

// The vertices away from the outline, and from where the surroundings end.
Parts parts_of(const Triangles& inside, const Triangles& outside, const EdgeTable& edges, Eigen::Index vertex_count) {
    Parts parts{corners(inside, vertex_count), corners(outside, vertex_count)};
    Marks mixed(parts.inside.size(), 0);
    for (std::size_t v = 0; v < mixed.size(); ++v) mixed[v] = parts.inside[v] && parts.around[v];
    for (int e = 0; e < edges.size(); ++e) {
        if (edges.side_count(e) == 1) mixed[edges.ends[e][0]] = mixed[edges.ends[e][1]] = 1;
    }
    grow(edges, mixed_rings, mixed);
    for (std::size_t v = 0; v < mixed.size(); ++v) {
        parts.inside[v] = parts.inside[v] && !mixed[v];
        parts.around[v] = parts.around[v] && !mixed[v];
    }
    return parts;
}

// Signed degrees at all edges between two triangles.
std::vector<double> bends(const Points& points, const Triangles& triangles) {
    const DihedralBands bands(points, triangles);
    std::vector<double> angles;
    for (int e = 0; e < bands.edges().size(); ++e) {
        if (bands.edges().side_count(e) == 2) angles.push_back(bands.angle(e));
    }
    return angles;
}

std::size_t count(const Marks& marks) { return static_cast<std::size_t>(std::count(marks.begin(), marks.end(), 1)); }

}  // namespace

bool has_lost_grain(const Smoothed& mesh) {
    const Triangles inside = without_collapsed(mesh.inside);
    const Triangles outside = without_collapsed(mesh.outside);
    Triangles all(3, inside.cols() + outside.cols());
    all << inside, outside;
    const EdgeTable edges = make_edges(all, static_cast<int>(mesh.after.cols()));
    const Parts parts = parts_of(inside, outside, edges, mesh.after.cols());
    if (std::min(count(parts.inside), count(parts.around)) < fewest) return false;
    const VectorX now = deviations(mesh.after, all, edges);
    const Quartiles around = quartiles(now, parts.around);
    if (around.median < seen_grain || around.upper > even_grain * around.lower) return false;
    const Quartiles here = quartiles(now, parts.inside);
    if (here.median > lost_grain * around.median) return false;
    return quartiles(deviations(mesh.before, all, edges), parts.inside).median > 0.5 * around.median;
}

bool is_rougher(const Points& points, const Triangles& inside, const Triangles& outside) {
    std::vector<double> around = bends(points, without_collapsed(outside));
    const std::vector<double> here = bends(points, without_collapsed(inside));
    if (std::min(around.size(), here.size()) < fewest) return false;
    std::sort(around.begin(), around.end());
    const double low = around[around.size() / 20] - finest_kink;
    const double high = around[around.size() - 1 - around.size() / 20] + finest_kink;
    const auto beyond =
        std::count_if(here.begin(), here.end(), [&](double angle) { return angle < low || angle > high; });
    return static_cast<double>(beyond) > crumpled_share * static_cast<double>(here.size());
}

}  // namespace fairing
