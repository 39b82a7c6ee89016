#include "geometry/tall_system.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fairing {

namespace {

using Four = TallSystem::Four;
using Index = TallSystem::Index;
using Place = Eigen::Map<Four, Eigen::Aligned16>;
using ConstPlace = Eigen::Map<const Four, Eigen::Aligned16>;

// Fours with ones at a place, and behind it, are cut out of these.
constexpr std::array<double, 7> one = {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0};
constexpr std::array<double, 7> ones = {0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0};
Four cut_out(const std::array<double, 7>& numbers, Index place) {
    return Eigen::Map<const Four>(numbers.data() + 3 - place);
}

double squared_length(const double* v, Index fours) {
    Four sum = Four::Zero();
    for (Index k = 0; k < 4 * fours; k += 4) sum += ConstPlace(v + k).square();
    return sum.sum();
}

// Stores of single entries among fours would make the next loads wait: whole fours are written throughout.
struct Reflector {
    const double* v;
    Index fours;
    Index place;     // where v begins in its first four
    double inverse;  // of half of |v|²
};

// Reflects `Count` columns that lie `stride` apart, side by side. Their entries where v begins go to `row`.
template <int Count>
void reflect_columns(const Reflector& reflector, double* columns, Index stride, double* row) {
    const auto [v, fours, place, inverse] = reflector;
    std::array<Four, Count> sums;
    sums.fill(Four::Zero());
    for (Index k = 0; k < 4 * fours; k += 4) {
        const Four part = ConstPlace(v + k);
        for (int c = 0; c < Count; ++c) sums[c] += part * ConstPlace(columns + c * stride + k);
    }
    std::array<double, Count> shares;
    for (int c = 0; c < Count; ++c) shares[c] = sums[c].sum() * inverse;
    for (Index k = 0; k < 4 * fours; k += 4) {
        const Four part = ConstPlace(v + k);
        for (int c = 0; c < Count; ++c) Place(columns + c * stride + k) -= shares[c] * part;
    }
    for (Index c = 0; c < Count; ++c) {
        row[c * TallSystem::most_columns] = columns[c * stride + place];
        Place(columns + c * stride) *= cut_out(ones, place);
    }
}

}  // namespace

TallSystem::TallSystem(Index rows, Index columns)
    : columns_(columns), fours_((rows + 3) / 4), rows_(4, columns * fours_), factor_() {}

// Row j of R is taken out as soon as it stands: the reflector and all behind it begin with zeros then.
void TallSystem::triangularise() {
    for (Index j = 0; j < columns_; ++j) reflect(j);
}

void TallSystem::reflect(Index column) {
    const Index place = column % 4;
    const Index stride = 4 * fours_;
    double* const v = rows_.data() + column * stride + column - place;
    const Index fours = fours_ - column / 4;
    const double length = std::sqrt(squared_length(v, fours));
    const double pivot = v[place] > 0.0 ? -length : length;
    const double scale = -pivot * (v[place] - pivot);
    Place(v) -= pivot * cut_out(one, place);
    const Reflector reflector{v, fours, place, scale > 0.0 ? 1.0 / scale : 0.0};
    double* row = &factor_(column, column);
    *row = pivot;
    Index k = column + 1;
    for (; k + 1 < columns_; k += 2) {
        reflect_columns<2>(reflector, v + (k - column) * stride, stride, row + (k - column) * most_columns);
    }
    if (k < columns_) {
        reflect_columns<1>(reflector, v + (k - column) * stride, stride, row + (k - column) * most_columns);
    }
}

double TallSystem::least_pivot(Index count) const {
    double least = std::abs(factor_(0, 0));
    double largest = least;
    for (Index k = 1; k < count; ++k) {
        least = std::min(least, std::abs(factor_(k, k)));
        largest = std::max(largest, std::abs(factor_(k, k)));
    }
    return least / largest;
}

TallSystem::Row TallSystem::solve(Index count) const {
    Row x = factor_.col(count).head(count);
    for (Index k = count - 1; k >= 0; --k) {
        x[k] /= factor_(k, k);
        for (Index i = 0; i < k; ++i) x[i] -= x[k] * factor_(i, k);
    }
    return x;
}

TallSystem::Row TallSystem::solve_transposed(Row y) const {
    for (Index k = 0; k < y.size(); ++k) {
        for (Index i = 0; i < k; ++i) y[k] -= y[i] * factor_(i, k);
        y[k] /= factor_(k, k);
    }
    return y;
}

}  // namespace fairing
