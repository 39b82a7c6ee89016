// The words that callers use for the engine's enumerations: here and nowhere else.
#pragma once

#include <stdexcept>

#include "api/fair.h"
#include "problem/solution.h"

namespace fairing::bindings {

// Both directions throw std::invalid_argument, which names the option, for what is not in the list.
template <typename Enum, std::size_t N>
struct Words {
    std::string_view option;
    std::array<std::pair<std::string_view, Enum>, N> list;

    [[nodiscard]] Enum value(std::string_view word) const {
        for (const auto& [name, enumerator] : list) {
            if (name == word) return enumerator;
        }
        throw std::invalid_argument(std::string(option) + ": '" + std::string(word) + "' is not accepted");
    }
    [[nodiscard]] std::string word(Enum value) const {
        for (const auto& [name, enumerator] : list) {
            if (enumerator == value) return std::string(name);
        }
        throw std::invalid_argument(std::string(option) + ": unknown value");
    }
};

inline constexpr Words<Method, 2> method_words{"method", {{{"global", Method::global}, {"paper", Method::paper}}}};
inline constexpr Words<Start, 6> solve_start_words{"start",
                                                   {{{"outline", Start::boundary},
                                                     {"given", Start::given},
                                                     {"kept", Start::kept},
                                                     {"least_variation", Start::least_variation},
                                                     {"loft", Start::loft},
                                                     {"smoothed", Start::smoothed}}}};
inline constexpr Words<Provenance, 8> provenance_words{"provenance",
                                                       {{{"equation", Provenance::equation},
                                                         {"low_passed", Provenance::low_passed},
                                                         {"least_variation", Provenance::least_variation},
                                                         {"loft", Provenance::loft},
                                                         {"least_bent", Provenance::least_bent},
                                                         {"swept_tube", Provenance::swept_tube},
                                                         {"old_shape", Provenance::old_shape},
                                                         {"first_surface", Provenance::first_surface}}}};
inline constexpr Words<NormalKind, 2> normal_words{
    "normals", {{{"fitted", NormalKind::fitted}, {"averaged", NormalKind::averaged}}}};
inline constexpr Words<Equation, 6> equation_words{"equation",
                                                   {{{"harmonic", Equation::harmonic},
                                                     {"constant", Equation::constant},
                                                     {"minimal_energy", Equation::minimal_energy},
                                                     {"soap_film", Equation::soap_film},
                                                     {"least_variation", Equation::least_variation},
                                                     {"automatic", Equation::automatic}}}};
inline constexpr Words<Otherwise, 2> otherwise_words{
    "otherwise", {{{"least_variation", Otherwise::least_variation}, {"stop", Otherwise::stop}}}};
// InnerFairness::custom has no word: it comes as rows.
inline constexpr Words<InnerFairness, 3> fairness_words{"inner_fairness",
                                                        {{{"uniform", InnerFairness::uniform},
                                                          {"conformal", InnerFairness::conformal},
                                                          {"inverse_distance", InnerFairness::inverse_distance}}}};
inline constexpr Words<bool, 2> border_words{"open_border", {{{"held", false}, {"faired", true}}}};
inline constexpr Words<Acceleration, 2> acceleration_words{
    "acceleration", {{{"anderson", Acceleration::anderson}, {"none", Acceleration::plain}}}};
inline constexpr Words<Termination, 4> termination_words{"termination",
                                                         {{{"converged", Termination::converged},
                                                           {"iteration_limit", Termination::iteration_limit},
                                                           {"stalled", Termination::stalled},
                                                           {"folded", Termination::folded}}}};

// The equation of a result, or of its stand-in.
inline std::string equation_of(const FairResult& result) {
    if (is_loft(result.provenance)) return "loft";
    if (result.provenance == Provenance::old_shape) return "smoothed";
    if (result.provenance == Provenance::first_surface) return "bilaplacian";
    return equation_words.word(result.equation);
}

}  // namespace fairing::bindings
