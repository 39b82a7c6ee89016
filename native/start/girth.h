// How thick a surface is between its outlines.
#pragma once

#include <optional>
#include <vector>

#include "base/progress.h"
#include "mesh/patch.h"
#include "start/level_lines.h"

namespace fairing {

// Cross-sections of a patch around each of its outlines: level lines of the function that is harmonic on equilateral
// triangles, 1 on that outline and 0 on the others. The lines belong to the connectivity, so that those of several
// surfaces of one patch can be compared.
class CrossSections {
public:
    // Nothing with fewer than two outlines.
    static std::optional<CrossSections> of(const Patch& patch, const Progress& progress);

    [[nodiscard]] int outline_count() const { return static_cast<int>(levels_.size()); }
    // Lengths of the lines around one outline on a surface (3 × local vertices), from the others towards it.
    [[nodiscard]] VectorX lengths(int outline, const Points& points) const;
    // How far apart two places of each line are, as far as two steps find the farthest: from the middle to the first,
    // from there to the second. Noise hardly adds to it, as it does to the length.
    [[nodiscard]] VectorX widths(int outline, const Points& points) const;
    // The triangles that a line around an outline runs through.
    [[nodiscard]] Indices triangles(int outline, int line) const;

private:
    explicit CrossSections(const Patch& patch) : patch_(patch) {}

    [[nodiscard]] std::vector<LevelPiece> pieces(int outline, int line, const Points& points) const;

    const Patch& patch_;
    std::vector<VectorX> levels_;  // of all vertices, for each outline
};

}  // namespace fairing
