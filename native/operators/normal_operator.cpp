#include "operators/normal_operator.h"

#include "operators/biharmonic_operator.h"
#include "operators/laplace_operator.h"
#include "operators/split_operator.h"

namespace fairing {

namespace {

// Free vertices. The split operator is analysed and factorised in less time, the assembled one solves in less: at
// 10,000 12 and 39 ms, 4 and 2.4 ms. Repeated solves live on the latter. From 15,000 on the assembled operator's factor
// grows faster (at 100k three times the entries, six times the work).
constexpr int largest_assembled(Solves solves) { return solves == Solves::few ? 2'500 : 15'000; }

}  // namespace

std::unique_ptr<NormalOperator> make_normal_operator(const Problem& problem, Points layout, Solves solves) {
    const Patch& patch = problem.patch;
    if (problem.options.equation == Equation::soap_film)
        return std::make_unique<LaplaceOperator>(patch, std::move(layout));
    if (patch.free_count <= largest_assembled(solves))
        return std::make_unique<BiharmonicOperator>(patch, std::move(layout));
    return std::make_unique<SplitBiharmonicOperator>(patch, problem.fixed_points, std::move(layout));
}

}  // namespace fairing
