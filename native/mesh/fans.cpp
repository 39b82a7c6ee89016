#include "mesh/fans.h"

#include <algorithm>

#include "base/progress.h"

namespace fairing {

namespace {

// Corners around a vertex of the mesh, one after the other across its twins. Corner 3 t + k has side 3 t + k on
// one hand and side 3 t + (k + 2) % 3 on the other.
class FanWalk {
public:
    FanWalk(const Triangles& triangles, const Twins& twins) : triangles_(triangles), twins_(twins) {}

    // visit(corner) for a corner's fan, as far as it says true: from this corner to the last one on either hand.
    template <typename Visit>
    void around(int corner, const Visit& visit) const {
        visit(corner);
        for (const int first : {corner, corner - corner % 3 + (corner + 2) % 3}) {
            for (int twin = twins_[first]; twin != none;) {
                const int triangle = twin - twin % 3;
                const bool starts_here = vertex(twin) == vertex(corner);
                const int next = starts_here ? twin : triangle + (twin + 1) % 3;
                if (!visit(next)) break;
                twin = twins_[starts_here ? triangle + (twin + 2) % 3 : next];
            }
        }
    }

private:
    [[nodiscard]] int vertex(int corner) const { return triangles_.data()[corner]; }

    const Triangles& triangles_;
    const Twins& twins_;
};

std::array<int, 3> sorted_fans(const Fans& fans, int triangle) {
    std::array<int, 3> result{};
    for (int k = 0; k < 3; ++k) result[k] = fans.of_corner[3 * triangle + k];
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace

Fans join_corners(const Triangles& triangles, const Twins& twins) {
    Fans fans;
    const int corner_count = 3 * static_cast<int>(triangles.cols());
    fans.of_corner.assign(corner_count, none);
    const FanWalk walk(triangles, twins);
    for (int c = 0; c < corner_count; ++c) {
        checkpoint(c);
        if (fans.of_corner[c] != none) continue;
        const auto fan = static_cast<int>(fans.input_vertex.size());
        fans.input_vertex.push_back(triangles(c % 3, c / 3));
        walk.around(c, [&](int corner) {
            if (fans.of_corner[corner] != none) return false;
            fans.of_corner[corner] = fan;
            return true;
        });
    }
    return fans;
}

Indices doubled_triangles(const Triangles& triangles, const EdgeTable& edges, const Fans& fans) {
    // A pocket has an edge that joins it, since its corners are joined: the two sides of that one are looked at.
    Indices result;
    for (int e = 0; e < edges.size(); ++e) {
        checkpoint(e);
        if (edges.side_count(e) != 2) continue;
        const int a = edges.side(e, 0) / 3;
        const int b = edges.side(e, 1) / 3;
        if (triangles.col(a).sum() != triangles.col(b).sum() || sorted_fans(fans, a) != sorted_fans(fans, b)) continue;
        result.insert(result.end(), {a, b});
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

}  // namespace fairing
