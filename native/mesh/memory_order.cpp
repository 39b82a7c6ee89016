#include "mesh/memory_order.h"

#include <cstdint>
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

// From triangle to triangle across their sides.
Indices steps_from(int start, const Twins& twins) {
    Indices steps(twins.size() / 3, none);
    Indices queue{start};
    queue.reserve(steps.size());
    steps[start] = 0;
    for (std::size_t next = 0; next < queue.size(); ++next) {
        checkpoint(static_cast<int>(next));
        const int t = queue[next];
        for (int k = 0; k < 3; ++k) {
            const int twin = twins[3 * t + k];
            if (twin == none || steps[twin / 3] != none) continue;
            steps[twin / 3] = steps[t] + 1;
            queue.push_back(twin / 3);
        }
    }
    return steps;
}

// On the boundary; any where there is none.
Indices boundary_triangles(const Twins& twins) {
    Indices found;
    for (int s = 0; s < static_cast<int>(twins.size()); ++s) {
        if (twins[s] == none) found.push_back(s / 3);
    }
    if (!found.empty()) return found;
    found.resize(twins.size() / 3);
    std::iota(found.begin(), found.end(), 0);
    return found;
}

constexpr int cells = 65536;  // a power of two

// The position of a cell on the Hilbert curve over cells × cells of them (Hilbert 1891).
std::uint32_t hilbert_place(std::uint32_t x, std::uint32_t y) {
    std::uint32_t place = 0;
    for (std::uint32_t half = cells / 2; half > 0; half /= 2) {
        const bool right = (x & half) != 0;
        const bool up = (y & half) != 0;
        place += half * half * ((right ? 3U : 0U) ^ (up ? 1U : 0U));
        if (up) continue;
        if (right) {
            x = ~x;
            y = ~y;
        }
        std::swap(x, y);
    }
    return place;
}

// The position of each triangle on the curve over the chart. Precondition: one piece.
std::vector<std::uint32_t> places_on_chart(const Twins& twins) {
    const Indices boundary = boundary_triangles(twins);
    const Indices east = steps_from(boundary.front(), twins);
    const int farthest = *std::max_element(east.begin(), east.end());
    const auto off_half = [&](int t) { return std::abs(2 * east[t] - farthest); };
    const int aside =
        *std::min_element(boundary.begin(), boundary.end(), [&](int a, int b) { return off_half(a) < off_half(b); });
    const Indices north = steps_from(aside, twins);
    std::vector<std::uint32_t> places;
    places.reserve(east.size());
    const int scale = 1 + 2 * farthest / cells;  // one is at most twice as far from any as the other
    for (std::size_t t = 0; t < east.size(); ++t)
        places.push_back(
            hilbert_place(static_cast<std::uint32_t>(east[t] / scale), static_cast<std::uint32_t>(north[t] / scale)));
    return places;
}

// Old number → new number: free vertices in the order of their first triangles, the fixed ones as they are.
Indices vertex_numbers(const PatchMembers& members, const Twins& twins) {
    const std::vector<std::uint32_t> places = places_on_chart(twins);
    std::vector<std::pair<std::uint32_t, int>> sorted(members.free_count, {0, none});
    for (int t = 0; t < static_cast<int>(places.size()); ++t) {
        for (const int v : members.triangles.col(t)) {
            if (v < members.free_count && sorted[v].second == none) sorted[v] = {places[t], v};
        }
    }
    std::sort(sorted.begin(), sorted.end());
    Indices numbers(members.to_input.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    for (std::size_t k = 0; k < sorted.size(); ++k) numbers[sorted[k].second] = static_cast<int>(k);
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
