// What a surface between several outlines has that an artist would undo, and that the shape before has not.
#pragma once

#include <optional>

#include "base/progress.h"
#include "method/girths.h"
#include "problem/problem.h"
#include "start/protrusions.h"

namespace fairing {

// Vertices of a patch, each at most once in a list.
struct Blemishes {
    Indices torn;  // of triangles that cross others or are turned over
    Indices bent;  // where |H| is beyond twice the largest on the outline and the largest nearby before
    // Of waists and threads: less than three quarters as long around, or flat and less than 0.94 as wide
    // (method/girths).
    Indices narrow;
    Indices wide;  // of bulges: more than four thirds as long
    Indices thin;  // of what ends within the patch, where it is there still: less than 0.7 as blunt (start/protrusions)

    [[nodiscard]] bool absent() const { return all().empty(); }
    // One after the other; a vertex may be there more than once.
    [[nodiscard]] Indices all() const;
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
    [[nodiscard]] Indices thin(const Points& points) const;

    const Problem& problem_;
    Indices crossing_before_;  // triangles
    Indices turned_before_;
    VectorX bent_before_;  // largest |H| around each vertex
    std::optional<Girths> girths_;
    std::optional<Protrusions> protrusions_;
    VectorX reaches_before_;
    VectorX blunt_before_;
};

}  // namespace fairing
