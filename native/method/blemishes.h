// What a surface between several outlines has that an artist would undo, and that the shape before has not.
#pragma once

#include <optional>

#include "base/progress.h"
#include "problem/problem.h"
#include "start/girth.h"

namespace fairing {

// Vertices of a patch, each at most once in a list.
struct Blemishes {
    Indices torn;    // of triangles that cross others or are turned over
    Indices bent;    // where |H| is beyond twice the largest on the outline and the largest nearby before
    Indices narrow;  // of waists and threads: less than half as long around as the shortest before and the outline

    [[nodiscard]] bool absent() const { return torn.empty() && bent.empty() && narrow.empty(); }
};

// Finds them by comparison with one shape.
class BlemishFinder {
public:
    // `before`: 3 × local vertices, over the problem's outline.
    BlemishFinder(const Problem& problem, const Points& before, const Progress& progress);

    [[nodiscard]] Blemishes in(const Points& points) const;

private:
    [[nodiscard]] Indices torn(const Points& points) const;
    [[nodiscard]] Indices bent(const Points& points) const;
    [[nodiscard]] Indices narrow(const Points& points) const;

    const Problem& problem_;
    Indices crossing_before_;  // triangles
    Indices turned_before_;
    VectorX bent_before_;  // largest |H| around each vertex
    std::optional<CrossSections> sections_;
    VectorX girth_before_;  // shortest cross-section around each outline
};

}  // namespace fairing
