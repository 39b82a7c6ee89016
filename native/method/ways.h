// The ways to a surface, in the order in which they are tried.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "base/progress.h"
#include "problem/problem.h"
#include "problem/solution.h"

namespace fairing {

struct ProxyStart;  // method/proxy_start

// What the ways before have come to.
struct Situation {
    struct Attempt {
        std::string_view strategy;
        bool produced;  // a surface, if none that was accepted
    };

    std::vector<Solution> found;  // none of them accepted
    std::vector<Attempt> attempts;
    std::shared_ptr<const ProxyStart> start = {};  // of the proxies, where a way has looked for it

    // The latest one on the user's own connectivity, or none.
    [[nodiscard]] const Solution* own_mesh() const;
    [[nodiscard]] bool attempted(std::string_view strategy) const;
    // Whether the strategy has made a surface, if none that was accepted.
    [[nodiscard]] bool produced(std::string_view strategy) const;
    [[nodiscard]] bool came_up_empty(std::string_view strategy) const {
        return attempted(strategy) && !produced(strategy);
    }
};

struct Way {
    const char* name;
    bool (*suits)(const Problem& problem, const Situation& situation);
    // Nothing where it sees at once that it does not suit this problem.
    std::optional<Solution> (*solve)(const Problem& problem, Situation& situation, const Progress& progress);
    double begin;  // shares of the time, for the progress
    double end;
};

// The first solution that is accepted (method/accept); where none is, the best that was found: one that converged
// before one that did not, of these the least bent. Its `ways` list all that were tried.
Solution run_ways(std::span<const Way> ways, const Problem& problem, const Progress& progress);

}  // namespace fairing
