// Differences of sorted lists.
#pragma once

#include <algorithm>
#include <iterator>

#include "base/types.h"

namespace fairing {

// Those of `all` that `known` does not hold; both are in ascending order.
inline Indices without(const Indices& all, const Indices& known) {
    Indices rest;
    std::set_difference(all.begin(), all.end(), known.begin(), known.end(), std::back_inserter(rest));
    return rest;
}

}  // namespace fairing
