#include "fillet/level_line.h"

#include <map>
#include <set>

#include "base/limits.h"
#include "base/progress.h"
#include "fillet/halved_mesh.h"

namespace fairing {

namespace {

class Marching {
public:
    Marching(const SeamMesh& mesh, const SeamDistance& distance, const HalvedMesh& halves)
        : mesh_(mesh), distance_(distance), halves_(halves) {}

    LevelLine line() {
        const auto& pieces = halves_.pieces();
        for (int p = 0; p < static_cast<int>(pieces.size()); ++p) {
            checkpoint(p);
            int from = none;
            int to = none;
            for (int k = 0; k < 3; ++k) {
                const bool inside = is_inside(pieces[p].nodes[k]);
                if (inside == is_inside(pieces[p].nodes[(k + 1) % 3])) continue;
                (inside ? from : to) = crossing(p, k);
            }
            if (from != to) line_.segments.push_back({from, to, pieces[p].triangle});
        }
        remove_touches();
        return line_;
    }

private:
    [[nodiscard]] bool is_inside(int node) const { return halves_.nodes()[node].value < 0.0; }

    // The point on a side of a piece, found once for both pieces there.
    int crossing(int p, int k) {
        const HalvedMesh::Piece& piece = halves_.pieces()[p];
        const int next = (k + 1) % 3;
        const bool begins_inside = is_inside(piece.nodes[k]);
        const int outer = begins_inside ? next : k;
        const HalvedMesh::Node& outside = halves_.nodes()[piece.nodes[outer]];
        const bool at_node = outside.value == 0.0;
        const auto [a, b] = std::minmax(piece.nodes[k], piece.nodes[next]);
        const std::array<int, 2> key = at_node ? std::array{piece.nodes[outer], piece.nodes[outer]} : std::array{a, b};
        const auto [found, is_new] = number_.try_emplace(key, static_cast<int>(line_.points.size()));
        if (!is_new) return found->second;
        if (at_node) {
            line_.points.push_back(
                {outside.place, outside.vertex, outside.edge, 0.0, piece.triangle, piece.weights[outer]});
        } else {
            const int inner = begins_inside ? k : next;
            const Vector3 ray = piece.weights[outer] - piece.weights[inner];
            const Vector3 weights = piece.weights[inner] + root(piece.triangle, piece.weights[inner], ray) * ray;
            line_.points.push_back(
                {mesh_.place(piece.triangle, weights), none, piece.edges[k], 0.0, piece.triangle, weights});
        }
        set_along(line_.points.back());
        return found->second;
    }

    void set_along(LinePoint& point) const {
        if (point.edge == none) return;
        int h = 3 * point.triangle;
        while (mesh_.edge[h] != point.edge) ++h;
        point.along = point.weights[(mesh_.tail(h) < mesh_.head(h) ? h + 1 : h) % 3];
    }

    // As a share of a ray from the node inside. Regula falsi that halves the end's value that stays (Dowell &
    // Jarratt 1971), and the interval where that is infinite.
    [[nodiscard]] double root(int triangle, const Vector3& inside, const Vector3& ray) const {
        const auto at = [&](double share) { return distance_.value(triangle, inside + share * ray); };
        double low = 0.0;
        double high = 1.0;
        double below = at(0.0);
        double above = at(1.0);
        for (int step = 0; step < most_iterations && high - low > roundoff; ++step) {
            const bool secant = std::isfinite(above) && step % 3 != 2;
            const double share = secant ? low + (high - low) * below / (below - above) : 0.5 * (low + high);
            const double found = at(share);
            if (found == 0.0) return share;
            (found < 0.0 ? low : high) = share;
            (found < 0.0 ? below : above) = found;
        }
        return std::abs(below) < std::abs(above) ? low : high;
    }

    // Where the fillet is on both sides of a segment it does not end.
    void remove_touches() {
        std::set<std::array<int, 2>> known;
        for (const LineSegment& segment : line_.segments) known.insert({segment.from, segment.to});
        std::erase_if(line_.segments,
                      [&](const LineSegment& segment) { return known.contains({segment.to, segment.from}); });
    }

    const SeamMesh& mesh_;
    const SeamDistance& distance_;
    const HalvedMesh& halves_;
    LevelLine line_;
    std::map<std::array<int, 2>, int> number_;
};

}  // namespace

LevelLine level_line(const SeamMesh& mesh, const SeamDistance& distance, double resolution, double snap) {
    constexpr double node_snap = 1e-7;  // of the resolution: nodes on the line but for roundoff
    HalvedMesh halves(mesh, distance, resolution);
    halves.snap(snap, node_snap * resolution);
    return Marching(mesh, distance, halves).line();
}

}  // namespace fairing
