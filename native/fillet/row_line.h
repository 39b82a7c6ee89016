// The points of a fillet's line that quads in rows need, for a cut along it.
#pragma once

#include <map>

#include "fillet/row_strips.h"

namespace fairing {

// A vertex of the mesh on the way over walls, or a new point on one of their edges.
struct WallPoint {
    int vertex;     // or `none`:
    int half_edge;  // on it,
    double along;   // as a share of 1
};

class RowLine {
public:
    // Keeps references to the arguments.
    RowLine(const SeamMesh& mesh, const SeamWalks& walks, const LevelLine& line, const std::vector<char>& must)
        : mesh_(mesh), walks_(walks), line_(line), must_(must) {}

    void add(const Spot& spot) { chosen_[key(spot)] = none; }
    // The way in `parts` edges over walls from a point of the line to a vertex, which is not among them. Throws NoRows.
    [[nodiscard]] std::vector<WallPoint> wall_way(const Spot& spot, int vertex, int parts) const;
    // Numbers the points: those of the mesh stay, others follow. New ones on walls come last.
    void number();
    [[nodiscard]] int vertex(const Spot& spot) const { return chosen_.at(key(spot)); }
    int add(const WallPoint& point);

    [[nodiscard]] const LevelLine& line() const { return made_; }
    [[nodiscard]] bool is_must(const Spot& spot) const { return spot.point != none && must_[spot.point] != 0; }
    // On edges that nothing outside asks for, and in no column.
    [[nodiscard]] Indices dropped() const;
    [[nodiscard]] Vector3 place(const WallPoint& point) const;
    [[nodiscard]] Vector3 place(int vertex) const;
    [[nodiscard]] int vertex_count() const { return static_cast<int>(mesh_.points.cols() + std::ssize(new_)); }

private:
    using Key = std::array<double, 4>;  // a point, or a segment and a place
    static Key key(const Spot& spot) {
        if (spot.point != none) return {-1.0 - spot.point, 0.0, 0.0, 0.0};
        return {static_cast<double>(spot.segment), spot.place[0], spot.place[1], spot.place[2]};
    }
    int push(const LinePoint& point);
    [[nodiscard]] std::vector<Key> within(int segment) const;

    const SeamMesh& mesh_;
    const SeamWalks& walks_;
    const LevelLine& line_;
    const std::vector<char>& must_;
    std::map<Key, int> chosen_;
    std::map<std::pair<int, double>, int> on_walls_;
    Indices own_;  // of each point of the line that stays: its number; `none`
    LevelLine made_;
    Indices vertices_;  // of the points that were made
    Indices new_;       // and those of them that are no vertices of the mesh
};

}  // namespace fairing
