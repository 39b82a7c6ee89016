#include "factor.h"

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCholesky>

#include <stdexcept>

namespace {

using Ldlt = Eigen::SimplicialLDLT<SparseMatrix>;
using Cholmod = Eigen::CholmodSupernodalLLT<SparseMatrix>;

template <class Solver>
void check(const Solver& solver) {
    if (solver.info() != Eigen::Success) {
        throw std::runtime_error("the factorisation failed");
    }
}

}  // namespace

struct Factor::Solvers {
    std::unique_ptr<Ldlt> ldlt;
    std::unique_ptr<Cholmod> cholmod;
};

Factor::Factor(const SparseMatrix& matrix, Method method) : solvers_(std::make_unique<Solvers>()) {
    if (method == Method::ldlt) {
        solvers_->ldlt = std::make_unique<Ldlt>(matrix);
        check(*solvers_->ldlt);
        return;
    }
    solvers_->cholmod = std::make_unique<Cholmod>();
    auto& settings = solvers_->cholmod->cholmod();
    settings.nmethods = 1;
    settings.method[0].ordering = CHOLMOD_METIS;
    solvers_->cholmod->compute(matrix);
    check(*solvers_->cholmod);
    if (settings.selected != 0 || settings.method[0].ordering != CHOLMOD_METIS) {
        throw std::runtime_error("CHOLMOD did not order by METIS");
    }
}

Factor::~Factor() = default;

Points Factor::solve(const Points& load) const {
    const Eigen::MatrixXd columns = load;
    return solvers_->ldlt ? Points(solvers_->ldlt->solve(columns)) : Points(solvers_->cholmod->solve(columns));
}
