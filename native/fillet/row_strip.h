// The rows of one band: columns of vertices across it.
#pragma once

#include "fillet/bands.h"
#include "fillet/row_surface.h"

namespace fairing {

// How a strip ends: in a corner's quads; in a chain over walls; or in triangles, where those of the surface go on.
enum class RowEnd { corner, wall, open };

// A vertex on each side.
using Pair = std::array<int, 2>;

struct Column {
    Pair at;         // by their places on the sides
    double station;  // along the seam
    Indices ids;     // from the right to the left
};

struct RowStrip {
    const SeamArc* arc;
    std::array<BandSide, 2> sides;
    double width;  // the least
    bool closed = false;
    std::array<RowEnd, 2> ends{RowEnd::open, RowEnd::open};
    std::array<Indices, 2> walls;  // from the right to the left
    std::array<Column, 2> last;    // columns where it comes to corners
    std::vector<Quad> quads;
    std::vector<Eigen::Vector3i> triangles;  // where rows end
    std::vector<VertexPair> edges;           // of the surface where its triangles go on

    [[nodiscard]] Pair first_pair() const { return {0, 0}; }
    [[nodiscard]] Pair last_pair() const;
    void turn_to(const Pair& at);  // a closed one begins there
};

// A closed band begins where its seam turns or an edge outside comes to it, on both sides at one place of the seam.
RowStrip strip_of(const SeamMesh& mesh, const Band& band, const std::vector<char>& must);

// Triangles of vertices by place along and across, counter-clockwise where across is on the left of along.
void add_quads(const std::vector<Indices>& grid, std::vector<Quad>& quads);

class RowColumns {
public:
    // Keeps references. `must`: of each vertex of the border, whether an edge outside needs it. `rows`: across, even.
    RowColumns(const SeamMesh& mesh, const std::vector<char>& must, int rows, RowSurface& surface)
        : mesh_(mesh), must_(must), rows_(rows), surface_(surface) {}

    // From one pair to another one, where edges outside, turns of the seam and the surface's shape ask for them.
    // `given`: the first and the last one, or empty.
    std::vector<Column> columns(const RowStrip& strip, const Pair& first, const Pair& last,
                                const std::array<Indices, 2>& given = {});
    // As on the seam, `station` along it.
    void lift(int vertex, const SeamArc& arc, double station);

private:
    struct Crossing {
        Pair at;
        double station;
    };
    [[nodiscard]] Vector3 on_seam(const SeamArc& arc, double station, int& half_edge) const;
    Column column(const RowStrip& strip, const Crossing& crossing);
    [[nodiscard]] int nearest(const RowStrip& strip, Side which, double station) const;
    struct Turn {
        double station, angle;
    };
    [[nodiscard]] std::vector<Turn> turns(const SeamArc& arc, double from) const;
    [[nodiscard]] static double over_turn(double station, const std::vector<Turn>& turns, double width);
    [[nodiscard]] std::vector<Crossing> wanted(const RowStrip& strip, const Pair& first, const Pair& last,
                                               const std::vector<Turn>& turns) const;
    [[nodiscard]] bool is_clear(const RowStrip& strip, const Crossing& one, const Crossing& two) const;
    [[nodiscard]] std::optional<Crossing> between(const RowStrip& strip, const Column& one, const Column& two) const;
    [[nodiscard]] int half_way(const BandSide& side, int begin, int end) const;
    [[nodiscard]] bool is_bent(const Column& one, const Column& middle, const Column& two, double width) const;

    const SeamMesh& mesh_;
    const std::vector<char>& must_;
    int rows_;
    RowSurface& surface_;
};

}  // namespace fairing
