#include "fillet/face_trimming.h"

#include <set>

#include <Eigen/Geometry>

#include "fillet/cut_triangle.h"

namespace fairing {

namespace {

constexpr double roundoff = 1e-7;  // of a section's chord: places that near are one

VertexPair sorted_pair(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

// The parts of a plane face between chains of its edges and sections.
class Trimming {
public:
    // Sections in one plane; new places have numbers from each one's first on. Keeps references.
    Trimming(const EndFaces& faces, const std::vector<EndSection*>& sections, int next)
        : faces_(faces), sections_(sections), next_(next) {
        const EndSection& first = *sections.front();
        origin_ = faces.place(first.chain.front());
        x_ = faces.place(first.chain.back()) - origin_;
        near_ = roundoff * x_.norm();
        x_.normalize();
        y_ = first.plane.cross(x_);
        for (const EndSection* section : sections) {
            Indices& arc = arcs_.emplace_back(section->numbers());
            passed_.insert({arc.front(), arc.back()});
            for (std::size_t k = 1; k + 1 < arc.size(); ++k) at_[arc[k]] = flattened(section->places[k]);
        }
    }

    // Or the place among the sections of one that leaves the face.
    std::variant<FaceChange, std::size_t> result() {
        for (std::size_t s = 0; s < arcs_.size(); ++s) gather(s);
        for (const int t : near_triangles_) find_sides(t);
        for (std::size_t s = 0; s < arcs_.size(); ++s) cross(s);
        std::optional<std::size_t> bad;
        for (std::size_t s = 0; !bad && s < arcs_.size(); ++s)
            if (!locate(s)) bad = s;
        for (std::size_t n = 0; !bad && n < near_triangles_.size(); ++n) bad = cut(near_triangles_[n]);
        if (!bad) bad = drop();
        if (bad) return *bad;
        return made_;
    }

private:
    [[nodiscard]] Vector2 flattened(const Vector3& place) const {
        return {(place - origin_).dot(x_), (place - origin_).dot(y_)};
    }

    Vector2 at(int vertex) {
        const auto [found, is_new] = at_.try_emplace(vertex);
        if (is_new) found->second = flattened(faces_.place(vertex));
        return found->second;
    }

    // The face's triangles near a section.
    void gather(std::size_t s) {
        const Indices& chain = sections_[s]->chain;
        Eigen::AlignedBox2d box;
        for (const int v : chain) box.extend(at(v));
        for (const int v : arcs_[s]) box.extend(at(v));
        std::set<int> known;
        Indices open;
        const auto reach = [&](int from, int to) {
            const int piece = faces_.at(to, from);
            if (piece == none) return;
            const int t = faces_.parent(piece);
            if (faces_.is_whole(t) && faces_.lies_in(t, x_.cross(y_), origin_) && known.insert(t).second)
                open.push_back(t);
        };
        for (std::size_t k = 1; k < chain.size(); ++k) reach(chain[k - 1], chain[k]);
        while (!open.empty()) {
            const int t = open.back();
            open.pop_back();
            if (std::ranges::find(near_triangles_, t) == near_triangles_.end()) near_triangles_.push_back(t);
            const Indices border = faces_.border(t);
            Eigen::AlignedBox2d own;
            for (const int v : border) own.extend(at(v));
            if (!own.intersects(box)) continue;
            for (std::size_t k = 0; k < border.size(); ++k) reach(border[k], border[(k + 1) % border.size()]);
        }
    }

    void find_sides(int t) {
        const EndFaces::Corners corners = faces_.corners_given(t);
        const Indices border = faces_.border(t);
        std::size_t k = 0;
        for (const int v : border) {
            vertices_.insert(v);
            if (v == corners[(k + 1) % 3]) ++k;
            if (v == corners[k % 3]) continue;
            const VertexPair edge = sorted_pair(corners[k], corners[(k + 1) % 3]);
            const double along = (at(v) - at(edge[0])).norm() / (at(edge[1]) - at(edge[0])).norm();
            if (edges_.contains(edge)) continue;
            on_edge_[edge].emplace_back(along, v);
        }
        for (int c = 0; c < 3; ++c) edges_.insert(sorted_pair(corners[c], corners[(c + 1) % 3]));
    }

    // How far a place lies to the left of a line.
    static double aside(const Vector2& from, const Vector2& to, const Vector2& place) {
        return cross2((to - from).normalized(), place - from);
    }
    [[nodiscard]] bool is_between(const Vector2& from, const Vector2& to, const Vector2& place) const {
        const double along = (to - from).normalized().dot(place - from);
        return std::abs(aside(from, to, place)) < near_ && along > -near_ && along < (to - from).norm() + near_;
    }

    // Where a section passes edges and vertices, which become its own.
    void cross(std::size_t s) {
        Indices& arc = arcs_[s];
        std::vector<FaceChange::PathPoint>& path = made_.paths.emplace_back();
        for (const int v : vertices_) {
            for (std::size_t k = 0; k + 1 < arc.size() && !passed_.contains(v); ++k) {
                const Vector2 from = at(arc[k]);
                const Vector2 to = at(arc[k + 1]);
                if (!is_between(from, to, at(v))) continue;
                passed_.insert(v);
                const bool at_first = k > 0 && (at(v) - from).norm() < near_;
                const bool at_second = k + 2 < arc.size() && (at(v) - to).norm() < near_;
                if (at_first || at_second)
                    arc[at_first ? k : k + 1] = v;
                else
                    path.push_back({static_cast<double>(k) + (at(v) - from).norm() / (to - from).norm(), v});
            }
        }
        for (std::size_t k = 0; k < arc.size(); ++k) path.push_back({static_cast<double>(k), arc[k]});
        for (const VertexPair& edge : edges_) cross(edge, s, path);
        std::sort(path.begin(), path.end());
    }

    // How far to the left of a piece's chord the section is, by its normals: a vertex on the chord would bend the
    // surface.
    [[nodiscard]] double rise(std::size_t s, std::size_t k, const Vector2& chord, double share) const {
        const auto slope = [&](const Vector3& normal) {
            const Vector2 flat(normal.dot(x_), normal.dot(y_));
            return -flat.dot(chord) / cross2(chord, flat) * chord.norm() * share * (1.0 - share);
        };
        return (1.0 - share) * slope(sections_[s]->normals[k]) - share * slope(sections_[s]->normals[k + 1]);
    }

    void cross(const VertexPair& edge, std::size_t s, std::vector<FaceChange::PathPoint>& path) {
        const Indices& arc = arcs_[s];
        const Vector2 a = at(edge[0]);
        const Vector2 b = at(edge[1]);
        const double length = (b - a).norm();
        std::vector<std::pair<double, int>>& found = on_edge_[edge];
        for (std::size_t k = 0; k + 1 < arc.size(); ++k) {
            const Vector2 from = at(arc[k]);
            const Vector2 to = at(arc[k + 1]);
            if (k > 0 && !passed_.contains(arc[k]) && is_between(a, b, from)) {
                found.emplace_back((from - a).norm() / length, arc[k]);
                bound_.insert(arc[k]);
            }
            const std::array<double, 4> off{aside(a, b, from), aside(a, b, to), aside(from, to, a), aside(from, to, b)};
            const bool touches = std::ranges::any_of(off, [&](double each) { return std::abs(each) <= near_; });
            if (touches || off[0] * off[1] > 0.0 || off[2] * off[3] > 0.0) continue;
            const double share = off[0] / (off[0] - off[1]);
            const Vector2 chord = to - from;
            const double along = rise(s, k, chord, share) * chord.norm() / cross2(chord, b - a);
            Vector2 place = from + share * chord;
            if (std::abs(along) * length < 0.5 * chord.norm()) place += along * (b - a);  // NaN stays out
            made_.added.emplace_back(origin_ + place[0] * x_ + place[1] * y_);
            path.push_back({static_cast<double>(k) + share, next_});
            at_[next_] = place;
            found.emplace_back((place - a).norm() / length, next_++);
        }
    }

    // The triangle that holds a place, or `none`.
    int holder(const Vector2& place) {
        int best = none;
        double deepest = -near_;
        for (const int t : near_triangles_) {
            const auto [a, b, c] = faces_.corners_given(t);
            const double depth =
                std::min({aside(at(a), at(b), place), aside(at(b), at(c), place), aside(at(c), at(a), place)});
            if (depth > deepest) {
                deepest = depth;
                best = t;
            }
        }
        return best;
    }

    bool locate(std::size_t s) {
        const auto& path = made_.paths[s];
        for (std::size_t k = 1; k < path.size(); ++k) {
            const int t = holder(0.5 * (at(path[k - 1].vertex) + at(path[k].vertex)));
            if (t == none) return false;
            paths_[t].push_back({path[k - 1].vertex, path[k].vertex, s});
            held_.insert(sorted_pair(path[k - 1].vertex, path[k].vertex));
        }
        for (std::size_t k = 1; k + 1 < arcs_[s].size(); ++k) {
            const int v = arcs_[s][k];
            if (passed_.contains(v) || bound_.contains(v)) continue;
            const int t = holder(at(v));
            if (t == none) return false;
            within_[t].push_back(v);
        }
        return true;
    }

    // Or the section that could not be followed.
    std::optional<std::size_t> cut(int t) {
        const EndFaces::Corners corners = faces_.corners_given(t);
        CutTriangle pieces(at(corners[0]), at(corners[1]), at(corners[2]));
        Indices number(corners.begin(), corners.end());
        std::map<int, int> local{{corners[0], 0}, {corners[1], 1}, {corners[2], 2}};
        for (int k = 0; k < 3; ++k) {
            const int from = corners[k];
            const int to = corners[(k + 1) % 3];
            std::vector<std::pair<double, int>> points = on_edge_[sorted_pair(from, to)];
            std::sort(points.begin(), points.end());
            if (from > to) std::reverse(points.begin(), points.end());
            for (const auto& [along, vertex] : points) {
                local[vertex] = pieces.add_on_side(k, at(vertex));
                number.push_back(vertex);
            }
        }
        for (const int vertex : within_[t]) {
            local[vertex] = pieces.add_inside(at(vertex));
            number.push_back(vertex);
        }
        if (number.size() > 3) pieces.make_delaunay();
        for (const auto& [from, to, s] : paths_[t]) {
            if (!local.contains(from) || !local.contains(to) || !pieces.add_edge(local.at(from), local.at(to)))
                return s;
        }
        for (const auto& [a, b, c] : pieces.triangles()) {
            made_.pieces.push_back({number[a], number[b], number[c]});
            made_.parents.push_back(t);
        }
        made_.gone.push_back(t);
        return std::nullopt;
    }

    // The pieces between the chains and the sections. Or a section that does not bound them.
    std::optional<std::size_t> drop() {
        std::map<VertexPair, int> sides;
        for (int p = 0; p < static_cast<int>(made_.pieces.size()); ++p) {
            const auto [a, b, c] = made_.pieces[p];
            for (const VertexPair& side : {VertexPair{a, b}, {b, c}, {c, a}}) sides[side] = p;
        }
        std::vector<char> dropped(made_.pieces.size(), 0);
        Indices open;
        const auto reach = [&](int from, int to) {
            const auto found = sides.find({from, to});
            if (found == sides.end()) return false;
            if (std::exchange(dropped[found->second], 1) == 0) open.push_back(found->second);
            return true;
        };
        for (std::size_t s = 0; s < sections_.size(); ++s) {
            const Indices& chain = sections_[s]->chain;
            for (std::size_t k = 1; k < chain.size(); ++k) {
                held_.insert(sorted_pair(chain[k - 1], chain[k]));
                if (!reach(chain[k], chain[k - 1])) return s;
            }
            while (!open.empty()) {
                const auto [a, b, c] = made_.pieces[open.back()];
                open.pop_back();
                for (const auto& [from, to] : {VertexPair{a, b}, {b, c}, {c, a}}) {
                    if (!held_.contains(sorted_pair(from, to)) && !reach(to, from)) return s;
                }
            }
        }
        std::size_t kept = 0;
        for (std::size_t p = 0; p < dropped.size(); ++p) {
            if (dropped[p] != 0) continue;
            made_.pieces[kept] = made_.pieces[p];
            made_.parents[kept++] = made_.parents[p];
        }
        made_.pieces.resize(kept);
        made_.parents.resize(kept);
        return std::nullopt;
    }

    struct Path {
        int from, to;
        std::size_t section;
    };
    const EndFaces& faces_;
    const std::vector<EndSection*>& sections_;
    int next_;
    Vector3 origin_, x_, y_;
    double near_;
    std::vector<Indices> arcs_;
    std::map<int, Vector2> at_;
    Indices near_triangles_;
    std::set<int> vertices_, passed_, bound_;  // of the face; on a section; of a section, on an edge
    std::set<VertexPair> edges_, held_;
    std::map<VertexPair, std::vector<std::pair<double, int>>> on_edge_;  // from its smaller vertex
    std::map<int, std::vector<Path>> paths_;                             // of each triangle
    std::map<int, Indices> within_;
    FaceChange made_;
};

}  // namespace

std::variant<FaceChange, std::size_t> trimmed(const EndFaces& faces, const std::vector<EndSection*>& sections,
                                              int next) {
    return Trimming(faces, sections, next).result();
}

}  // namespace fairing
