// The engine's sparse Cholesky factorisation beside others, on the matrix that it is for: K = S_I (4M)⁻¹ S_Iᵀ of a
// jittered part of a sphere. CPU seconds on one thread: the first factorisation with its ordering, one more with other
// values, a solve; and the largest error of that solve.
//
//     factorisations [FREE_VERTICES…]    # default: 25000 100000

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <stdexcept>
#include <vector>

#include <Eigen/SparseCholesky>
#ifdef WITH_CHOLMOD
#include <Eigen/CholmodSupport>
#endif

#include "linear/sparse_cholesky.h"
#include "meshes.h"

using namespace fairing;

namespace {

constexpr int rounds = 3;  // the least of so many counts

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct System {
    SparseMatrix lower;
    Points layout;  // 3 × free
};

SparseMatrix rows_of_stiffness(const Patch& patch, const Stiffness& stiffness) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < patch.free_count; ++i) {
        entries.emplace_back(i, i, stiffness.diagonal(patch, i));
        const RingView ring = patch.ring(i);
        for (std::size_t k = 0; k < ring.valence(); ++k) {
            entries.emplace_back(i, ring.vertices[k], -stiffness.weights[ring.spokes[k]]);
        }
    }
    SparseMatrix rows(patch.free_count, patch.vertex_count());
    rows.setFromTriplets(entries.begin(), entries.end());
    return rows;
}

System make_system(int free_count) {
    const int n = static_cast<int>(std::lround(std::sqrt(free_count))) + 1;
    const test::Single single = test::single_patch(test::grid(n, 0.3, test::sphere));
    const Patch& patch = single.patch();
    const Stiffness stiffness = test::stiffness_of(single);
    const SparseMatrix rows = rows_of_stiffness(patch, stiffness);
    const VectorX inverse = (4.0 * stiffness.mass).cwiseInverse();
    const SparseMatrix scaled = rows * inverse.asDiagonal();
    const SparseMatrix all = scaled * SparseMatrix(rows.transpose());
    return {all.triangularView<Eigen::Lower>(), single.points.leftCols(patch.free_count)};
}

class Ours {
public:
    explicit Ours(const System& system) : factor_(system.layout) {}
    bool factorise(const SparseMatrix& lower) { return factor_.factorise(lower, "", Progress()); }
    VectorX solve(const VectorX& rhs) const { return factor_.solve_vector(rhs); }

private:
    SparseCholesky factor_;
};

template <typename Solver>
class Others {
public:
    explicit Others(const System& /*system*/) { choose_ordering(solver_); }
    bool factorise(const SparseMatrix& lower) {
        if (!analysed_) solver_.analyzePattern(lower);
        analysed_ = true;
        solver_.factorize(lower);
        return solver_.info() == Eigen::Success;
    }
    VectorX solve(const VectorX& rhs) const { return solver_.solve(rhs); }

private:
    static void choose_ordering(Eigen::SimplicialLDLT<SparseMatrix>& /*solver*/) {}  // minimum degree
#ifdef WITH_CHOLMOD
    static void choose_ordering(Eigen::CholmodSupernodalLLT<SparseMatrix>& solver) {
        solver.cholmod().nmethods = 1;
        solver.cholmod().method[0].ordering = CHOLMOD_METIS;
    }
#endif
    Solver solver_;
    bool analysed_ = false;
};

void factorise(auto& solver, const SparseMatrix& lower) {
    if (!solver.factorise(lower)) throw std::runtime_error("a factorisation failed");
}

struct Row {
    double first = std::numeric_limits<double>::infinity();
    double again = std::numeric_limits<double>::infinity();
    double solve = std::numeric_limits<double>::infinity();
    double error = 0.0;
};

template <typename Solver>
void measure(const System& system, Row& row) {
    const SparseMatrix doubled = 2.0 * system.lower;
    Solver solver(system);
    const double begin = cpu_seconds();
    factorise(solver, system.lower);
    const double middle = cpu_seconds();
    factorise(solver, doubled);
    const double end = cpu_seconds();
    const VectorX known = VectorX::LinSpaced(system.lower.rows(), -1.0, 1.0);
    const VectorX rhs = doubled.selfadjointView<Eigen::Lower>() * known;
    const double before = cpu_seconds();
    const VectorX found = solver.solve(rhs);
    row.solve = std::min(row.solve, cpu_seconds() - before);
    row.first = std::min(row.first, middle - begin);
    row.again = std::min(row.again, end - middle);
    row.error = std::max(row.error, (found - known).cwiseAbs().maxCoeff());
}

template <typename Solver>
void print_row(const System& system, const char* name) {
    Row row;
    for (int k = 0; k < rounds; ++k) measure<Solver>(system, row);
    std::printf("| %lld | %lld | %s | %.3f | %.3f | %.4f | %.0e |\n", static_cast<long long>(system.lower.rows()),
                static_cast<long long>(system.lower.nonZeros()), name, row.first, row.again, row.solve, row.error);
    std::fflush(stdout);
}

void print_rows(int free_count) {
    const System system = make_system(free_count);
    print_row<Ours>(system, "fairing");
#ifdef WITH_CHOLMOD
    print_row<Others<Eigen::CholmodSupernodalLLT<SparseMatrix>>>(system, "CHOLMOD, METIS");
#endif
    print_row<Others<Eigen::SimplicialLDLT<SparseMatrix>>>(system, "Eigen SimplicialLDLT, AMD");
}

}  // namespace

int main(int count, char** words) {
    std::vector<int> sizes;
    for (int k = 1; k < count; ++k) sizes.push_back(std::atoi(words[k]));
    if (sizes.empty()) sizes = {25000, 100000};
    std::printf(
        "| free vertices | entries of the lower triangle | solver | first, CPU s | again, CPU s | solve, CPU s | "
        "largest error |\n| --: | --: | --- | --: | --: | --: | --: |\n");
    for (const int size : sizes) {
        if (size < 9) {
            std::fprintf(stderr, "usage: factorisations [FREE_VERTICES…], 9 at least\n");
            return 2;
        }
        print_rows(size);
    }
    return 0;
}
