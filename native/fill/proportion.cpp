#include "fill/proportion.h"

#include <cstdio>

#include "base/errors.h"
#include "fill/hole_shape.h"

namespace fairing {

namespace {

std::string rounded(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2g", value);
    return text.data();
}

}  // namespace

Limit Limit::of(double flat, int asked) {
    constexpr double always = 50'000.0;    // which take some two seconds: never refused
    constexpr double never = 4'000'000.0;  // a slip in the spacing, rather than a wish
    const double usual = std::min(std::max(always, out_of_proportion * flat), never);
    return {flat, asked > 0 ? static_cast<double>(asked) : usual, asked > 0};
}

void Limit::check(double count, Indices around, bool found) const {
    constexpr double small = 1000.0;  // that are solved in any case
    const double limit = found || is_chosen ? most : std::min(most, std::max(small, out_of_proportion * flat));
    if (count <= limit) return;
    std::string text = "the surface would need about " + rounded(count) + " new vertices, the limit is " +
                       rounded(limit) + ": raise `spacing`, or allow more by `max_vertices`";
    if (!found) text = "a coarse mesh gave no surface, and " + text;
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    throw MeshError({Code::out_of_proportion,
                     text,
                     std::move(around),
                     ElementKind::vertex,
                     {{"count", count}, {"limit", limit}, {"flat", flat}}});
}

}  // namespace fairing
