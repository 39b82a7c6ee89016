#include "mesh/memory_order.h"

#include <cstdlib>

#include "base/columns.h"
#include "base/progress.h"

namespace fairing {

namespace {

constexpr int least_sorted = 50000;  // fewer triangles fit into the cache in any order

// The mean distance of neighbours, in vertices. Row by row it is about the square root of their number.
constexpr double least_far = 400.0;  // what is nearer lies in the cache together
constexpr double far_in_rows = 8.0;

Indices least_corners(const Triangles& triangles) {
    Indices least(static_cast<int>(triangles.cols()));
    for (int t = 0; t < static_cast<int>(triangles.cols()); ++t) least[t] = triangles.col(t).minCoeff();
    return least;
}

void reorder(const Indices& order, Triangles& triangles, Indices& numbers) {
    Triangles sorted(3, triangles.cols());
    Indices sorted_numbers(numbers.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        sorted.col(static_cast<Eigen::Index>(k)) = triangles.col(order[k]);
        sorted_numbers[k] = numbers[order[k]];
    }
    triangles = std::move(sorted);
    numbers = std::move(sorted_numbers);
}

bool are_far_apart(const PatchMembers& members) {
    double sum = 0.0;
    double count = 0.0;
    for (const auto corners : members.triangles.colwise()) {
        for (int k = 0; k < 3; ++k) {
            const int a = corners[k];
            const int b = corners[(k + 1) % 3];
            if (std::max(a, b) >= members.free_count) continue;
            sum += std::abs(a - b);
            count += 1.0;
        }
    }
    return sum > count * std::max(least_far, far_in_rows * std::sqrt(static_cast<double>(members.free_count)));
}

// The triangles from one on, by as few steps across their sides as possible. Precondition: one piece.
Indices outwards(const Twins& twins) {
    std::vector<char> reached(twins.size() / 3, 0);
    Indices queue{0};
    queue.reserve(reached.size());
    reached[0] = 1;
    for (std::size_t next = 0; next < queue.size(); ++next) {
        checkpoint(static_cast<int>(next));
        for (int k = 0; k < 3; ++k) {
            const int twin = twins[3 * queue[next] + k];
            if (twin == none || reached[twin / 3]) continue;
            reached[twin / 3] = 1;
            queue.push_back(twin / 3);
        }
    }
    return queue;
}

// Old number → new number: free vertices in the order of their first triangles, the fixed ones as they are.
Indices vertex_numbers(const PatchMembers& members, const Twins& twins) {
    Indices numbers(members.to_input.size(), none);
    int count = 0;
    for (const int t : outwards(twins)) {
        for (const int v : members.triangles.col(t)) {
            if (v < members.free_count && numbers[v] == none) numbers[v] = count++;
        }
    }
    std::iota(numbers.begin() + members.free_count, numbers.end(), members.free_count);
    return numbers;
}

void renumber_vertices(const Indices& numbers, PatchMembers& members) {
    const Indices to_input = members.to_input;
    const std::vector<char> pin = members.pin;
    for (std::size_t v = 0; v < numbers.size(); ++v) {
        members.to_input[numbers[v]] = to_input[v];
        members.pin[numbers[v]] = pin[v];
    }
    for (int& v : members.triangles.reshaped()) v = numbers[v];
}

}  // namespace

void sort_triangles(Triangles& triangles, Indices& numbers, int vertex_count) {
    if (triangles.cols() < least_sorted) return;
    const Indices least = least_corners(triangles);
    if (!std::is_sorted(least.begin(), least.end())) reorder(sorted_by(least, vertex_count), triangles, numbers);
}

void bring_neighbours_together(PatchMembers& members, Twins& twins) {
    if (twins.empty() || !are_far_apart(members)) return;
    renumber_vertices(vertex_numbers(members, twins), members);
    const Indices order = sorted_by(least_corners(members.triangles), static_cast<int>(members.to_input.size()));
    reorder(order, members.triangles, members.input_triangle);
    const Indices place = places_in(order, order.size());
    Twins moved(twins.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        for (std::size_t c = 0; c < 3; ++c) {
            const int twin = twins[3 * order[k] + c];
            moved[3 * k + c] = twin == none ? none : 3 * place[twin / 3] + twin % 3;
        }
    }
    twins = std::move(moved);
}

}  // namespace fairing
