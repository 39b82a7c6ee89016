#include "method/plan.h"

#include "fairness/inner_weights.h"
#include "pins/spread_pins.h"
#include "start/several_outlines.h"

namespace fairing {

namespace {

// Large moves wrinkle a fine mesh, and a coarse mesh of the engine's own makes them for less (hemispheres: 1.2 times
// slower at 20,000, 1.4 times faster at 40,000; at 100,000 it alone gets there).
constexpr int largest_direct = 25'000;

// On the user's own connectivity. What a coarse level of a disc refuses, the whole mesh would only refuse later; but
// between smooth loops pipes and blends may have no surface on a coarse mesh and keep it on their own.
std::vector<Step> on_the_users_mesh(const Problem& problem, const Traits& traits) {
    if (!traits.has_levels) return {Step::direct};
    const bool is_smooth = problem.patch.loop_count() > 1 && !traits.is_jagged;
    const bool goes_on = !traits.is_large || (is_smooth && problem.patch.free_count <= largest_direct);
    return goes_on ? std::vector{Step::levels, Step::direct} : std::vector{Step::levels};
}

// Between real loops whose membrane is poor the old shape nearly always decides (method/traits).
bool has_little_chance(const Traits& traits) {
    constexpr double most_poor = 0.02;  // of its triangles
    return traits.has_old_shape && traits.is_jagged && traits.poor_share_of_membrane() > most_poor;
}

std::vector<Step> equation_steps(const Problem& problem, const Traits& traits, bool lifts_pins) {
    if (problem.options.equation == Equation::soap_film) return {Step::direct};
    if (problem.options.equation == Equation::least_variation) return {Step::least_variation};
    std::vector<Step> steps = on_the_users_mesh(problem, traits);
    const bool is_hopeless = (traits.is_large && traits.is_beyond_reach) || has_little_chance(traits);
    if (!is_hopeless) steps.push_back(Step::own_mesh);
    if (!is_uniform(problem.weights)) steps.push_back(Step::uniform_weights);
    if (traits.is_jagged && !traits.has_old_shape) steps.push_back(Step::low_passed);
    if (lifts_pins) steps.push_back(Step::lifted_pins);
    return steps;
}

// None of least variation was found between loops as jagged as those of scans: of 570 random patches it decides none.
// Between loops that are no tubes' ends it takes up to 17 s, and crumples (a neck moved aside on a sphere), where the
// least bent of the lofts takes a tenth of a second.
std::vector<Step> stand_ins(const Problem& problem, const Traits& traits) {
    const SolverOptions& options = problem.options;
    const bool wanted = options.otherwise == Otherwise::least_variation && options.equation != Equation::soap_film &&
                        options.equation != Equation::least_variation;
    std::vector<Step> steps;
    if (!wanted) return steps;
    const bool may_vary_least = problem.patch.loop_count() == 1 || traits.is_between_tubes;
    if (!traits.is_jagged && may_vary_least) steps.push_back(Step::least_variation);
    if (traits.has_old_shape) steps.push_back(Step::old_shape);
    if (problem.patch.loop_count() > 1) steps.push_back(Step::loft);
    if (isolated_pins(problem.patch).empty()) steps.push_back(Step::first_surface);  // its needles are no better
    return steps;
}

std::string text_of(const std::vector<Step>& steps) {
    std::string text;
    for (const Step step : steps) text.append(text.empty() ? "" : ", ").append(name_of(step));
    return text;
}

}  // namespace

const char* name_of(Step step) {
    switch (step) {
        case Step::levels: return "levels";
        case Step::direct: return "direct";
        case Step::own_mesh: return "own mesh";
        case Step::uniform_weights: return "uniform weights";
        case Step::low_passed: return "low-passed";
        case Step::lifted_pins: return "lifted pins";
        case Step::least_variation: return "least variation";
        case Step::old_shape: return "old shape";
        case Step::loft: return "loft";
        case Step::first_surface: break;
    }
    return "first surface";
}

std::string text_of(const Plan& plan) { return text_of(plan.equation) + " | " + text_of(plan.stand_ins); }

Plan plan_for(const Problem& problem, const Traits& traits, bool lifts_pins) {
    return {equation_steps(problem, traits, lifts_pins), stand_ins(problem, traits)};
}

}  // namespace fairing
