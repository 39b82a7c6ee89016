// What a surface between several boundary loops has that an artist would undo, and that the shape before has not.
#pragma once

#include <optional>

#include "problem/problem.h"
#include "shape/girth.h"

namespace fairing {

// Vertices of a patch, each at most once in a list.
struct Blemishes {
    Indices torn;    // of triangles that cross others or are turned over
    Indices bent;    // where |H| is beyond `sharp_bend` of the largest on the boundary and the largest nearby before
    Indices narrow;  // of cross-sections that are thinner than `waist` of what they come from (shape/limits)
    Indices wide;    // likewise, thicker than `balloon`

    [[nodiscard]] bool absent() const { return all().empty(); }
    // One after the other; a vertex may be there more than once.
    [[nodiscard]] Indices all() const;
};

// Finds them by comparison with one shape. A cross-section (shape/girth) comes from two radii: its own before, and the
// one that the first and the last cross-section before make expect there. So neither a swelling that is to go nor a
// waist counts as usual.
class BlemishFinder {
public:
    // `before`: 3 × local vertices, over the problem's boundary.
    BlemishFinder(const Problem& problem, const Points& before);

    [[nodiscard]] Blemishes in(const Points& points) const;

private:
    [[nodiscard]] Indices torn(const Points& points) const;
    [[nodiscard]] Indices bent(const Points& points) const;
    void add_uneven(const Points& points, Blemishes& found) const;

    const Problem& problem_;
    Indices crossing_before_;  // triangles
    Indices turned_before_;
    VectorX bent_before_;  // largest |H| around each vertex
    std::optional<CrossSections> sections_;
    std::vector<VectorX> lesser_;  // of the two radii, for each loop
    std::vector<VectorX> larger_;
};

}  // namespace fairing
