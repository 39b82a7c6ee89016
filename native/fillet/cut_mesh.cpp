#include "fillet/cut_mesh.h"

#include <set>

#include "base/columns.h"
#include "base/progress.h"
#include "fillet/cut_triangle.h"

namespace fairing {

namespace {

Vector3 middle() { return Vector3::Constant(1.0 / 3.0); }

class Cutting {
public:
    Cutting(const SeamMesh& mesh, const SeamDistance& distance, const LevelLine& line)
        : mesh_(mesh), distance_(distance), line_(line), segments_of_(mesh.triangles.cols()) {
        number_points();
        for (int s = 0; s < static_cast<int>(line.segments.size()); ++s)
            segments_of_[line.segments[s].triangle].push_back(s);
    }

    SplitMesh result() {
        for (int t = 0; t < mesh_.triangles.cols(); ++t) {
            checkpoint(t);
            if (is_cut(t))
                cut(t);
            else
                keep(t);
        }
        made_.triangles = as_columns(corners_);
        add_seams();
        for (const LineSegment& segment : line_.segments)
            made_.line.push_back({number_[segment.from], number_[segment.to]});
        return made_;
    }

private:
    void number_points() {
        std::vector<Vector3> places;
        const int first = static_cast<int>(mesh_.points.cols());
        points_on_.resize(1 + (mesh_.edge.empty() ? 0 : *std::max_element(mesh_.edge.begin(), mesh_.edge.end())));
        for (int p = 0; p < static_cast<int>(line_.points.size()); ++p) {
            const LinePoint& point = line_.points[p];
            number_.push_back(point.vertex == none ? first + static_cast<int>(places.size()) : point.vertex);
            if (point.vertex != none) continue;
            places.push_back(point.place);
            if (point.edge != none) points_on_[point.edge].push_back(p);
        }
        for (Indices& on_edge : points_on_) {
            std::sort(on_edge.begin(), on_edge.end(),
                      [&](int a, int b) { return line_.points[a].along < line_.points[b].along; });
        }
        made_.points = as_columns(places);
    }

    void add_seams() {
        for (int h = 0; h < mesh_.half_edge_count(); ++h) {
            const bool parts = mesh_.seam[h] != none || mesh_.twin[h] == none;
            if (!parts || mesh_.tail(h) > mesh_.head(h)) continue;
            int from = mesh_.tail(h);
            for (const int p : points_on_[mesh_.edge[h]]) {
                made_.seams.push_back({from, number_[p]});
                from = number_[p];
            }
            made_.seams.push_back({from, mesh_.head(h)});
        }
    }

    [[nodiscard]] bool is_cut(int t) const {
        if (!segments_of_[t].empty()) return true;
        for (int h = 3 * t; h < 3 * t + 3; ++h) {
            if (!points_on_[mesh_.edge[h]].empty()) return true;
        }
        return false;
    }

    void add(const Eigen::Vector3i& corners, int parent, bool inside) {
        corners_.push_back(corners);
        made_.parent.push_back(parent);
        made_.inside.push_back(inside ? 1 : 0);
    }

    void keep(int t) { add(mesh_.triangles.col(t), t, distance_.reaches(t) && distance_.value(t, middle()) < 0.0); }

    void cut(int t) {
        const int frame = 3 * t;
        CutTriangle pieces(Vector2::Zero(), Vector2(mesh_.length[frame], 0.0), mesh_.apex[frame]);
        Indices number{mesh_.triangles(0, t), mesh_.triangles(1, t), mesh_.triangles(2, t)};
        std::map<int, int> local;
        for (int k = 0; k < 3; ++k) local[number[k]] = k;
        const auto add_point = [&](int p, int made) {
            number.push_back(number_[p]);
            local[number_[p]] = made;
        };
        for (int k = 0; k < 3; ++k) {
            const int h = frame + k;
            Indices on_side = points_on_[mesh_.edge[h]];
            const bool forwards = mesh_.tail(h) < mesh_.head(h);
            if (!forwards) std::reverse(on_side.begin(), on_side.end());
            for (const int p : on_side) {
                const double along = forwards ? line_.points[p].along : 1.0 - line_.points[p].along;
                Vector3 weights = Vector3::Zero();
                weights[k] = 1.0 - along;
                weights[(k + 1) % 3] = along;
                add_point(p, pieces.add_on_side(k, mesh_.in_frame(frame, weights)));
            }
        }
        for (const int s : segments_of_[t]) {
            for (const int p : {line_.segments[s].from, line_.segments[s].to}) {
                const LinePoint& point = line_.points[p];
                if (!point.bound() && !local.contains(number_[p]))
                    add_point(p, pieces.add_inside(mesh_.in_frame(frame, point.weights)));
            }
        }
        pieces.make_delaunay();
        bool along_line = true;
        for (const int s : segments_of_[t]) {
            const LineSegment& segment = line_.segments[s];
            along_line = pieces.add_edge(local.at(number_[segment.from]), local.at(number_[segment.to])) && along_line;
        }
        const std::vector<char> inside = along_line ? sorted_out(t, pieces, local) : sorted_by_middle(t, pieces);
        for (std::size_t k = 0; k < inside.size(); ++k) {
            const auto [a, b, c] = pieces.triangles()[k];
            add({number[a], number[b], number[c]}, t, inside[k] != 0);
        }
    }

    // Which pieces are within the fillet: those on the left of the line, and all that lie with them on one side of it.
    [[nodiscard]] std::vector<char> sorted_out(int t, const CutTriangle& pieces,
                                               const std::map<int, int>& local) const {
        std::vector<char> inside(pieces.triangles().size(), 2);
        Indices open;
        const auto give_side = [&](int piece, char side) {
            if (piece == none || inside[piece] != 2) return;
            inside[piece] = side;
            open.push_back(piece);
        };
        for (const int s : segments_of_[t]) {
            const int a = local.at(number_[line_.segments[s].from]);
            const int b = local.at(number_[line_.segments[s].to]);
            give_side(pieces.at(a, b), 1);
            give_side(pieces.at(b, a), 0);
        }
        if (open.empty()) give_side(0, distance_.reaches(t) && distance_.value(t, middle()) < 0.0 ? 1 : 0);
        while (!open.empty()) {
            const int piece = open.back();
            open.pop_back();
            const auto& corners = pieces.triangles()[piece];
            for (std::size_t k = 0; k < 3; ++k) {
                const int a = corners[k];
                const int b = corners[(k + 1) % 3];
                if (!pieces.is_held(a, b)) give_side(pieces.at(b, a), inside[piece]);
            }
        }
        return inside;
    }

    // The same where the line could not be followed: each piece by itself.
    [[nodiscard]] std::vector<char> sorted_by_middle(int t, const CutTriangle& pieces) const {
        std::vector<char> inside;
        for (const auto& [a, b, c] : pieces.triangles()) {
            const Vector2 at = (pieces.place(a) + pieces.place(b) + pieces.place(c)) / 3.0;
            inside.push_back(distance_.value(t, mesh_.weights_at(3 * t, at)) < 0.0 ? 1 : 0);
        }
        return inside;
    }

    const SeamMesh& mesh_;
    const SeamDistance& distance_;
    const LevelLine& line_;
    std::vector<Indices> segments_of_;
    std::vector<Indices> points_on_;
    Indices number_;
    std::vector<Eigen::Vector3i> corners_;
    SplitMesh made_;
};

}  // namespace

SplitMesh cut_along(const SeamMesh& mesh, const SeamDistance& distance, const LevelLine& line) {
    return Cutting(mesh, distance, line).result();
}

}  // namespace fairing
