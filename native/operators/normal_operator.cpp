#include "operators/normal_operator.h"

#include "operators/biharmonic_operator.h"
#include "operators/laplace_operator.h"
#include "operators/split_operator.h"

namespace fairing {

namespace {

// Free vertices. Up to some 15,000 both take the same time, but a solve with the assembled operator is cheaper, which
// repeated solves live on; from there on its factor grows faster (at 100k three times the entries, six times the work).
constexpr int largest_assembled = 15'000;

}  // namespace

std::unique_ptr<NormalOperator> make_normal_operator(const Problem& problem, Points layout) {
    const Patch& patch = problem.patch;
    if (problem.options.equation == Equation::minimal)
        return std::make_unique<LaplaceOperator>(patch, std::move(layout));
    if (patch.free_count <= largest_assembled) return std::make_unique<BiharmonicOperator>(patch, std::move(layout));
    return std::make_unique<SplitBiharmonicOperator>(patch, problem.fixed_points, std::move(layout));
}

}  // namespace fairing
