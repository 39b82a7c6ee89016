// The two direct solvers that others are measured by.
#pragma once

#include "arrays.h"

#include <memory>

enum class Method {
    ldlt,     // Eigen's SimplicialLDLT, approximate minimum degree: what libigl, pmp-library and MeshLib use
    cholmod,  // SuiteSparse's supernodal Cholesky, nested dissection by METIS
};

// A factorisation of a symmetric positive definite matrix. Throws std::runtime_error where that fails.
class Factor {
public:
    Factor(const SparseMatrix& matrix, Method method);
    ~Factor();
    Points solve(const Points& load) const;

private:
    struct Solvers;
    std::unique_ptr<Solvers> solvers_;
};
