#include "shape/roughness.h"

#include <Eigen/Geometry>

#include "base/columns.h"
#include "geometry/dihedral_bands.h"
#include "geometry/neighbourhood.h"
#include "geometry/triangle.h"
#include "mesh/edges.h"
#include "mesh/twins.h"
#include "shape/limits.h"

namespace fairing {

namespace {

constexpr int rings_around = 4;  // as far as fits of slopes reach

using Marks = std::vector<char>;

Marks corners(const Triangles& triangles, Eigen::Index vertex_count) {
    Marks found(static_cast<std::size_t>(vertex_count), 0);
    for (const int v : triangles.reshaped()) found[v] = 1;
    return found;
}

// Vertices within some rings of the marked ones, these among them.
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

// At an open border heights say nothing.
void unmark_border(const EdgeTable& edges, Marks& marked) {
    for (int e = 0; e < edges.size(); ++e) {
        if (edges.side_count(e) == 1) marked[edges.ends[e][0]] = marked[edges.ends[e][1]] = 0;
    }
}

std::vector<double> marked_heights(const Points& points, const Triangles& triangles, const std::vector<char>& marked) {
    const VectorX all = heights(points, triangles);
    std::vector<double> found;
    for (Eigen::Index v = 0; v < all.size(); ++v) {
        if (marked[static_cast<std::size_t>(v)] && std::isfinite(all[v])) found.push_back(all[v]);
    }
    return found;
}

constexpr int steps = 8;           // of smoothing: what is longer than some six edges is shape
constexpr int mixed_rings = 2;     // from the outline on, where normals know the other side
constexpr std::size_t fewest = 4;  // vertices that say something

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

bool is_needle(const Points& points, const Triangles& triangles, Eigen::Index t) {
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) {
        const Vector3 side = points.col(triangles((k + 1) % 3, t)) - points.col(triangles(k, t));
        longest = std::max(longest, side.squaredNorm());
    }
    return !(area_vector(points, triangles.col(t)).norm() > needle_height * longest);
}

// Of the triangles on the other sides of a triangle's edges.
std::vector<Vector3> normals_beside(const Points& points, const Triangles& triangles, const EdgeTable& edges, int t) {
    std::vector<Vector3> normals;
    for (int k = 0; k < 3; ++k) {
        const int edge = edges.edge_of_side[3 * t + k];
        for (int side = 0; side < edges.side_count(edge); ++side) {
            const int other = edges.side(edge, side) / 3;
            if (other != t) normals.push_back(area_vector(points, triangles.col(other)));
        }
    }
    return normals;
}

bool bends(const std::vector<Vector3>& normals) {
    for (std::size_t k = 1; k < normals.size(); ++k) {
        for (std::size_t j = 0; j < k; ++j) {
            if (degrees_between(normals[j], normals[k]) > flat_bend) return true;
        }
    }
    return false;
}

}  // namespace

VectorX heights(const Points& points, const Triangles& triangles) {
    // In a closed ring of triangles each neighbour counts twice, and so does not matter.
    Points sums = Points::Zero(3, points.cols());
    VectorX lengths = VectorX::Zero(points.cols());
    VectorX uses = VectorX::Zero(points.cols());
    for (const auto corner : triangles.colwise()) {
        for (int k = 0; k < 3; ++k) {
            const Vector3 left = points.col(corner[(k + 1) % 3]);
            const Vector3 right = points.col(corner[(k + 2) % 3]);
            sums.col(corner[k]) += 0.5 * (left + right);
            lengths[corner[k]] += (left - right).norm();
            uses[corner[k]] += 1.0;
        }
    }
    VectorX result = VectorX::Zero(points.cols());
    for (Eigen::Index v = 0; v < result.size(); ++v) {
        if (lengths[v] != 0.0) result[v] = (points.col(v) * uses[v] - sums.col(v)).norm() / lengths[v];
    }
    return result;
}

bool is_spoilt(const Points& points, const Triangles& inside, const Triangles& outside) {
    std::vector<char> own = corners(inside, points.cols());
    std::vector<char> around = corners(outside, points.cols());
    for (std::size_t v = 0; v < own.size(); ++v) {
        const bool is_border = own[v] && around[v];
        own[v] = own[v] && !is_border;
        around[v] = is_border;
    }
    std::vector<double> found = marked_heights(points, inside, own);
    if (found.empty()) return false;
    if (*std::max_element(found.begin(), found.end()) > spike) return true;
    const double height = median(found);
    if (height < crumpled) return false;
    const EdgeTable edges = make_edges(outside, static_cast<int>(around.size()));
    grow(edges, rings_around, around);
    unmark_border(edges, around);
    std::vector<double> others = marked_heights(points, outside, around);
    return others.empty() || height > rougher * median(others);
}

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

Needles needles(const Points& points, const Triangles& triangles) {
    Needles found;
    for (int t = 0; t < triangles.cols(); ++t) {
        if (is_needle(points, triangles, t)) found.all.push_back(t);
    }
    if (found.all.empty()) return found;
    const EdgeTable edges = make_edges(triangles, static_cast<int>(points.cols()));
    for (const int t : found.all) {
        if (bends(normals_beside(points, triangles, edges, t))) found.seen.push_back(t);
    }
    return found;
}

}  // namespace fairing
