#include "start/cylinder_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace fairing {

namespace {

constexpr int sweeps = 60;  // what a moved way changes dies out within a few edges

double off_line(double turns, double share) { return turns - share - std::round(turns - share); }

// Free vertices of the way from end to end that keeps nearest to the line (Dijkstra's algorithm).
Indices way_along(const Patch& patch, const CreaseLine& line, const CylinderMap& map) {
    constexpr double aside = 8.0;  // what a turn beside the line costs, in lengths of the cylinder
    std::vector<double> cost(at(patch.vertex_count()), std::numeric_limits<double>::infinity());
    Indices before(at(patch.vertex_count()), none);
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    cost[at(line.first)] = 0.0;
    queue.emplace(0.0, line.first);
    while (!queue.empty()) {
        const auto [here, v] = queue.top();
        queue.pop();
        if (v == line.last) break;
        if (here > cost[at(v)]) continue;
        for (const int u : patch.ring(v).vertices) {
            if (!patch.is_free(u) && u != line.last) continue;
            const double there =
                here + std::abs(map(0, u) - map(0, v)) + aside * std::abs(off_line(map(1, u), line.share));
            if (!(there < cost[at(u)])) continue;
            cost[at(u)] = there;
            before[at(u)] = v;
            queue.emplace(there, u);
        }
    }
    Indices way;
    for (int v = before[at(line.last)]; v != none && v != line.first; v = before[at(v)]) way.push_back(v);
    return way;
}

// The mean of its neighbours' turns.
double eased(const Patch& patch, int v, const VectorX& jumps, const CylinderMap& map) {
    const RingView ring = patch.ring(v);
    double sum = 0.0;
    for (std::size_t k = 0; k < ring.valence(); ++k) {
        const int edge = ring.spokes[k];
        const double jump = patch.edge_ends[at(edge)][0] == v ? -jumps[edge] : jumps[edge];
        sum += map(1, ring.vertices[k]) + jump;
    }
    return sum / static_cast<double>(ring.valence());
}

}  // namespace

std::vector<char> keep_creases(const Patch& patch, const std::vector<CreaseLine>& lines, Unrolled& flat) {
    std::vector<char> held(at(patch.vertex_count()), 0);
    for (const CreaseLine& line : lines) {
        held[at(line.first)] = held[at(line.last)] = 1;
        for (const int v : way_along(patch, line, flat.map)) {
            flat.map(1, v) -= off_line(flat.map(1, v), line.share);
            held[at(v)] = 1;
        }
    }
    for (int k = 0; k < sweeps; ++k) {
        for (int v = 0; v < patch.free_count; ++v) {
            if (!held[at(v)]) flat.map(1, v) = eased(patch, v, flat.jumps, flat.map);
        }
    }
    return held;
}

}  // namespace fairing
