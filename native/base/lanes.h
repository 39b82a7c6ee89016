// Two numbers in one SIMD register, for the same work on two vertices.
#pragma once

#include <cstring>

#include "base/types.h"

namespace fairing {

// Behaves like a number. The lanes are independent: a vertex has the same bits whatever its neighbour lane holds.
class Lanes {
    using Pack = double __attribute__((vector_size(16)));
    using Mask = decltype(Pack() > Pack());

public:
    static constexpr int count = 2;  // doubles in a register of SSE2 and NEON

    Lanes() = default;
    Lanes(double value) : pack_{value, value} {}
    Lanes(double first, double second) : pack_{first, second} {}

    [[nodiscard]] double operator[](int lane) const { return pack_[lane]; }

    friend Lanes operator-(Lanes a) { return Lanes(-a.pack_); }
    friend Lanes operator+(Lanes a, Lanes b) { return Lanes(a.pack_ + b.pack_); }
    friend Lanes operator-(Lanes a, Lanes b) { return Lanes(a.pack_ - b.pack_); }
    friend Lanes operator*(Lanes a, Lanes b) { return Lanes(a.pack_ * b.pack_); }
    friend Lanes operator/(Lanes a, Lanes b) { return Lanes(a.pack_ / b.pack_); }
    Lanes& operator+=(Lanes b) { return *this = *this + b; }
    Lanes& operator-=(Lanes b) { return *this = *this - b; }
    Lanes& operator*=(Lanes b) { return *this = *this * b; }

    friend Lanes sqrt(Lanes a) {
        Eigen::Array2d numbers;  // Eigen takes both roots at once, whatever the processor
        std::memcpy(numbers.data(), &a.pack_, sizeof(Pack));
        numbers = numbers.sqrt().eval();
        std::memcpy(&a.pack_, numbers.data(), sizeof(Pack));
        return a;
    }

    friend Lanes copysign(Lanes size, Lanes sign) {
        const Mask bit = (Mask)Pack{-0.0, -0.0};
        return Lanes((Pack)(((Mask)size.pack_ & ~bit) | ((Mask)sign.pack_ & bit)));
    }

    friend Mask operator>(Lanes a, Lanes b) { return a.pack_ > b.pack_; }
    // a where the mask is set, else b.
    friend Lanes select(Mask mask, Lanes a, Lanes b) { return Lanes(mask ? a.pack_ : b.pack_); }

private:
    explicit Lanes(Pack pack) : pack_(pack) {}

    Pack pack_;
};

inline double select(bool mask, double a, double b) { return mask ? a : b; }

}  // namespace fairing

template <>
struct Eigen::NumTraits<fairing::Lanes> : Eigen::NumTraits<double> {
    using Real = fairing::Lanes;
    using NonInteger = fairing::Lanes;
    using Nested = fairing::Lanes;
    using Literal = fairing::Lanes;
};

namespace fairing {

// Vertices, edges … whose numbers lie side by side.
using LaneIndices = std::array<int, Lanes::count>;

// `index` and those behind it, before `end`; the last one again where there are too few.
inline LaneIndices lanes_from(int index, int end) { return {index, std::min(index + 1, end - 1)}; }

// Two vectors, by where their coordinates begin.
inline Vector3Of<Lanes> side_by_side(const double* first, const double* second) {
    return {Lanes(first[0], second[0]), Lanes(first[1], second[1]), Lanes(first[2], second[2])};
}

// Two columns of a field.
inline Vector3Of<Lanes> gathered(const Points& field, LaneIndices columns) {
    return side_by_side(field.col(columns[0]).data(), field.col(columns[1]).data());
}

inline void scatter(const Vector3Of<Lanes>& vectors, LaneIndices columns, Points& field) {
    for (int k = 0; k < Lanes::count; ++k) {
        field.col(columns[k]) << vectors[0][k], vectors[1][k], vectors[2][k];
    }
}

}  // namespace fairing
