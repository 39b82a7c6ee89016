#include "tangential/tangential_step.h"

#include "tangential/row_step.h"

namespace fairing {

std::unique_ptr<TangentialStep> make_tangential_step(const Patch& patch, const Lambda& weights,
                                                     const Points& fixed_points, const Progress& progress) {
    if (const auto* rows = std::get_if<RowWeights>(&weights)) {
        return std::make_unique<RowStep>(patch, *rows, fixed_points, progress);
    }
    return with_edges(patch, weights, [&](const InnerWeights& edges) -> std::unique_ptr<TangentialStep> {
        return std::make_unique<SymmetricStep>(patch, edges, fixed_points, progress);
    });
}

}  // namespace fairing
