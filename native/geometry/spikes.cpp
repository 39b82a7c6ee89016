#include "geometry/spikes.h"

#include <numbers>

#include "geometry/angle_defects.h"

namespace fairing {

namespace {

constexpr double least_turn = 2.0 * std::numbers::pi * (1.0 - 1.0 / std::numbers::sqrt2);

// Of the vertices that lie within the radius of one of them and are connected with it there.
class Neighbourhood {
public:
    Neighbourhood(const Patch& patch, const Points& points, double radius)
        : patch_(patch), points_(points), radius_(radius), seen_at_(patch.vertex_count(), none) {}

    const Indices& around(int centre) {
        members_.assign(1, centre);
        seen_at_[centre] = centre;
        for (std::size_t k = 0; k < members_.size(); ++k) {
            for (const int v : patch_.ring(members_[k]).vertices) {
                if (seen_at_[v] == centre || away(v, centre) >= radius_) continue;
                seen_at_[v] = centre;
                members_.push_back(v);
            }
        }
        return members_;
    }

    [[nodiscard]] double away(int v, int centre) const { return (points_.col(v) - points_.col(centre)).norm(); }

private:
    const Patch& patch_;
    const Points& points_;
    double radius_;
    Indices seen_at_;  // the last centre whose neighbourhood each vertex was in
    Indices members_;
};

}  // namespace

bool has_spike(const Patch& patch, const Points& points, double radius) {
    constexpr double spacing = 0.25;  // of the radius, between the vertices looked around: where many lie in one place
    const VectorX defects = angle_defects(patch, points);
    Neighbourhood neighbourhood(patch, points, radius);
    std::vector<char> done(patch.vertex_count(), 0);
    for (int v = 0; v < patch.free_count; ++v) {
        if (done[v]) continue;
        double turn = 0.0;
        for (const int u : neighbourhood.around(v)) {
            turn += defects[u];
            if (neighbourhood.away(u, v) < spacing * radius) done[u] = 1;
        }
        if (turn > least_turn) return true;
    }
    return false;
}

}  // namespace fairing
