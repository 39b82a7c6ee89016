#include "method/eased.h"

#include <algorithm>
#include <numeric>

#include "method/on_coarse_proxy.h"
#include "outline/eased_outline.h"
#include "placement/folds.h"
#include "problem/surface_state.h"

namespace fairing {

namespace {

constexpr double wave = 16.0;  // vertices; 8 left regions of an ear and a cheek with turned triangles, 32 moved more

OutlineData outline_of(const Problem& problem) { return {problem.fixed_points, problem.fixed_normals}; }

OutlineData eased_outline_of(const Problem& problem) { return eased_outline(problem.patch, outline_of(problem), wave); }

// Of the neighbours one row nearer to the outline.
Vector3 mean_move(const Patch& patch, const Points& moves, const Indices& row, int vertex) {
    Vector3 sum = Vector3::Zero();
    int count = 0;
    for (const int w : patch.ring(vertex).vertices) {
        if (row[at(w)] != row[at(vertex)] - 1) continue;
        sum += moves.col(w);
        ++count;
    }
    return sum / count;
}

// Of all vertices; each row moves half as far as the mean of what it touches in the row before.
Points following(const Patch& patch, const Points& offsets) {
    constexpr int rows = 3;
    constexpr double share = 0.5;
    Points moves = Points::Zero(3, patch.vertex_count());
    moves.rightCols(offsets.cols()) = offsets;
    Indices row(at(patch.vertex_count()), none);
    std::fill(row.begin() + patch.free_count, row.end(), 0);
    Indices last(at(patch.vertex_count() - patch.free_count));
    std::iota(last.begin(), last.end(), patch.free_count);
    for (int k = 1; k <= rows; ++k) {
        Indices next;
        for (const int v : last) {
            for (const int w : patch.ring(v).vertices) {
                if (row[at(w)] != none) continue;
                row[at(w)] = k;
                next.push_back(w);
            }
        }
        for (const int v : next) moves.col(v) = share * mean_move(patch, moves, row, v);
        last = std::move(next);
    }
    return moves;
}

// Triangles without a fixed corner whose normal points against the one that they had.
Indices turned_inside(const Patch& patch, const Points& before, const Points& after) {
    Indices result;
    for (int t = 0; t < patch.triangle_count(); ++t) {
        if (patch.triangles.col(t).maxCoeff() >= patch.free_count) continue;
        if (area_vector(patch, after, t).dot(area_vector(patch, before, t)) < 0.0) result.push_back(t);
    }
    return result;
}

// Vertices stay where they were placed where triangles between them would turn over.
void follow_outline(const Patch& patch, const Points& offsets, Points& points) {
    const Points placed = points;
    Points moves = following(patch, offsets);
    while (true) {
        points = placed + moves;
        const Indices turned = turned_inside(patch, placed, points);
        if (turned.empty()) return;  // at last where none of them moves
        for (const int t : turned) {
            for (const int v : patch.triangles.col(t)) moves.col(v).setZero();
        }
    }
}

}  // namespace

bool is_jagged(const Problem& problem) {
    // Least variation was found over outlines of pipes up to 6e3 and never from 4e4 on. Regions of scans with noise of
    // a quarter edge have 4e6 to 2e9.
    constexpr double most = 3e4;
    return outline_variation(problem.patch, outline_of(problem)) > most;
}

std::optional<Solution> solve_eased(const Problem& problem, const Progress& progress) {
    const OutlineData outline = eased_outline_of(problem);
    Problem eased = problem;
    eased.fixed_points = outline.points;
    eased.fixed_normals = outline.normals;
    auto solution = place_on_coarse_proxy(eased, progress);
    if (!solution) return std::nullopt;
    follow_outline(problem.patch, problem.fixed_points - outline.points, solution->points);
    return solution;
}

bool is_eased(const Solution& solution) { return !solution.ways.empty() && solution.ways.back().name == eased_way; }

double eased_by(const Problem& problem) {
    return largest_length(problem.fixed_points - eased_outline_of(problem).points);
}

}  // namespace fairing
