// A matrix that somebody else owns.
#pragma once

#include <Eigen/Core>

namespace fairing {

// Reads as a `Matrix`, whose columns lie one after the other in an array of the caller's or in a matrix that lives
// longer.
template <typename Matrix>
class View : public Eigen::Map<const Matrix> {
public:
    using Map = Eigen::Map<const Matrix>;
    View(const Map& map) : Map(map) {}                                        // NOLINT: as a reference would
    View(const Matrix& kept) : Map(kept.data(), kept.rows(), kept.cols()) {}  // NOLINT
    View(Matrix&&) = delete;
    View(const View&) = default;
    ~View() = default;
    // Refers to the same matrix as the other one.
    View& operator=(const View& other) {
        new (static_cast<Map*>(this)) Map(other);
        return *this;
    }
};

}  // namespace fairing
