#include "quads/tube.h"

#include <set>

namespace fairing {

namespace {

// The hole that is left when a tube is cut. Its boundary: the first loop and its first vertex once more, up the seam,
// the second loop and its first vertex once more, down the seam.
struct CutTube {
    int first;  // edges of the loops,
    int second;
    int rows;   // and of the seam
    int shift;  // where the seam ends on the second loop: so many vertices after its first one

    [[nodiscard]] int size() const { return first + second + 2 * rows; }
    // Numbers in the boundary of the hole, whose new vertices come behind.
    [[nodiscard]] int up(int row) const { return first + row; }                // row 0 … rows
    [[nodiscard]] int down(int row) const { return (size() - row) % size(); }  // likewise
    // The number in the tube's pattern: its loops, then rows − 1 vertices of the seam, then all else.
    [[nodiscard]] int welded(int k) const {
        if (k >= size()) return k - size() + first + second + rows - 1;
        if (k < first) return k;
        if (k == first) return 0;
        if (k < first + rows) return first + second + k - first - 1;
        if (k <= first + rows + second) return first + on_second(k);
        return first + second + size() - k - 1;
    }
    [[nodiscard]] int on_second(int k) const { return (k - up(rows) + shift + second) % second; }
    // By how many turns its angle around the tube, 0 at the seam's side that goes down, is more than that of the
    // vertex that it becomes: the second loop's first vertex has 0, the next one nearly a turn.
    [[nodiscard]] int turns(int k) const {
        if (k >= first && k < first + rows) return 1;
        if (k < first + rows || k > first + rows + second) return 0;
        const int unrolled = k - up(rows) + shift;
        const int at = on_second(k);
        return ((at == 0 ? second : at) - unrolled) / second;
    }
};

HoleBoundary hole_of(const CutTube& cut, const TubeBoundary& tube) {
    const double never = std::numeric_limits<double>::quiet_NaN();  // the number of quads at this angle is fixed
    HoleBoundary hole;
    hole.cells = tube.cells;
    hole.angles = VectorX::Constant(cut.size(), never);
    hole.places.resize(2, cut.size());
    const double width = 0.5 * (cut.first + cut.second);
    for (int k = 0; k <= cut.first; ++k) hole.places.col(k) = Eigen::Vector2d(width * k / cut.first, 0.0);
    for (int k = 1; k < cut.first; ++k) hole.angles[k] = tube.first_angles[k];
    for (int k = 0; k <= cut.second; ++k)
        hole.places.col(cut.up(cut.rows) + k) = Eigen::Vector2d(width * (1.0 - double(k) / cut.second), tube.length);
    for (int k = 1; k < cut.second; ++k)
        hole.angles[cut.up(cut.rows) + k] = tube.second_angles[cut.on_second(cut.up(cut.rows) + k)];
    for (int row = 1; row < cut.rows; ++row) {
        const double height = tube.length * row / cut.rows;
        hole.places.col(cut.up(row)) = Eigen::Vector2d(width, height);
        hole.places.col(cut.down(row)) = Eigen::Vector2d(0.0, height);
    }
    return hole;
}

// Straight but for the seam's ends, where each side has one quad, and for corners of the loops.
Indices faces_of(const CutTube& cut, const HoleBoundary& hole, bool with_corners) {
    Indices faces(static_cast<std::size_t>(cut.size()), 2);
    for (int k = 0; with_corners && k < cut.size(); ++k) {
        if (std::isfinite(hole.angles[k])) faces[k] = std::clamp(int(std::lround(hole.angles[k] / 90.0)), 1, 4);
    }
    for (const int end : {cut.up(0), cut.up(cut.rows), cut.down(0), cut.down(cut.rows)}) faces[end] = 1;
    return faces;
}

QuadPattern welded(const CutTube& cut, const QuadPattern& hole) {
    QuadPattern result;
    result.boundary_count = cut.first + cut.second;
    result.vertex_count = hole.vertex_count - cut.size() + result.boundary_count + cut.rows - 1;
    std::set<std::array<int, 2>> over;
    const auto add = [&](const auto& face, auto& faces) {
        auto numbered = face;
        for (std::size_t k = 0; k < face.size(); ++k) {
            const int next = face[(k + 1) % face.size()];
            numbered[k] = cut.welded(face[k]);
            const int turns = cut.turns(next) - cut.turns(face[k]);
            if (turns > 0) over.insert({numbered[k], cut.welded(next)});
            if (turns < 0) over.insert({cut.welded(next), numbered[k]});
        }
        faces.push_back(numbered);
    };
    for (const auto& quad : hole.quads) add(quad, result.quads);
    for (const auto& triangle : hole.triangles) add(triangle, result.triangles);
    result.over_seam.assign(over.begin(), over.end());
    return result;
}

// A tube that is one edge around, or two, would have an edge twice.
bool is_sound(const QuadPattern& pattern) {
    std::set<std::pair<int, int>> sides;
    const auto fits = [&sides](const auto& face) {
        for (std::size_t k = 0; k < face.size(); ++k) {
            if (!sides.emplace(face[k], face[(k + 1) % face.size()]).second) return false;
        }
        return true;
    };
    return std::all_of(pattern.quads.begin(), pattern.quads.end(), fits) &&
           std::all_of(pattern.triangles.begin(), pattern.triangles.end(), fits);
}

}  // namespace

std::vector<CandidatePattern> tube_patterns(const TubeBoundary& tube, int count) {
    const int first = static_cast<int>(tube.first_angles.size());
    const int second = static_cast<int>(tube.second_angles.size());
    const int rows = std::max(1, static_cast<int>(std::lround(tube.length)));
    std::vector<CandidatePattern> result;
    for (const bool with_corners : {false, true}) {
        for (int more = -1; more <= 1; ++more) {
            for (const int shift : {0, 1, -1}) {
                const CutTube cut{first, second, rows + more, shift};
                if (cut.rows < 1) continue;
                const HoleBoundary hole = hole_of(cut, tube);
                for (CandidatePattern& each : patterns_with_corners(hole, faces_of(cut, hole, with_corners), 2)) {
                    each.pattern = welded(cut, each.pattern);
                    if (is_sound(each.pattern)) result.push_back(std::move(each));
                }
            }
        }
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const CandidatePattern& a, const CandidatePattern& b) { return a.misfit < b.misfit; });
    if (static_cast<int>(result.size()) > count) result.resize(static_cast<std::size_t>(count));
    return result;
}

}  // namespace fairing
