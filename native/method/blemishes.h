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
    // Whether a cross-section's middle is farther from where it was than half its radius: webs between limbs, dents.
    // Smoothing may move it so, a surface that knows nothing of the shape before should not.
    [[nodiscard]] bool lies_aside(const Points& points) const;

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

// A finder for the shape that a problem's patch had. It is made when it is first asked for, which takes as long as a
// solve between the outlines, and kept.
class BlemishSearch {
public:
    BlemishSearch(const Problem& problem, const Progress& progress) : problem_(problem), progress_(progress) {}

    // Nothing for one outline, or where no shape before is known.
    [[nodiscard]] const BlemishFinder* finder();
    // Whether a surface has blemishes, or lies aside of the shape before, so that smoothing that is worth trying.
    [[nodiscard]] bool is_blemished(const Points& points);

private:
    const Problem& problem_;
    const Progress& progress_;
    bool asked_ = false;
    std::optional<BlemishFinder> finder_;
};

}  // namespace fairing
