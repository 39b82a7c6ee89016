#include "boundary/fair_border.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>

#include "base/progress.h"
#include "linear/elimination.h"

namespace fairing {

namespace {

constexpr int shortest_run = 6;  // moving vertices: third differences tell noise from shape on longer ones only
constexpr double caution = 1.4;  // of the degrees of freedom: without, some noise is taken for shape (Kim & Gu 2004)

// Consecutive columns: those that move, and for open runs the two that end them.
struct Run {
    Indices columns;
    bool closed;
    [[nodiscard]] int size() const { return static_cast<int>(columns.size()); }
    [[nodiscard]] int first_moving() const { return closed ? 0 : 1; }
    [[nodiscard]] int moving() const { return size() - (closed ? 0 : 2); }
};

std::vector<Run> runs_of(const Indices& loop, const std::vector<char>& marked) {
    const auto is_marked = [&](std::size_t k) { return marked[loop[k % loop.size()]] != 0; };
    std::size_t begin = 0;
    while (begin < loop.size() && is_marked(begin)) ++begin;
    if (begin == loop.size()) return {{loop, true}};
    std::vector<Run> runs;
    for (std::size_t k = begin; k < begin + loop.size(); ++k) {
        if (is_marked(k) || !is_marked(k + 1)) continue;
        Run& run = runs.emplace_back(Run{{}, false});
        std::size_t v = k;
        do run.columns.push_back(loop[v++ % loop.size()]);
        while (is_marked(v));
        run.columns.push_back(loop[v % loop.size()]);
    }
    return runs;
}

// Third differences of a run.
SparseMatrix third_differences(const Run& run) {
    constexpr std::array<double, 4> stencil{-1.0, 3.0, -3.0, 1.0};  // of a third difference
    const int rows = run.closed ? run.size() : run.size() - 3;
    std::vector<Eigen::Triplet<double>> entries;
    for (int r = 0; r < rows; ++r) {
        for (int k = 0; k < 4; ++k) entries.emplace_back(r, (r + k) % run.size(), stencil[k]);
    }
    SparseMatrix result(rows, run.size());
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

// The factor by which a first difference scales a wave of `wave` vertices.
double frequency(double wave) { return 2.0 * std::sin(std::numbers::pi / wave); }

// The mean and the first wave around a closed run: an ellipse, which no smoothing is to shrink.
Points oval_of(const Points& points) {
    const auto count = static_cast<int>(points.cols());
    Points result = points.rowwise().mean().replicate(1, count);
    for (const double phase : {0.0, 0.5 * std::numbers::pi}) {
        VectorX wave(count);
        for (int k = 0; k < count; ++k) wave[k] = std::cos(2.0 * std::numbers::pi * k / count - phase);
        result += (points * wave * (2.0 / count)) * wave.transpose();
    }
    return result;
}

class Smoother {
public:
    Smoother(const Run& run, const Points& points)
        : run_(run), given_(points(Eigen::all, run.columns)), oval_(Points::Zero(3, run.size())) {
        if (run.closed) oval_ = oval_of(given_);
        given_ -= oval_;
        const SparseMatrix differences = third_differences(run);
        const SparseMatrix full = differences.transpose() * differences;
        energy_ = full.block(run.first_moving(), run.first_moving(), run.moving(), run.moving());
        if (run.closed) return;
        Eigen::MatrixX3d ends = Eigen::MatrixX3d::Zero(run.size(), 3);
        ends.row(0) = given_.col(0).transpose();
        ends.row(run.size() - 1) = given_.col(run.size() - 1).transpose();
        pull_ = -(full * ends).middleRows(1, run.moving());
    }

    // The moving points with the least generalised cross-validation.
    [[nodiscard]] Points best() const {
        constexpr double finest = 4.0;  // edges: the wavelength that is halved
        constexpr int steps = 3;        // in each octave
        Points result = given_.middleCols(run_.first_moving(), run_.moving());
        double least = std::numeric_limits<double>::infinity();
        const double longest = 2.0 * run_.size();
        const int last = static_cast<int>(std::floor(steps * std::log2(longest / finest)));
        for (int k = 0; k <= last; ++k) {
            checkpoint();
            const Trial trial = smoothed(std::pow(frequency(finest * std::exp2(static_cast<double>(k) / steps)), -6));
            if (trial.score < least) {
                least = trial.score;
                result = trial.points;
            }
        }
        return result + oval_.middleCols(run_.first_moving(), run_.moving());
    }

private:
    struct Trial {
        Points points;
        double score;
    };

    [[nodiscard]] Trial smoothed(double stiffness) const {
        const int count = run_.moving();
        SparseMatrix matrix = stiffness * energy_;
        for (int k = 0; k < count; ++k) matrix.coeffRef(k, k) += 1.0;
        const Eigen::SimplicialLDLT<SparseMatrix> factor(matrix);
        const Eigen::MatrixX3d data = given_.middleCols(run_.first_moving(), count).transpose();
        Eigen::MatrixX3d rhs = data;
        if (!run_.closed) rhs += stiffness * pull_;
        const Eigen::MatrixX3d x = factor.solve(rhs);
        double fitted = trace_of_inverse(factor, count);
        if (run_.closed) fitted += 2.0 * (1.0 - 1.0 / (1.0 + stiffness * std::pow(frequency(run_.size()), 6)));
        const double left = static_cast<double>(count) - caution * fitted;
        const double score = (x - data).squaredNorm() / (left * left);
        return {x.transpose(), left > 0.0 ? score : std::numeric_limits<double>::max()};
    }

    static double trace_of_inverse(const Eigen::SimplicialLDLT<SparseMatrix>& factor, int count) {
        double trace = 0.0;
        for (int k = 0; k < count; ++k) trace += factor.solve(VectorX::Unit(count, k))[k];
        return trace;
    }

    const Run& run_;
    Points given_;  // without the oval
    Points oval_;   // zero of open runs
    SparseMatrix energy_;
    Eigen::MatrixX3d pull_;  // of the ends
};

}  // namespace

void fair_border(const Indices& loop, const std::vector<char>& marked, Points& points) {
    for (const Run& run : runs_of(loop, marked)) {
        if (run.moving() < shortest_run) continue;
        const Points smoothed = Smoother(run, points).best();
        for (int k = 0; k < run.moving(); ++k) points.col(run.columns[run.first_moving() + k]) = smoothed.col(k);
    }
}

ChainEnd end_of_chain(const Points& chain) {
    const Eigen::Index count = chain.cols() - 1;
    const Vector3 first = chain.col(1) - chain.col(0);
    if (count == 1) return {-first.normalized(), Vector3::Zero()};
    // An inversion about the end makes a straight line of the circle, parallel to its tangent there and at a distance
    // of half the curvature. It magnifies errors by the inverse square of the distance: hence the weights.
    Points places(3, count);
    VectorX weights(count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const Vector3 out = chain.col(k + 1) - chain.col(0);
        places.col(k) = out / out.squaredNorm();
        weights[k] = out.squaredNorm() / first.squaredNorm();
    }
    const Vector3 middle = places * weights / weights.sum();
    const Points off = places.colwise() - middle;
    const Eigen::Matrix3d spread = off * weights.asDiagonal() * off.transpose();
    Vector3 along = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
    if (along.dot(off.col(0)) < 0.0) along = -along;
    return {-along, 2.0 * (middle - middle.dot(along) * along)};
}

}  // namespace fairing
