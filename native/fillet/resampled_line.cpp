// Fewer points on a line that was found on small triangles.
#include <map>

#include "fillet/level_line.h"
#include "fillet/limits.h"
#include "geometry/triangle.h"

namespace fairing {

namespace {

constexpr double straight = 0.02;      // of its length: how far a piece of the line may leave its chord
constexpr double nearly_whole = 1e-9;  // of an edge: pieces as long as two edges are no longer
constexpr int fewest_of_loop = 6;      // points of a line that is closed within one triangle

class Resampling {
public:
    Resampling(const SeamMesh& mesh, const SeamDistance& distance, const LevelLine& line, double spacing,
               const SideNormals& sides)
        : mesh_(mesh), distance_(distance), line_(line), spacing_(spacing), sides_(sides) {}

    LevelLine result() {
        std::multimap<int, int> leaving;  // segments by the point where they begin
        for (int s = 0; s < static_cast<int>(line_.segments.size()); ++s) leaving.emplace(line_.segments[s].from, s);
        std::vector<char> used(line_.segments.size(), 0);
        const auto follow = [&](int s) {
            Indices chain{line_.segments[s].from};
            for (int at = s; at != none;) {
                used[at] = 1;
                const int end = line_.segments[at].to;
                chain.push_back(end);
                at = none;
                if (line_.points[end].bound()) break;
                const auto [first, last] = leaving.equal_range(end);
                for (auto it = first; it != last; ++it) {
                    if (used[it->second] == 0) at = it->second;
                }
            }
            add(chain, line_.segments[s].triangle);
        };
        for (int s = 0; s < static_cast<int>(used.size()); ++s) {
            if (line_.points[line_.segments[s].from].bound()) follow(s);
        }
        for (int s = 0; s < static_cast<int>(used.size()); ++s) {
            if (used[s] == 0) follow(s);
        }
        return made_;
    }

private:
    [[nodiscard]] Vector3 place(int point) const { return line_.points[point].place; }

    int taken(int point) {
        const auto [found, is_new] = number_.try_emplace(point, static_cast<int>(made_.points.size()));
        if (is_new) made_.points.push_back(line_.points[point]);
        return found->second;
    }

    void add(const Indices& chain, int triangle) {
        const int last = static_cast<int>(chain.size()) - 1;
        int begin = 0;
        for (int k = 1; k <= last; ++k) {
            const bool turns = k < last && radians_between(place(chain[k]) - place(chain[k - 1]),
                                                           place(chain[k + 1]) - place(chain[k])) > corner_angle;
            if (k != last && !turns) continue;
            add_piece({chain.begin() + begin, chain.begin() + k + 1}, triangle);
            begin = k;
        }
    }

    void add_piece(const Indices& chain, int triangle) {
        std::vector<double> offset{0.0};  // in spacings
        double length = 0.0;
        double bulge = 0.0;
        const Vector3 chord = place(chain.back()) - place(chain.front());
        for (std::size_t k = 1; k < chain.size(); ++k) {
            const double step = (place(chain[k]) - place(chain[k - 1])).norm();
            length += step;
            offset.push_back(offset.back() + step / spacing_between(chain[k - 1], chain[k], triangle));
            const Vector3 off = place(chain[k]) - place(chain.front());
            const double size = chord.squaredNorm();
            bulge = std::max(bulge, size > 0.0 ? (off - off.dot(chord) / size * chord).norm() : off.norm());
        }
        const bool closed = chain.front() == chain.back();
        auto count = static_cast<int>(std::ceil(offset.back() / longest_edge - nearly_whole));
        if (closed || bulge > straight * length || runs_straight(chain.front(), chain.back(), triangle))
            count = static_cast<int>(std::lround(offset.back()));
        count = std::max(count, 1);
        if (closed) count = std::max(count, fewest_of_loop);
        int from = taken(chain.front());
        std::size_t at = 1;
        for (int k = 1; k < count; ++k) {
            const double wanted = offset.back() * k / count;
            while (at + 1 < offset.size() && offset[at] < wanted) ++at;
            const double share = (wanted - offset[at - 1]) / (offset[at] - offset[at - 1]);
            made_.points.push_back(between(chain[at - 1], chain[at], share, triangle));
            const int to = static_cast<int>(made_.points.size()) - 1;
            made_.segments.push_back({from, to, triangle});
            from = to;
        }
        made_.segments.push_back({from, taken(chain.back()), triangle});
    }

    [[nodiscard]] double spacing_between(int a, int b, int triangle) const {
        return 0.5 * spacing_ *
               (distance_.relative_width(triangle, weights_in(a, triangle)) +
                distance_.relative_width(triangle, weights_in(b, triangle)));
    }

    [[nodiscard]] bool runs_straight(int a, int b, int triangle) const {
        return radians_between(sides_.normal(triangle, weights_in(a, triangle)),
                               sides_.normal(triangle, weights_in(b, triangle))) < straight_angle;
    }

    [[nodiscard]] Vector3 weights_in(int point, int triangle) const {
        const LinePoint& known = line_.points[point];
        if (known.triangle == triangle) return known.weights;
        return barycentric(mesh_.points, mesh_.triangles, triangle, known.place);
    }

    // Moved square to the line until it is on it: chords are not where that is curved.
    [[nodiscard]] LinePoint between(int a, int b, double share, int triangle) const {
        constexpr int most_steps = 4;  // of a fixed point
        const int h = 3 * triangle;
        const Vector3 first = weights_in(a, triangle);
        const Vector3 second = weights_in(b, triangle);
        Vector3 weights = first + share * (second - first);
        const Vector2 offset = mesh_.in_frame(h, second) - mesh_.in_frame(h, first);
        const Vector2 inward = Vector2(-offset[1], offset[0]).normalized();
        for (int step = 0; step < most_steps; ++step) {
            const double value = distance_.value(triangle, weights);
            if (!std::isfinite(value)) break;
            const Vector3 moved = mesh_.weights_at(h, mesh_.in_frame(h, weights) + value * inward);
            if (!(moved.minCoeff() > 0.0)) break;
            weights = moved;
        }
        return {mesh_.place(triangle, weights), none, none, 0.0, triangle, weights};
    }

    const SeamMesh& mesh_;
    const SeamDistance& distance_;
    const LevelLine& line_;
    double spacing_;
    const SideNormals& sides_;
    LevelLine made_;
    std::map<int, int> number_;
};

}  // namespace

LevelLine resampled(const SeamMesh& mesh, const SeamDistance& distance, const LevelLine& line, double spacing,
                    const SideNormals& sides) {
    return Resampling(mesh, distance, line, spacing, sides).result();
}

}  // namespace fairing
