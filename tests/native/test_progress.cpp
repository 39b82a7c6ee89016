#include <doctest/doctest.h>

#include <chrono>
#include <thread>
#include <vector>

#include "base/errors.h"
#include "base/parallel.h"
#include "base/progress.h"

using namespace fairing;

TEST_CASE("checkpoints ask again where the last report was, in their own thread and while they live") {
    std::vector<std::string> stages;
    bool go_on = true;
    const Progress progress([&](double fraction, std::string_view stage) {
        CHECK(fraction == 0.25);
        stages.emplace_back(stage);
        return go_on;
    });
    const auto wait = [] { std::this_thread::sleep_for(std::chrono::milliseconds(60)); };
    progress.report(0.25, "a stage");
    {
        const Checkpoints checkpoints(progress);
        checkpoint();  // too early
        wait();
        std::thread([] { checkpoint(); }).join();
        CHECK(stages.size() == 1);
        checkpoint();
        CHECK(stages == std::vector<std::string>{"a stage", "a stage"});
        go_on = false;
        int pieces = 0;
        CHECK_THROWS_AS(run_pieces(10, [&](int) { ++pieces, wait(); }), Cancelled);
        CHECK(pieces == 1);
        const Threads team(2);
        CHECK_THROWS_AS(run_pieces(100, [&](int) { wait(); }), Cancelled);
    }
    wait();
    CHECK_NOTHROW(checkpoint());
}

TEST_CASE("without an interval every checkpoint asks, and no one is asked after a no") {
    int calls = 0;
    const Progress progress(
        ProgressCallback([&](double, std::string_view) { return ++calls < 3; }, std::chrono::milliseconds(0)));
    const Checkpoints checkpoints(progress);
    checkpoint();
    checkpoint();
    CHECK(calls == 2);
    for (int k = 0; k < 3; ++k) CHECK_THROWS_AS(checkpoint(), Cancelled);
    CHECK_THROWS_AS(progress.report(0.5, "a stage"), Cancelled);
    CHECK(calls == 3);
}

TEST_CASE("a flag from outside stops a run that is never asked, and one whose callback has nothing against it") {
    StopFlag flag;
    const Checkpoints outside(&flag);
    CHECK_NOTHROW(checkpoint());
    int calls = 0;
    const Progress progress([&](double, std::string_view) { return ++calls > 0; });
    {
        const Checkpoints inside(progress);
        progress.report(0.1, "a stage");
        flag.raise();
        CHECK_THROWS_AS(checkpoint(), Cancelled);
    }
    CHECK_THROWS_AS(progress.report(0.2, "a stage"), Cancelled);
    CHECK_THROWS_AS(Progress().report(0.2, "a stage"), Cancelled);
    CHECK_THROWS_AS(checkpoint(), Cancelled);
    CHECK(calls == 1);
}
