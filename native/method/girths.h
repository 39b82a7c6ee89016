// How thick a surface between outlines is, compared with the shape before.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "base/progress.h"
#include "start/girth.h"

namespace fairing {

// Each cross-section (start/girth) has two lengths to be compared with: its own on the shape before, and the one that
// the shape's first and last cross-sections make expect there. So neither a swelling that is to go nor a waist counts
// as usual.
class Girths {
public:
    // `before`: 3 × local vertices. Nothing with fewer than two outlines.
    static std::optional<Girths> of(const Patch& patch, const Points& before, const Progress& progress);

    // Triangles of the cross-sections of a surface (3 × local vertices) that are shorter than `share` of both.
    [[nodiscard]] Indices narrow(const Points& points, double share) const;
    // Those of the cross-sections that are flat on the shape before and less wide than `share` of both widths, its own
    // and the expected one: edges of wings that are drawn inwards.
    [[nodiscard]] Indices slim(const Points& points, double share) const;
    // Those of the cross-sections that are longer than both `times` over.
    [[nodiscard]] Indices wide(const Points& points, double times) const;

private:
    explicit Girths(CrossSections sections) : sections_(std::move(sections)) {}

    CrossSections sections_;
    std::vector<VectorX> lesser_;  // of the two lengths, for each outline
    std::vector<VectorX> larger_;
    std::vector<VectorX> slimmer_;  // of the two widths
};

}  // namespace fairing
