// The solve of one component, in units of D, and what the next solve of the same component can use of it.
#pragma once

#include "api/kept_skin.h"
#include "problem/solution.h"
#include "reuse/warm_start.h"

namespace fairing {

struct ComponentAnswer {
    Normalisation unit;
    Problem problem;
    Solution solution;
    Diagnostics warnings;
    std::optional<Dressed> dressed;  // the solution with the detail that is to be put back
};

// Refers to patch and options.
class ComponentSolver {
public:
    ComponentSolver(const Patch& patch, const FairOptions& options);

    // Throws NO_BOUNDARY where the fixed vertices lie in one point, SolverError, Cancelled; what was kept stays usable.
    [[nodiscard]] ComponentAnswer solve(const ComponentData& data, const Progress& progress);

    // The surface that is shown first (method/nested), 3 × local vertices in the caller's units. Throws the
    // same.
    [[nodiscard]] Points first_surface(const ComponentData& data, const Progress& progress);

    // Forgets all that depends on the options: the next answer is a new solver's.
    void options_changed() {
        reference_read_ = false;
        warm_.forget();
        replaced_.reset();
        chosen_.reset();
        skin_.forget();
    }

private:
    struct Replaced {
        Boundary boundary;
        Provenance kind;
    };
    struct Chosen {
        Boundary boundary;
        Equation equation;
    };
    // Whether a solve starts from its last answer.
    [[nodiscard]] bool keeps() const;
    // `input`: M0, in the caller's units.
    void read_reference(const View<Points>& input, const Normalisation& unit);
    [[nodiscard]] BaseBoundary boundary_as_given(const ComponentData& data) const;
    // An answer with its problem filled in, not solved yet.
    [[nodiscard]] ComponentAnswer posed(const ComponentData& data, const BaseBoundary& boundary);
    [[nodiscard]] ComponentAnswer solve_between(const ComponentData& data, const BaseBoundary& boundary,
                                                const Progress& progress);
    // With the detail put back; `boundary`: the one the answer was solved with.
    [[nodiscard]] ComponentAnswer dressed(ComponentAnswer answer, const ComponentData& data,
                                          const BaseBoundary& boundary, const Progress& progress);
    // Uniform where the reference is no surface.
    [[nodiscard]] InnerFairness fairness() const { return usable_ ? options_.inner_fairness : InnerFairness::uniform; }
    [[nodiscard]] Solution solve_by_paper(const Problem& problem, const Progress& progress) const;
    [[nodiscard]] std::optional<NearStart> given_start(const ComponentAnswer& answer, const ComponentData& data) const;
    [[nodiscard]] Solution solve_globally(ComponentAnswer& answer, const ComponentData& data, const Progress& progress);
    // From the last answer or `start` where there is one.
    [[nodiscard]] Solution solve_tangent(Problem& problem, const std::optional<NearStart>& start,
                                         const Progress& progress);
    // While a boundary is dragged, the equation stays what it was.
    [[nodiscard]] Equation equation_of(const Problem& problem, const ComponentData& data);
    [[nodiscard]] std::optional<Solution> solve_from(const Problem& problem, const std::optional<NearStart>& start,
                                                     const Progress& progress) const;
    [[nodiscard]] std::optional<Solution> solve_near_last(const Problem& problem, const Progress& progress);
    [[nodiscard]] std::size_t tolerated_folds() const;

    const Patch& patch_;
    const FairOptions& options_;
    bool reference_read_ = false;
    // 3 × local vertices, as the caller gave it; empty where λ is not read off it, or no call follows
    Points given_reference_;
    Points reference_;  // the same in units of D; empty where λ is not read off it
    KeptSkin skin_;
    bool usable_ = true;
    Diagnostics reference_warnings_;
    Shared<Lambda> lambda_;
    WarmStart warm_;
    std::optional<Chosen> chosen_;      // of the last problem, where the equation is chosen automatically
    bool chooses_ = false;              // whether it is to be chosen now
    std::optional<Replaced> replaced_;  // of the last answer, where another surface was taken instead
};

}  // namespace fairing
