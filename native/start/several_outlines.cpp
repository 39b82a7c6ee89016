#include "start/several_outlines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fairing {

namespace {

constexpr double trusted_turn = 30.0;  // degrees between the normals at the ends of an outline edge
constexpr double lost_turn = 60.0;     // likewise: no normal is trusted from here on

// How often a loop comes back to a vertex of the input: two outlines joined by an edge are one loop that passes both
// ends of the edge twice.
std::size_t touching(const Patch& patch, const std::vector<Indices>& loops) {
    std::size_t count = 0;
    for (Indices loop : loops) {
        for (int& v : loop) v = patch.to_input[v];
        std::sort(loop.begin(), loop.end());
        count += loop.size() - static_cast<std::size_t>(std::unique(loop.begin(), loop.end()) - loop.begin());
    }
    return count;
}

bool is_held_elsewhere(const Patch& patch, const std::vector<Indices>& loops) {
    std::size_t on_loops = 0;
    for (const Indices& loop : loops) on_loops += loop.size();
    return patch.has_pins() || on_loops != static_cast<std::size_t>(patch.vertex_count() - patch.free_count);
}

struct Loop {
    double length = 0.0;
    Vector3 middle = Vector3::Zero();
};

Loop measured(const Indices& vertices, const Points& points) {
    Loop loop;
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        const Vector3 here = points.col(vertices[k]);
        const Vector3 next = points.col(vertices[(k + 1) % vertices.size()]);
        loop.length += (next - here).norm();
        loop.middle += here / static_cast<double>(vertices.size());
    }
    return loop;
}

std::vector<Loop> loops_of(const Patch& patch, const Points& points) {
    std::vector<Loop> loops;
    for (const Indices& vertices : patch.loops()) loops.push_back(measured(vertices, points));
    return loops;
}

// Of the tube between two loops; 0 for fewer or more.
double straight_area(const std::vector<Loop>& loops) {
    if (loops.size() != 2) return 0.0;
    return 0.5 * (loops[0].length + loops[1].length) * (loops[0].middle - loops[1].middle).norm();
}

double squares_of(const std::vector<Loop>& loops) {
    double squares = 0.0;
    for (const Loop& loop : loops) squares += loop.length * loop.length;
    return squares;
}

}  // namespace

double straight_length_between(const Patch& patch, const Points& points) {
    const std::vector<Loop> loops = loops_of(patch, points);
    return straight_area(loops) / squares_of(loops);
}

bool may_fit_several(const Patch& patch, const Points& points) {
    const int loops = patch.loop_count();
    return loops > 2 || (loops == 2 && straight_length_between(patch, points) > longest_single);
}

bool joins_outlines(const Problem& problem) {
    const std::vector<Indices> loops = problem.patch.loops();
    return loops.size() + touching(problem.patch, loops) > 1 && !is_held_elsewhere(problem.patch, loops);
}

VectorX trust_in_slopes(const Problem& problem) {
    VectorX trust = VectorX::Ones(problem.fixed_normals.cols());
    for (const Indices& loop : problem.patch.loops()) {
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const int a = loop[k] - problem.patch.free_count;
            const int b = loop[(k + 1) % loop.size()] - problem.patch.free_count;
            const double cosine = problem.fixed_normals.col(a).dot(problem.fixed_normals.col(b));
            const double turn = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
            const double here = std::clamp((lost_turn - turn) / (lost_turn - trusted_turn), 0.0, 1.0);
            trust[a] = std::min(trust[a], here);
            trust[b] = std::min(trust[b], here);
        }
    }
    return trust;
}

}  // namespace fairing
