#include "continuity/joined.h"

#include "accept/accept.h"
#include "base/stopwatch.h"
#include "geometry/surface_fit.h"
#include "linear/anderson.h"
#include "linear/conjugate_gradients.h"
#include "linear/limits.h"
#include "linear/shrinking_steps.h"
#include "problem/surface_state.h"
#include "tangential/tangential_step.h"

namespace fairing {

namespace {

Solution with_join(Solution tangent, Join join) {
    tangent.join = join;
    return tangent;
}

// A curvature that contradicts positions and slopes winds the surface up.
bool varies_wildly(const Problem& problem, const Solution& joined, const Solution& tangent) {
    constexpr double most = 10.0;  // times the largest |H| given or there before
    const double given =
        problem.fixed_curvatures.array().isFinite().select(problem.fixed_curvatures, 0.0).cwiseAbs().maxCoeff();
    const double before = tangent.mean_curvature.cwiseAbs().maxCoeff();
    return !(joined.mean_curvature.cwiseAbs().maxCoeff() <= most * std::max(given, before));
}

// What the tangent join's curvature lacks at the boundary, of the largest |H| there or of 1/D.
double relative_size(const KnownCurvature& known, const VectorX& missing) {
    double count = 0.0;
    for (const BoundaryCurve& curve : known.curves) count += static_cast<double>(curve.places.size());
    const double scale = std::max(1.0, known.values.cwiseAbs().maxCoeff());
    return missing.norm() / (scale * std::sqrt(count));
}

// Its waves of twelve vertices and more: half as fast as the fastest ones. Of white noise they are a sixth.
VectorX smooth_part(const Problem& problem, const KnownCurvature& known, const VectorX& missing) {
    const BoundaryModes modes(known.curves, problem.fixed_points, 2 * fastest_wave);
    return modes.combined(modes.projected(missing));
}

Join kind_of(const KnownCurvature& known) { return known.unknown.empty() ? Join::curvature : Join::partly_curvature; }

// A converged surface with that curvature, without flaws.
std::optional<Solution> acceptable(const Problem& problem, const KnownCurvature& known, const Solution& tangent,
                                   int vertices_per_wave, const Progress& progress) {
    Solution found = join_curvatures(problem, known, tangent.points, vertices_per_wave, progress);
    if (found.termination != Termination::converged) return std::nullopt;
    found.boundary_normals = one_sided_normals(problem.patch, found.points);
    found.flaw = flaw_of(problem, found);
    if (found.flaw != Flaw::absent || varies_wildly(problem, found, tangent)) return std::nullopt;
    return found;
}

// With the fastest waves of H first. On boundaries in steps these may not answer to the multipliers, and the iteration
// does not converge: long waves do, and meet what is smooth of H as well.
std::optional<Solution> with_curvature(const Problem& problem, const KnownCurvature& known, const Solution& tangent,
                                       const Progress& progress) {
    // Slower waves where faster ones have no surface.
    constexpr std::array vertices_per_wave{fastest_wave, 2 * fastest_wave, 4 * fastest_wave};
    std::optional<Solution> found;
    for (std::size_t k = 0; k < vertices_per_wave.size() && !found; ++k) {
        const double begin = 1.0 - std::pow(0.5, static_cast<double>(k));
        found = acceptable(problem, known, tangent, vertices_per_wave[k], progress.range(begin, 0.5 * (1.0 + begin)));
    }
    return found;
}

// Conditions on the surface that replaces the tangent join.
void inherit(Solution& found, Solution tangent, const KnownCurvature& known) {
    found.initial_residual = tangent.initial_residual;
    found.levels = std::move(tangent.levels);
    found.seconds = std::move(tangent.seconds);
    found.strategies = std::move(tangent.strategies);
    found.tangent_only = known.unknown;
    found.join = kind_of(known);
    if (tangent.pins != Pins::absent) found.pins = Pins::curvature_met;
}

// With 0.02 patches of 30k vertices need nine iterations instead of five, with a tenth of it none less.
constexpr double relative_tolerance = 0.004;

class CurvatureJoin {
public:
    CurvatureJoin(const Problem& problem, const KnownCurvature& known, const Points& start, int vertices_per_wave,
                  const Progress& progress)
        : problem_(problem),
          patch_(problem.patch),
          known_(known),
          progress_(progress),
          modes_(known.curves, problem.fixed_points, vertices_per_wave),
          operator_(problem.patch, problem.fixed_points, modes_, start.leftCols(problem.patch.free_count)),
          tangential_(make_tangential_step(problem.patch, problem.weights, problem.fixed_points, progress.here())),
          anderson_(history_depth),
          coefficients_(VectorX::Zero(modes_.count())) {
        state_.points = start;
    }

    Solution run() {
        const int most = std::min(nearby.steps, problem_.options.max_iterations);
        solution_.termination = Termination::iteration_limit;
        for (int k = 0; k < most; ++k) {
            progress_.report(static_cast<double>(k) / most, "curvature");
            if (!measure()) return failed();
            const Points d = step();
            const double largest = largest_length(d);
            solution_.iterations = k + 1;
            solution_.last_step = largest;
            if (k == 0) solution_.first_step = largest;
            if (largest <= problem_.options.tolerance) {
                solution_.termination = Termination::converged;
                break;
            }
            if (!std::isfinite(largest) || steps_.in_vain(largest) > nearby.in_vain) return failed();
            anderson_.move(state_.points, d, longest_step);
        }
        solution_.points = state_.points;
        solution_.mean_curvature = state_.curvature.mean;
        return std::move(solution_);
    }

private:
    Solution failed() {
        solution_.termination = Termination::stalled;
        solution_.points = state_.points;
        return std::move(solution_);
    }

    // False where the surface has degenerated.
    bool measure() {
        state_.measure_faces(patch_);
        state_.measure_curvature(problem_);
        if (!state_.curvature.mean.allFinite()) return false;
        if (!operator_.update(state_.stiffness, progress_.here())) return false;
        const VectorX mass = state_.stiffness.mass.head(patch_.free_count);
        residual_ = harmonic_residual(problem_, state_) - mass.cwiseProduct(operator_.harmonic(coefficients_));
        solution_.residual = residual_.cwiseAbs().cwiseQuotient(2.0 * mass).maxCoeff();
        return std::isfinite(solution_.residual);
    }

    Points step() {
        const VectorX H = state_.curvature.mean.tail(problem_.fixed_points.cols());
        const JoinOperator::Step step = operator_.solve(residual_, known_.missing(H));
        coefficients_ += step.coefficients;
        return state_.moves(tangential_->displacement(state_.points, state_.normals), step.heights);
    }

    const Problem& problem_;
    const Patch& patch_;
    const KnownCurvature& known_;
    const Progress& progress_;
    BoundaryModes modes_;
    JoinOperator operator_;
    std::unique_ptr<TangentialStep> tangential_;
    Anderson anderson_;
    VectorX coefficients_;  // of the multipliers
    SurfaceState state_;
    VectorX residual_;
    ShrinkingSteps steps_;
    Solution solution_;
};

}  // namespace

Solution joined(const Problem& problem, Solution tangent, const Progress& progress) {
    constexpr double negligible = 0.01;  // root mean square
    if (tangent.flaw != Flaw::absent || tangent.uniform_weights || stands_in(tangent.provenance))
        return with_join(std::move(tangent), Join::no_tangent_join);
    if (!tangent.polished) return with_join(std::move(tangent), Join::other_mesh);
    const KnownCurvature known = known_curvature(problem.patch, tangent.points, problem.fixed_curvatures);
    tangent.tangent_only = known.unknown;
    if (known.curves.empty())
        return with_join(std::move(tangent), known.unknown.empty() ? Join::curvature : Join::curvature_unknown);
    const VectorX missing = known.missing(tangent.mean_curvature.tail(known.values.size()));
    if (relative_size(known, missing) <= negligible) return with_join(std::move(tangent), kind_of(known));
    const VectorX smooth = smooth_part(problem, known, missing);
    tangent.smooth_share = smooth.squaredNorm() / missing.squaredNorm();
    if (tangent.smooth_share < least_smooth_share) {
        const bool is_met = relative_size(known, smooth) <= negligible;
        return with_join(std::move(tangent), is_met ? kind_of(known) : Join::too_rough);
    }
    const Stopwatch watch;
    std::optional<Solution> found = with_curvature(problem, known, tangent, progress);
    const double seconds = watch.seconds();
    tangent.seconds["curvature"] = seconds;
    tangent.strategies.push_back({"curvature", seconds});
    if (!found) return with_join(std::move(tangent), Join::not_found);
    inherit(*found, std::move(tangent), known);
    return std::move(*found);
}

JoinOperator::JoinOperator(const Patch& patch, const Points& fixed_points, const BoundaryModes& modes, Points layout)
    : modes_(modes),
      laplace_(patch, std::move(layout)),
      coupling_(patch),
      boundary_(patch, fixed_points),
      free_mass_(patch.free_count),
      fixed_mass_(fixed_points.cols()) {}

bool JoinOperator::update(const Stiffness& stiffness, const Progress& progress) {
    coupling_.update(stiffness);
    free_mass_ = 4.0 * stiffness.mass.head(free_mass_.size());
    fixed_mass_ = 4.0 * stiffness.mass.tail(fixed_mass_.size());
    if (!boundary_.update(fixed_mass_) || !laplace_.update(stiffness, progress)) return false;
    beside_ = laplace_.factor().reach(coupling_.beside());
    return true;
}

VectorX JoinOperator::lifted(const VectorX& boundary) const {
    return laplace_.factor().solve_vector(coupling_.spread(boundary.transpose()), beside_);
}

VectorX JoinOperator::turned(const VectorX& field) const {
    const VectorX u = laplace_.factor().solve_vector(free_mass_.cwiseProduct(field), FrontReach(), beside_);
    return coupling_.gather(u).transpose();
}

VectorX JoinOperator::harmonic(const VectorX& coefficients) const { return -lifted(modes_.multipliers(coefficients)); }

// Rows: the change of H at the fixed vertices by the first equation, then its modes.
VectorX JoinOperator::applied(const VectorX& unknowns) const {
    const VectorX change = unknowns.head(fixed_mass_.size());
    const VectorX kappa = lifted(modes_.multipliers(unknowns.tail(modes_.count())));
    const VectorX source = coupling_.spread(change.transpose()) + 0.25 * free_mass_.cwiseProduct(kappa);
    const VectorX first = fixed_mass_.cwiseProduct(change) + turned(laplace_.factor().solve_vector(source));
    VectorX rows(unknowns.size());
    rows << boundary_.approximate_inverse(first.transpose()).transpose(), modes_.projected(change);
    return rows;
}

// As if Ĝ were G and the multipliers of a mode changed that mode alone.
VectorX JoinOperator::preconditioned(const VectorX& rows) const {
    const VectorX first = rows.head(fixed_mass_.size());
    const VectorX coefficients = modes_.projected(first) - rows.tail(modes_.count());
    VectorX unknowns(rows.size());
    unknowns << first - modes_.combined(coefficients), coefficients;
    return unknowns;
}

JoinOperator::Step JoinOperator::solve(const VectorX& residual, const VectorX& missing) const {
    const SparseCholesky& factor = laplace_.factor();
    const VectorX inner = factor.solve_vector(residual);
    VectorX rhs(fixed_mass_.size() + modes_.count());
    rhs << -boundary_.approximate_inverse(turned(inner).transpose()).transpose(), modes_.projected(missing);
    // Accelerated steps do what GMRES does (Walker & Ni 2011).
    constexpr int depth = 20;  // more than such a solve takes steps
    Anderson anderson(depth);
    VectorX unknowns = VectorX::Zero(rhs.size());
    VectorX left = rhs;
    for (int k = 0; k < most_cycles && left.norm() > relative_tolerance * rhs.norm(); ++k) {
        unknowns += anderson.step(unknowns, preconditioned(left));
        left = rhs - applied(unknowns);
    }
    Step step{{}, unknowns.tail(modes_.count())};
    const VectorX change = unknowns.head(fixed_mass_.size());
    const VectorX source =
        coupling_.spread(change.transpose()) - 0.25 * free_mass_.cwiseProduct(harmonic(step.coefficients));
    step.heights = factor.solve_vector(free_mass_.cwiseProduct(inner + factor.solve_vector(source)));
    return step;
}

Solution join_curvatures(const Problem& problem, const KnownCurvature& known, const Points& start,
                         int vertices_per_wave, const Progress& progress) {
    return CurvatureJoin(problem, known, start, vertices_per_wave, progress).run();
}

}  // namespace fairing
