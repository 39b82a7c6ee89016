// Orders of things that are numbered from 0 on.
#pragma once

#include "base/progress.h"
#include "base/types.h"

namespace fairing {

// The numbers of the keys in the order of these, ascending among the same; keys lie in 0 … count − 1. A counting sort.
inline Indices sorted_by(const Indices& keys, int count) {
    Indices begin(count + 1, 0);
    for (const int key : keys) ++begin[key + 1];
    for (std::size_t k = 1; k < begin.size(); ++k) begin[k] += begin[k - 1];
    Indices order(keys.size());
    for (int k = 0; k < static_cast<int>(keys.size()); ++k) {
        checkpoint(k);
        order[begin[keys[k]]++] = k;
    }
    return order;
}

// The place of each number 0 … count − 1 in an order; `none` for those that it lacks.
inline Indices places_in(const Indices& order, std::size_t count) {
    Indices places(count, none);
    for (std::size_t k = 0; k < order.size(); ++k) places[order[k]] = static_cast<int>(k);
    return places;
}

}  // namespace fairing
