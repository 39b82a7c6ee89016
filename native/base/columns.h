// Columns gathered one by one.
#pragma once

#include <iterator>

#include "base/progress.h"
#include "base/types.h"

namespace fairing {

// Columns of points or triangles.
template <typename Column>
Eigen::Matrix3X<typename Column::Scalar> as_columns(const std::vector<Column>& columns) {
    Eigen::Matrix3X<typename Column::Scalar> result(3, static_cast<Eigen::Index>(columns.size()));
    Eigen::Index k = 0;
    for (const Column& column : columns) result.col(k++) = column;
    return result;
}

// v / |v|, however small or large v is; zero where it has no direction or isn't finite.
inline Vector3 direction(const Vector3& v) {
    const double largest = v.cwiseAbs().maxCoeff();
    if (!v.allFinite() || !(largest > 0.0)) return Vector3::Zero();
    return (v / largest).normalized();
}

// The entries of `all` that are not in `known`; both are in ascending order.
inline Indices without(const Indices& all, const Indices& known) {
    Indices rest;
    std::set_difference(all.begin(), all.end(), known.begin(), known.end(), std::back_inserter(rest));
    return rest;
}

// The median, of two in the middle the upper one; 0 without values.
inline double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

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

// The position of each number 0 … count − 1 in an order; `none` for those that it lacks.
inline Indices places_in(const Indices& order, std::size_t count) {
    Indices places(count, none);
    for (std::size_t k = 0; k < order.size(); ++k) places[order[k]] = static_cast<int>(k);
    return places;
}

}  // namespace fairing
