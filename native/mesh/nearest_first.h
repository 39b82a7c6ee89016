// Dijkstra's algorithm: the queue, for any graph.
#pragma once

#include <queue>

#include "base/progress.h"
#include "base/types.h"

namespace fairing {

// Vertices in ascending order of their values, which those before them may have lowered.
class NearestFirst {
public:
    explicit NearestFirst(VectorX values) : values_(std::move(values)) {}

    // Whether the vertex had a larger value: then it comes once more.
    bool lower(int vertex, double value) {
        if (!(value < values_[vertex])) return false;
        values_[vertex] = value;
        ahead_.emplace(value, vertex);
        return true;
    }

    // `none` at the end. Throws what checkpoint() throws.
    int next() {
        checkpoint();
        while (!ahead_.empty()) {
            const auto [value, vertex] = ahead_.top();
            ahead_.pop();
            if (!(value > values_[vertex])) return vertex;
        }
        return none;
    }

    double operator[](int vertex) const { return values_[vertex]; }
    [[nodiscard]] VectorX take() && { return std::move(values_); }

private:
    using Reached = std::pair<double, int>;
    VectorX values_;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> ahead_;
};

}  // namespace fairing
