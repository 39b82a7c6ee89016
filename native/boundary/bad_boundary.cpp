#include "boundary/bad_boundary.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/median.h"

namespace fairing {

namespace {

constexpr double least_error = 0.15;    // radians
constexpr double least_height = 0.3;    // edges
constexpr double times_median = 4.0;    // what is usual along this boundary
constexpr double largest_share = 0.15;  // of the outline

// Of the places with triangles: standard errors and heights over the fit, in edges; infinite without a fit.
struct Doubts {
    Indices places;
    std::vector<double> errors;
    std::vector<double> heights;
};

Doubts doubts_of(const SurroundingFit& fit) {
    Doubts result;
    for (std::size_t k = 0; k < fit.fits.size(); ++k) {
        const double length = fit.lengths[static_cast<Eigen::Index>(k)];
        if (!(length > 0.0)) continue;
        result.places.push_back(static_cast<int>(k));
        result.errors.push_back(fit.fits[k] ? fit.fits[k]->error : HUGE_VAL);
        result.heights.push_back(fit.fits[k] ? std::abs(fit.fits[k]->height) / length : HUGE_VAL);
    }
    return result;
}

}  // namespace

Indices bad_vertices(const SurroundingFit& fit) {
    const Doubts doubts = doubts_of(fit);
    const double error_bound = std::max(least_error, times_median * median(doubts.errors));
    const double height_bound = std::max(least_height, times_median * median(doubts.heights));
    std::vector<std::pair<double, int>> bad;  // by how much, negative, so that the worst come first
    for (std::size_t k = 0; k < doubts.places.size(); ++k) {
        const double excess = std::max(doubts.errors[k] / error_bound, doubts.heights[k] / height_bound);
        if (excess > 1.0) bad.emplace_back(-excess, doubts.places[k]);
    }
    std::sort(bad.begin(), bad.end());
    const auto most = static_cast<std::size_t>(std::ceil(largest_share * static_cast<double>(doubts.places.size())));
    bad.resize(std::min(bad.size(), most));
    Indices places;
    for (const auto& [excess, place] : bad) places.push_back(place);
    std::sort(places.begin(), places.end());
    return places;
}

}  // namespace fairing
