#include <doctest/doctest.h>

#include <vector>

#include "base/errors.h"
#include "base/progress.h"

using namespace fairing;

TEST_CASE("sub-ranges map into their place and the fraction never goes back") {
    std::vector<double> seen;
    const Progress progress([&](double fraction, std::string_view) {
        seen.push_back(fraction);
        return true;
    });
    progress.range(0.5, 1.0).range(0.0, 0.5).report(1.0, "a");
    progress.range(0.0, 0.2).report(1.0, "b");
    progress.range(0.0, 0.2).here().report(0.7, "c");
    progress.report(2.0, "d");
    CHECK(seen == std::vector<double>{0.75, 0.75, 0.75, 1.0});
}

TEST_CASE("a callback that says no cancels; without one nothing happens") {
    const Progress progress([](double, std::string_view) { return false; });
    CHECK_THROWS_AS(progress.report(0.1, "x"), Cancelled);
    CHECK_NOTHROW(Progress().report(0.1, "x"));
}
