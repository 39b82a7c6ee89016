#include "texture/texel_owners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/progress.h"

namespace fairing {

namespace {

using Place = Eigen::Vector2d;

double cross(const Place& a, const Place& b) { return a.x() * b.y() - a.y() * b.x(); }

// The left of an edge from a to b. What lies on the edge is taken for a little further right, and far less further up.
class Side {
public:
    // One direction for both triangles at an edge: what is computed for one is the very negative for the other.
    Side(const Place& a, const Place& b)
        : turned_(std::pair(b.x(), b.y()) < std::pair(a.x(), a.y())),
          from_(turned_ ? b : a),
          along_(turned_ ? Place(a - b) : Place(b - a)),
          has_its_points_(b.y() < a.y() || (b.y() == a.y() && b.x() > a.x())) {}

    [[nodiscard]] bool holds(const Place& p) const {
        const double area = cross(along_, p - from_);
        return area == 0.0 ? has_its_points_ : (area < 0.0) == turned_;
    }

private:
    bool turned_;
    Place from_;
    Place along_;
    bool has_its_points_;
};

int wrapped(std::int64_t number, int size) {
    const auto rest = static_cast<int>(number % size);
    return rest < 0 ? rest + size : rest;
}

// visit(triangle, place in the image, centre) for all texels that triangles cover.
template <typename Visit>
void for_texels(const Eigen::Matrix2Xd& corners, const ImageSize& size, const Visit& visit) {
    const auto first = [](double low) { return static_cast<std::int64_t>(std::ceil(low - 0.5)); };
    for (int t = 0; t < static_cast<int>(corners.cols() / 3); ++t) {
        checkpoint(t);
        std::array<Place, 3> of{corners.col(3 * t), corners.col(3 * t + 1), corners.col(3 * t + 2)};
        if (!corners.middleCols(3 * t, 3).allFinite()) continue;
        if (cross(of[1] - of[0], of[2] - of[0]) < 0.0) std::swap(of[1], of[2]);
        const Place least = of[0].cwiseMin(of[1]).cwiseMin(of[2]);
        Place most = of[0].cwiseMax(of[1]).cwiseMax(of[2]);
        const bool is_vast = (most - least).prod() > 4.0 * size.width * size.height;
        if (is_vast) most = least + Place(size.width, size.height);
        const std::array sides{Side(of[0], of[1]), Side(of[1], of[2]), Side(of[2], of[0])};
        for (std::int64_t y = first(least.y()); static_cast<double>(y) + 0.5 <= most.y(); ++y) {
            const auto row = static_cast<std::size_t>(wrapped(y, size.height)) * size.width;
            for (std::int64_t x = first(least.x()); static_cast<double>(x) + 0.5 <= most.x(); ++x) {
                const Place p(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
                if (is_vast || (sides[0].holds(p) && sides[1].holds(p) && sides[2].holds(p)))
                    visit(t, row + wrapped(x, size.width), p);
            }
        }
    }
}

}  // namespace

TexelOwners texel_owners(const Eigen::Matrix2Xd& corners, const ImageSize& size) {
    TexelOwners result{Indices(static_cast<std::size_t>(size.width) * size.height, none)};
    for_texels(corners, size, [&](int triangle, std::size_t at, const Place&) {
        result.owner[at] = triangle;
        ++result.count;
    });
    return result;
}

Eigen::MatrixXf texel_values(const Eigen::Matrix2Xd& corners, const Eigen::MatrixXd& values, const ImageSize& size) {
    Eigen::MatrixXf result = Eigen::MatrixXf::Constant(
        values.rows(), static_cast<Eigen::Index>(size.width) * size.height, std::numeric_limits<float>::quiet_NaN());
    for_texels(corners, size, [&](int triangle, std::size_t at, const Place& p) {
        const auto of = corners.middleCols(3 * triangle, 3);
        const double whole = cross(of.col(1) - of.col(0), of.col(2) - of.col(0));
        const double second = cross(p - of.col(0), of.col(2) - of.col(0)) / whole;
        const double third = cross(of.col(1) - of.col(0), p - of.col(0)) / whole;
        const auto own = values.middleCols(3 * triangle, 3);
        result.col(static_cast<Eigen::Index>(at)) =
            ((1.0 - second - third) * own.col(0) + second * own.col(1) + third * own.col(2)).cast<float>();
    });
    return result;
}

}  // namespace fairing
