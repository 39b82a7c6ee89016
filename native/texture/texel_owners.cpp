#include "texture/texel_owners.h"

#include <algorithm>
#include <array>
#include <cmath>

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
        : turned_(std::pair(b.x(), b.y()) < std::pair(a.x(), a.y())), from_(turned_ ? b : a),
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

}  // namespace

TexelOwners texel_owners(const Eigen::Matrix2Xd& corners, const ImageSize& size) {
    TexelOwners result{Indices(static_cast<std::size_t>(size.width) * size.height, none)};
    for (int t = 0; t < static_cast<int>(corners.cols() / 3); ++t) {
        checkpoint(t);
        std::array<Place, 3> of{corners.col(3 * t), corners.col(3 * t + 1), corners.col(3 * t + 2)};
        if (!corners.middleCols<3>(3 * t).allFinite()) continue;
        if (cross(of[1] - of[0], of[2] - of[0]) < 0.0) std::swap(of[1], of[2]);
        const Place least = of[0].cwiseMin(of[1]).cwiseMin(of[2]);
        const Place most = of[0].cwiseMax(of[1]).cwiseMax(of[2]);
        if ((most - least).prod() > 4.0 * size.width * size.height) {
            std::fill(result.owner.begin(), result.owner.end(), t);
            result.count += static_cast<std::int64_t>(result.owner.size());
            continue;
        }
        const std::array sides{Side(of[0], of[1]), Side(of[1], of[2]), Side(of[2], of[0])};
        const auto first = [](double low) { return static_cast<std::int64_t>(std::ceil(low - 0.5)); };
        for (std::int64_t y = first(least.y()); static_cast<double>(y) + 0.5 <= most.y(); ++y) {
            const auto row = static_cast<std::size_t>(wrapped(y, size.height)) * size.width;
            for (std::int64_t x = first(least.x()); static_cast<double>(x) + 0.5 <= most.x(); ++x) {
                const Place p(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
                if (!(sides[0].holds(p) && sides[1].holds(p) && sides[2].holds(p))) continue;
                result.owner[row + wrapped(x, size.width)] = t;
                ++result.count;
            }
        }
    }
    return result;
}

}  // namespace fairing
