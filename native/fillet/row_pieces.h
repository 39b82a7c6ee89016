// The rows of one band laid, with triangles at their ends.
#pragma once

#include "fillet/row_strip.h"

namespace fairing {

class RowPieces {
public:
    // Keeps references. `owner`: of the paths over the surface at which rows end.
    RowPieces(RowColumns& columns, RowSurface& surface, int rows, RowStrip& strip, int owner)
        : columns_(columns), surface_(surface), rows_(rows), strip_(strip), owner_(owner) {}

    // Throws NoRows where none fit, or one would be bad.
    void lay();

private:
    // From some vertices on to others.
    struct Piece {
        std::array<Pair, 2> outer;
        std::array<RowEnd, 2> ends;
    };
    void lay(Piece piece);
    void add(const std::vector<Column>& columns);
    [[nodiscard]] std::array<Pair, 2> bounds(Piece& piece) const;
    [[nodiscard]] bool is_whole_wall(const Piece& piece, int which) const;
    bool add_end(const Column& last, const Piece& piece, int which);
    [[nodiscard]] Indices beyond(const Column& last, const Piece& piece, int which, const Indices& path) const;

    RowColumns& columns_;
    RowSurface& surface_;
    int rows_;
    RowStrip& strip_;
    int owner_;
};

}  // namespace fairing
