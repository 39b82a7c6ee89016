#include "start/swept_start.h"

#include "operators/normal_operator.h"
#include "start/clamped_fill.h"

namespace fairing {

namespace {

// Where vertices lie on a cylinder. Rows: s from the first end to the last, then turns around.
using CylinderMap = Eigen::Matrix2Xd;

// Vertices of a shortest path from the first section to the last.
Indices seam(const Patch& patch, const SweptTube& tube) {
    Indices before(patch.vertex_count(), none);
    Indices queue;
    for (const int k : tube.first().vertices()) {
        queue.push_back(patch.free_count + k);
        before[queue.back()] = queue.back();
    }
    for (std::size_t k = 0; k < queue.size(); ++k) {
        for (const int u : patch.ring(queue[k]).vertices) {
            if (before[u] != none) continue;
            before[u] = queue[k];
            queue.push_back(u);
        }
    }
    Indices path{patch.free_count + tube.last().vertices().front()};
    while (before[path.back()] != path.back()) path.push_back(before[path.back()]);
    std::reverse(path.begin(), path.end());
    return path;
}

// By how much the turns at the far end of each edge (edge_ends: from the first to the second) count less: the edges
// that leave the seam to its left have gone around once.
VectorX jumps(const Patch& patch, const Indices& seam) {
    VectorX result = VectorX::Zero(patch.edge_count());
    for (std::size_t k = 0; k < seam.size(); ++k) {
        const RingView ring = patch.ring(seam[k]);
        const auto place_of = [&](int u) {
            return (static_cast<int>(std::find(ring.vertices.begin(), ring.vertices.end(), u) - ring.vertices.begin()));
        };
        const std::size_t begin = k + 1 < seam.size() ? place_of(seam[k + 1]) + 1 : 0;
        const std::size_t last = k > 0 ? place_of(seam[k - 1]) : ring.valence();
        const std::size_t end = last < begin ? last + ring.valence() : last;
        for (std::size_t j = begin; j < end; ++j) {
            const int edge = ring.spokes[j % ring.valence()];
            result[edge] = patch.edge_ends[edge][0] == seam[k] ? 1.0 : -1.0;
        }
    }
    return result;
}

// Along a section, from its vertex `first` on.
void write(const TubeSection& section, double s, int first, int free_count, CylinderMap& map) {
    const std::size_t count = section.vertices().size();
    const auto found = std::find(section.vertices().begin(), section.vertices().end(), first - free_count);
    const auto begin = static_cast<std::size_t>(found - section.vertices().begin());
    for (std::size_t k = 0; k < count; ++k)
        map.col(free_count + section.vertices()[k]) << s, section.share(k) + (k < begin ? 1.0 : 0.0);
}

// What the jumps add to the free vertices' equations.
VectorX jump_flux(const Patch& patch, const Stiffness& stiffness, const VectorX& jumps) {
    VectorX flux = VectorX::Zero(patch.vertex_count());
    for (int e = 0; e < patch.edge_count(); ++e) {
        const auto [tail, head] = patch.edge_ends[e];
        flux[tail] += stiffness.weights[e] * jumps[e];
        flux[head] -= stiffness.weights[e] * jumps[e];
    }
    return flux.head(patch.free_count);
}

// Whole turns from one end to the other are those that make the map shortest.
void untwist(const Patch& patch, const Stiffness& stiffness, const VectorX& jumps, CylinderMap& map) {
    double along = 0.0;
    double twist = 0.0;
    for (int e = 0; e < patch.edge_count(); ++e) {
        const Eigen::Vector2d step = map.col(patch.edge_ends[e][1]) - map.col(patch.edge_ends[e][0]);
        along += stiffness.weights[e] * step[0] * step[0];
        twist += stiffness.weights[e] * step[0] * (step[1] - jumps[e]);
    }
    map.row(1) -= std::round(twist / along) * map.row(0);
}

// Harmonic on triangles that are all equilateral, and so one to one (Tutte's theorem on a cylinder).
std::optional<CylinderMap> unrolled(const Patch& patch, const SweptTube& tube, const Progress& progress) {
    const Stiffness even = uniform_stiffness(patch);
    LaplaceOperator laplace(patch);
    if (!laplace.update(even, progress)) return std::nullopt;
    const Indices path = seam(patch, tube);
    const VectorX jump = jumps(patch, path);
    CylinderMap map = CylinderMap::Zero(2, patch.vertex_count());
    write(tube.first(), 0.0, path.front(), patch.free_count, map);
    write(tube.last(), 1.0, path.back(), patch.free_count, map);
    CylinderMap flux = even.apply(patch, map, patch.free_count);
    flux.row(1) += jump_flux(patch, even, jump);
    map.leftCols(patch.free_count) = -laplace.solve(flux.transpose()).transpose();
    untwist(patch, even, jump, map);
    return map;
}

Points laid(const Problem& problem, const SweptTube& tube, const CylinderMap& map) {
    Points points(3, problem.patch.vertex_count());
    for (int v = 0; v < problem.patch.free_count; ++v)
        points.col(v) = tube.place(map(0, v), map(1, v) - std::floor(map(1, v)));
    points.rightCols(problem.fixed_points.cols()) = problem.fixed_points;
    return points;
}

}  // namespace

std::vector<Indices> boundary_loops(const Patch& patch) {
    std::vector<Indices> loops = patch.loops();
    for (Indices& loop : loops) {
        for (int& v : loop) v -= patch.free_count;
    }
    return loops;
}

std::optional<SweptTube> tube_between(const Problem& problem) {
    return SweptTube::between(boundary_loops(problem.patch), problem.fixed_points, problem.fixed_normals);
}

std::optional<Points> swept_start(const Problem& problem, const SweptTube& tube, const Progress& progress) {
    const auto flat = unrolled(problem.patch, tube, progress);
    return flat ? std::optional(laid(problem, tube, *flat)) : std::nullopt;
}

}  // namespace fairing
