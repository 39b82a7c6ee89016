#include "method/levels.h"

#include "problem/surface_state.h"

namespace fairing {

namespace {

// Up to so many free vertices the tangential step is factorised; beyond, multigrid is faster.
constexpr int largest_factorised = 7000;
constexpr int evening_sweeps = 3;  // of an interpolated surface

// The problem without `before`, which levels do not read.
Problem finest(const Problem& problem) {
    return {problem.patch,          problem.fixed_points, problem.fixed_normals,
            problem.weights,        problem.options,      problem.tolerated_folds,
            problem.normal_weights, problem.free_edge,    problem.fixed_curvatures};
}

// Columns of the vertices of a coarse level, in its order.
Points pick(const Points& points, const Indices& columns, int first) {
    Points result(3, static_cast<Eigen::Index>(columns.size()) - first);
    for (Eigen::Index k = 0; k < result.cols(); ++k) result.col(k) = points.col(columns[first + std::size_t(k)]);
    return result;
}

}  // namespace

Points with_fixed(const Patch& patch, const Points& fixed) {
    Points points = Points::Zero(3, patch.vertex_count());
    points.rightCols(fixed.cols()) = fixed;
    return points;
}

Levels::Levels(const Problem& problem, const Problem& below, Boundaries boundaries, int coarsest) {
    const Points points = with_fixed(problem.patch, below.fixed_points);
    const Points normals = with_fixed(problem.patch, below.fixed_normals);
    const Points unknown = Points::Zero(3, points.cols());  // normals of zero: boundary loops stay whole
    const FixedPlaces boundary{points, boundaries == Boundaries::thinned ? normals : unknown};
    coarse_ = with_edges(problem.patch, problem.weights,
                         [&](const InnerWeights& edges) { return coarsen(problem.patch, edges, boundary, coarsest); });
    left_.resize(coarse_.size());
    levels_.reserve(coarse_.size() + 1);
    levels_.push_back({finest(problem), problem.patch.free_count});
    for (CoarseLevel& coarse : coarse_) {
        const Patch& patch = coarse.patch;
        Problem level{patch, pick(points, patch.to_input, patch.free_count),
                      pick(normals, patch.to_input, patch.free_count), std::move(coarse.weights), problem.options};
        levels_.push_back({std::move(level), patch.free_count});
    }
}

RingMatrix Levels::laplacian(std::size_t k) const {
    const Patch& patch = levels_[k].problem.patch;
    return with_edges(patch, levels_[k].problem.weights,
                      [&](const InnerWeights& edges) { return RingMatrix(patch.vertex_count(), edges); });
}

Points Levels::layout(std::size_t k, std::size_t from, const Points& surface) const {
    Points points = surface;
    for (std::size_t level = from; level-- > k;) {
        const Points& fixed = levels_[level].problem.fixed_points;
        Points finer = Points::Zero(3, levels_[level].free_count + fixed.cols());
        finer.rightCols(fixed.cols()) = fixed;
        transfer(level).prolong_means(points, levels_[level].free_count, finer);
        points = std::move(finer);
    }
    points.conservativeResize(3, levels_[k].free_count);
    return points;
}

BentPoints Levels::interpolated(std::size_t k, const Points& coarse, const RingMatrix& laplacian) const {
    const Problem& fine = problem(k);
    const int count = fine.patch.free_count;
    const SurfaceState state = measured_surface(problem(k + 1), coarse);
    const BentPoints from{coarse, state.normals,
                          shape_operators(state.curvature, state.normals, static_cast<int>(coarse.cols()))};
    BentPoints points{with_fixed(fine.patch, fine.fixed_points), with_fixed(fine.patch, fine.fixed_normals), {}};
    transfer(k).prolong_surface(from, count, points);
    even_out(laplacian, count, evening_sweeps, points);
    points.shapes.conservativeResize(6, count);
    return points;
}

void Levels::leave(std::size_t k) {
    Patch& patch = coarse_[k - 1].patch;
    PatchMembers& members = left_[k - 1];
    members = std::move(patch);
    patch = Patch({members.free_count, members.to_input, {}, {}, Triangles(3, 0)});
    levels_[k].problem.weights = {};
}

void Levels::come_back(std::size_t k) {
    PatchMembers& members = left_[k - 1];
    if (members.to_input.empty()) return;
    coarse_[k - 1].patch = Patch(std::move(members));
    members = {};
}

std::vector<int> Levels::sizes() const {
    std::vector<int> result;
    for (std::size_t k = levels_.size(); k-- > 0;) result.push_back(levels_[k].problem.patch.vertex_count());
    return result;
}

bool Levels::is_factorised(std::size_t k) const {
    return k == coarsest() || levels_[k].problem.patch.free_count <= largest_factorised;
}

std::unique_ptr<FactorisedLaplacian> Levels::factorised(std::size_t k, const Progress& progress) const {
    const Level& level = levels_[k];
    const Problem& problem = level.problem;
    return with_edges(problem.patch, problem.weights, [&](const InnerWeights& edges) {
        return std::make_unique<FactorisedLaplacian>(problem.patch, edges, problem.fixed_points, progress.here());
    });
}

void Levels::prepare_beside() {
    for (std::size_t k = coarsest() + 1; k-- > 0;) {
        Level& level = levels_[k];
        level.preparing = is_factorised(k) ? BackgroundTask([&, k] { level.factor = factorised(k, Progress()); })
                                           : BackgroundTask([&, k] { level.restriction.emplace(transfer(k)); });
    }
}

void Levels::set_up_tangential(std::size_t k, RingMatrix laplacian, const Progress& progress) {
    Level& level = levels_[k];
    const Problem& problem = level.problem;
    const auto adopt = [&](auto step) {
        level.tangential_cycle = step.get();
        level.work.tangential = std::move(step);
    };
    level.preparing.finish();
    if (is_factorised(k)) {
        adopt(level.factor ? std::move(level.factor) : factorised(k, progress));
    } else {
        if (!level.restriction) level.restriction.emplace(transfer(k));
        adopt(std::make_unique<MultigridStep>(problem.patch, std::move(laplacian), problem.fixed_points,
                                              std::move(*level.restriction), *levels_[k + 1].tangential_cycle));
        level.restriction.reset();
    }
}

Levels levels_of(const Problem& problem, const Traits& traits, int coarsest) {
    if (!traits.is_jagged) return {problem, Boundaries::thinned, coarsest};
    return {problem, traits.low_passed(), Boundaries::thinned, coarsest};
}

}  // namespace fairing
