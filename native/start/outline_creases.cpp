#include "start/outline_creases.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fairing {

namespace {

constexpr double least_turn = std::numbers::pi / 3.0;
constexpr double standing_out = 2.0;  // times the turn beside it
constexpr std::size_t smallest = 8;   // vertices of a loop

// By how much the normals turn from before each place to behind it, radians.
VectorX turns(const Indices& loop, const Points& normals) {
    const std::size_t size = loop.size();
    VectorX result(static_cast<Eigen::Index>(size));
    for (std::size_t k = 0; k < size; ++k) {
        const double cosine = normals.col(loop[(k + size - 1) % size]).dot(normals.col(loop[(k + 1) % size]));
        result[static_cast<Eigen::Index>(k)] = std::acos(std::clamp(cosine, -1.0, 1.0));
    }
    return result;
}

}  // namespace

Indices outline_creases(const Indices& loop, const Points& normals) {
    Indices found;
    if (loop.size() < smallest) return found;
    const VectorX turn = turns(loop, normals);
    const auto size = static_cast<int>(loop.size());
    const auto beside = [&](int k, int step) { return turn[(k + step + size) % size]; };
    for (int k = 0; k < size; ++k) {
        const bool is_largest = turn[k] > beside(k, -1) && turn[k] >= beside(k, 1);
        const double around = std::max(beside(k, -2), beside(k, 2));
        if (is_largest && turn[k] > least_turn && turn[k] > standing_out * around) found.push_back(k);
    }
    std::stable_sort(found.begin(), found.end(), [&](int a, int b) { return turn[a] > turn[b]; });
    return found;
}

}  // namespace fairing
