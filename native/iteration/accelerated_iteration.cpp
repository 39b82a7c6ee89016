#include "iteration/accelerated_iteration.h"

#include "linear/anderson.h"
#include "linear/limits.h"
#include "linear/shrinking_steps.h"
#include "problem/surface_state.h"

namespace fairing {

namespace {

constexpr double last_digits = 1e-5;  // units of D; shorter steps shrink unevenly where a surface is found, too
constexpr int refresh_after = 6;      // iterations, where they contract slowly
// The iteration ends before a step of this share of the tolerance, which is not taken: up to three times as much may be
// left. It ends with a step after which the next one would be as short, by the ratio of the last two, and within the
// tolerance by that of the residuals.
constexpr double least_share = 0.5;
constexpr double share_of_factor = 0.2;  // of the time, in large problems

// Moves along the normals, in units of D: beyond, slopes and curvatures say little about where the vertices will
// be. Where steps have to shrink, over jagged boundaries, coarser levels have come near already: of 78 regions of scans
// 26 ended nowhere that looked on from the first step, 30 that did from this length.
constexpr double near_surface = 1e-3;
constexpr double near_led_surface = 3e-2;

// The forcing term (Eisenstat & Walker 1996): of a step along the normals or within the surface its solve may leave
// this share of the tolerance, or of the step where that is shorter; but no less than a share of the step that the next
// one corrects anyway. Eleven closed forms of 3,000 and 10,000 vertices take as many steps to the same distance with a
// floor of 0.005 or 0.01 as with 0.003 before; with 0.02 a hemisphere takes one more.
constexpr double forcing = 0.1;
constexpr double least_forcing = 0.005;

// A disc clamped at its rim moves by ε R / √(16 π) at most, ε² = ∫ (Δd)², as under a load in the middle. On large rough
// patches noise is most of what a step is solved for, and a small part of it still moves all of the surface: a catenoid
// of a million vertices took four steps instead of two. So what is left may bend the surface by no more than that.
constexpr double moves_by_bending = 0.07;  // D, for each ε

class AcceleratedIteration {
public:
    AcceleratedIteration(const Problem& problem, Workspace& work, const Progress& progress)
        : problem_(problem),
          patch_(problem.patch),
          work_(work),
          progress_(progress),
          own_history_(history_depth),
          anderson_(work.keeps_factor ? kept_history() : own_history_) {}

    Solution run(Points start) {
        state_.points = std::move(start);
        const int most = most_steps();
        const bool by_caller = most == problem_.options.max_iterations;
        solution_.termination = by_caller ? Termination::iteration_limit : Termination::stalled;
        solution_.mean_curvature = VectorX::Zero(patch_.vertex_count());
        solution_.residual = std::numeric_limits<double>::max();
        for (int k = 0; k < most; ++k) {
            report(k);
            if (!measure()) break;
            if (k == 0) solution_.initial_residual = residual_;
            if (arrived_ || (arrives_ && last_step_ * residual_ <= problem_.options.tolerance * residual_before_)) {
                end_here();
                break;
            }
            if (!refresh_operator(k)) {
                solution_.termination = Termination::stalled;
                break;
            }
            Points d = plain_step();
            const double largest = largest_length(d);
            solution_.iterations = k + 1;
            if (k == 0) solution_.first_step = largest;
            solution_.last_step = largest;
            solution_.least_step = k == 0 ? largest : std::min(solution_.least_step, largest);
            arrived_ = largest <= problem_.options.tolerance;
            if (arrived_ && problem_.conduct.start_only) {
                end_here();
                move(std::move(d));
                best_ = Best::here;
                break;
            }
            // The answer of the solve before that comes back as a start stays, to the bit.
            const bool stays = arrived_ && k == 0 && work_.keeps_factor;
            if (stays || largest <= least_share * problem_.options.tolerance || (arrived_ && k + 1 == most)) {
                end_here();
                break;
            }
            arrives_ = next_step(largest) <= least_share * problem_.options.tolerance;
            if (hopeless(largest) && !arrived_) {
                solution_.termination = Termination::stalled;
                break;
            }
            residual_before_ = residual_;
            move(std::move(d));
        }
        store_best();
        return std::move(solution_);
    }

private:
    enum class Best { here, one_back, stored };  // of the points that come back: in the state, or left by one step

    // The map hardly changes from one solve with a factor to the next, nor do its differences.
    Anderson& kept_history() {
        if (!work_.history) work_.history = std::make_unique<Anderson>(history_depth);
        work_.history->begin_again();
        return *work_.history;
    }

    [[nodiscard]] int most_steps() const {
        return std::min(problem_.conduct.limits.steps, problem_.options.max_iterations);
    }

    void report(int k) {
        // Steps shrink geometrically: the share of the decades down to the tolerance that is done.
        const double decades = std::log10(std::max(1e-2 / problem_.options.tolerance, 10.0));
        const double done = last_step_ > 0.0 ? std::log10(std::max(1e-2 / last_step_, 1.0)) / decades : 0.0;
        const double share = std::max(done, static_cast<double>(k) / most_steps());
        progress_.report(k == 0 ? 0.0 : share_of_factor + (1.0 - share_of_factor) * share, "iteration");
    }

    void end_here() {
        solution_.termination = Termination::converged;
        keep();
    }

    void move(Points d) {
        best_ = best_ == Best::here ? Best::one_back : Best::stored;
        anderson_.move(state_.points, std::move(d), longest_step);
    }

    // The best points are copied only where nothing else keeps them: a large patch has no room for them twice.
    void store_best() {
        if (best_ != Best::stored) solution_.points = state_.points;
        if (best_ == Best::one_back) solution_.points.leftCols(patch_.free_count) = anderson_.last();
        best_ = Best::stored;
    }

    // The largest move of the next iteration, from this one's and the last one's; infinite where they hardly shrink.
    [[nodiscard]] double next_step(double largest) const {
        const double ratio = std::max(largest / last_step_, fastest_contraction);
        return ratio <= slow_contraction ? ratio * largest : std::numeric_limits<double>::infinity();
    }

    // False where the surface is no longer finite.
    bool measure() {
        state_.measure_faces(patch_);
        state_.measure_curvature(problem_);
        outer_ = outer_residual(problem_, state_);
        residual_ = largest_residual(problem_, state_, outer_);
        if (!std::isfinite(residual_)) {
            solution_.termination = Termination::stalled;
            return false;
        }
        if (residual_ < best_residual_) keep();
        if (best_ == Best::one_back) store_best();
        return true;
    }

    void keep() {
        best_residual_ = residual_;
        best_ = Best::here;
        solution_.points.resize(3, 0);
        solution_.mean_curvature = state_.curvature.mean;
        solution_.residual = residual_;
    }

    // A new factor at the start and where the steps hardly shrink; false where the surface has none.
    bool refresh_operator(int k) {
        if (work_.keeps_factor) return true;
        if (k > 0 && k - refreshed_at_ < refresh_after) return true;
        const bool wanted = k == 0 || last_step_ > slow_contraction * step_at_refresh_;
        refreshed_at_ = k;
        step_at_refresh_ = k == 0 ? std::numeric_limits<double>::infinity() : last_step_;
        return !wanted || work_.normal->update(state_.stiffness, progress_.range(0.0, k == 0 ? share_of_factor : 0.0));
    }

    // The share of a step of this length that its solve may leave.
    [[nodiscard]] double share_left(double step) const {
        return std::clamp(forcing * problem_.options.tolerance / step, least_forcing, forcing);
    }

    // Accuracy of the next step along the normals, as the residual says.
    [[nodiscard]] Accuracy accuracy() const {
        const double size = most_bending();
        if (problem_.conduct.start_only || solution_.iterations == 0) return {least_forcing, size};
        return {share_left(last_step_ * residual_ / residual_before_), size};
    }

    [[nodiscard]] double most_bending() const {
        const bool is_known = solution_.iterations > 0 || problem_.conduct.begins_near;
        if (!is_known || problem_.conduct.start_only) return std::numeric_limits<double>::infinity();
        return std::max(forcing * problem_.options.tolerance, least_forcing * last_step_) / moves_by_bending;
    }

    Points plain_step() {
        VectorX u = work_.normal->solve(outer_, accuracy());
        const double nearest = problem_.conduct.contracts ? near_led_surface : near_surface;
        const bool is_near = u.cwiseAbs().maxCoeff() < nearest;
        outer_.resize(0);  // the tangential step needs the room
        state_.stiffness = {};
        if (!is_near) return state_.moves(work_.tangential->displacement(state_.points, state_.normals), u);
        return state_.moves(step_within(u), u);
    }

    // Nothing where the last steps have left next to nothing.
    [[nodiscard]] Points step_within(const VectorX& heights) {
        const double imbalance = work_.tangential->imbalance(state_.points, state_.normals);
        const double next = within_ * imbalance / imbalance_;
        if (next <= forcing * problem_.options.tolerance) return Points::Zero(3, patch_.free_count);
        Points within = step_within_raised(heights, share_left(next));
        within_ = largest_length(within);
        imbalance_ = imbalance;
        return within;
    }

    // Newton's step within the surface that the moves along the normals lead to: on a catenoid those alone shift the
    // vertices' places as far as they go.
    [[nodiscard]] Points step_within_raised(const VectorX& heights, double tolerance) const {
        Raised next = raised(patch_, state_, heights);
        ShapeOperators shapes = shape_operators(state_.curvature, state_.normals, patch_.free_count);
        const Effort effort = problem_.conduct.begins_near ? Effort{tolerance} : Effort{};
        return work_.tangential->displacement({std::move(next.points), std::move(next.normals), std::move(shapes)},
                                              effort);
    }

    bool hopeless(double largest) {
        last_step_ = largest;
        const int in_vain = steps_.in_vain(largest);
        const bool creeps = contraction_.is_slow(largest) && problem_.conduct.contracts && largest > last_digits;
        const bool stays = solution_.iterations == problem_.conduct.nears_within && stays_far(solution_);
        return !std::isfinite(largest) || creeps || stays || in_vain > problem_.conduct.limits.in_vain;
    }

    const Problem& problem_;
    const Patch& patch_;
    Workspace& work_;
    const Progress& progress_;
    Anderson own_history_;
    Anderson& anderson_;
    SurfaceState state_;
    VectorX outer_;
    double residual_ = 0.0;
    double residual_before_ = 0.0;  // the last step
    bool arrived_ = false;          // the last step was within the tolerance
    bool arrives_ = false;          // the next step would be
    double best_residual_ = std::numeric_limits<double>::infinity();
    Best best_ = Best::here;
    double last_step_ = 0.0;
    // The largest move of the last step within the surface, and the imbalance before it.
    double within_ = std::numeric_limits<double>::infinity();
    double imbalance_ = 1.0;
    double step_at_refresh_ = 0.0;
    int refreshed_at_ = 0;
    ShrinkingSteps steps_{0.9};
    Contraction contraction_;
    Solution solution_;
};

}  // namespace

Solution iterate(const Problem& problem, Workspace& work, Points start, const Progress& progress) {
    return AcceleratedIteration(problem, work, progress).run(std::move(start));
}

}  // namespace fairing
