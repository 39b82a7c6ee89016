// Work beside a thread's own, and how it ends; `scripts/test --sanitize` runs these under the thread sanitizer too.
#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/background_task.h"
#include "base/errors.h"
#include "base/parallel.h"
#include "base/progress.h"

using namespace fairing;

namespace {

constexpr std::chrono::milliseconds always{0};

// Work that a helper is busy with until it is stopped, for three seconds at most, on data of its owner.
class Busy {
public:
    void operator()() {
        begun_ = true;
        try {
            for (int k = 0; k < 3000; ++k) {
                checkpoint();
                for (double& number : data_) number += 1.0;
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
        } catch (const Cancelled&) {
            stopped_ = true;
            throw;
        }
    }

    void wait_until_begun() const {
        while (!begun_) std::this_thread::yield();
    }

    [[nodiscard]] bool stopped() const { return stopped_; }

private:
    std::vector<double> data_ = std::vector<double>(100000, 1.0);
    std::atomic<bool> begun_ = false;
    std::atomic<bool> stopped_ = false;
};

// A solve that is cancelled while it waits for its helper.
struct Owner {
    Busy busy;
    BackgroundTask task;

    void run() {
        task = BackgroundTask([this] { busy(); });
        busy.wait_until_begun();
        task.finish();
    }
};

}  // namespace

TEST_CASE("threads: work beside a thread is done once, and its exception comes through when it is waited for") {
    for (const int threads : {1, 2, 4}) {
        const Threads team(threads);
        std::atomic<int> calls = 0;
        BackgroundTask first([&] { ++calls; });
        BackgroundTask second([&] { run_pieces(10, [&](int) { ++calls; }); });
        BackgroundTask failing([] { throw std::runtime_error("beside"); });
        std::atomic<int> sum = 0;
        run_pieces(50, [&](int k) { sum += k; });
        CHECK(sum == 49 * 25);
        CHECK_THROWS_AS(failing.finish(), std::runtime_error);
        second.finish();
        first.finish();
        first.finish();
        failing.finish();
        CHECK(calls == 11);
    }
}

TEST_CASE("threads: a call that is cancelled while it waits for a helper ends after the helper has") {
    const Threads team(2);
    int calls = 0;
    const Progress progress(ProgressCallback([&](double, std::string_view) { return ++calls < 2; }));
    const Checkpoints checkpoints(progress);
    // Outlives the call, so that a helper that goes on is seen by what it counts.
    std::optional<Owner> owner(std::in_place);
    CHECK_THROWS_AS(owner->run(), Cancelled);
    CHECK(owner->busy.stopped());
    CHECK(calls == 2);
    owner.reset();
}

TEST_CASE("threads: the end of a task stops it and waits for it, by whatever way") {
    const Threads team(2);
    Busy unasked;
    {
        const BackgroundTask task([&] { unasked(); });
        unasked.wait_until_begun();
    }
    CHECK(unasked.stopped());
    Busy left_by_exception;
    const auto leave = [&] {
        const BackgroundTask task([&] { left_by_exception(); });
        left_by_exception.wait_until_begun();
        throw std::runtime_error("another one");
    };
    CHECK_THROWS_AS(leave(), std::runtime_error);
    CHECK(left_by_exception.stopped());
    Busy replaced;
    BackgroundTask task([&] { replaced(); });
    replaced.wait_until_begun();
    int calls = 0;
    task = BackgroundTask([&] { ++calls; });
    CHECK(replaced.stopped());
    task.finish();
    CHECK(calls == 1);
}

TEST_CASE("threads: work that no one has begun is left out when its task ends") {
    int calls = 0;
    {
        const BackgroundTask task([&] { ++calls; });
    }
    CHECK(calls == 0);
}

TEST_CASE("threads: a helper's work stops with the run, though no one waits for it yet") {
    const Threads team(2);
    bool goes_on = true;
    const Progress progress(ProgressCallback([&](double, std::string_view) { return goes_on; }, always));
    const Checkpoints checkpoints(progress);
    Busy busy;
    BackgroundTask task([&] { busy(); });
    busy.wait_until_begun();
    goes_on = false;
    CHECK_THROWS_AS(checkpoint(), Cancelled);
    while (!busy.stopped()) std::this_thread::yield();
    CHECK_THROWS_AS(task.finish(), Cancelled);
}

TEST_CASE("threads: helpers within a loop stop with the run, and who waits for them asks") {
    const Threads team(2);
    int calls = 0;
    const Progress progress(ProgressCallback([&](double, std::string_view) { return ++calls < 3; }));
    const Checkpoints checkpoints(progress);
    Busy busy;
    const auto caller = std::this_thread::get_id();
    const auto piece = [&](int) {
        if (std::this_thread::get_id() == caller) {
            busy.wait_until_begun();
        } else {
            busy();
        }
    };
    CHECK_THROWS_AS(run_pieces(2, piece), Cancelled);
    CHECK(busy.stopped());
    CHECK(calls == 3);
}

TEST_CASE("threads: what the callback throws comes out, whoever has to stop for it") {
    const Threads team(2);
    const auto fail = [](double, std::string_view) -> bool { throw std::domain_error("mine"); };
    const Progress progress(ProgressCallback(fail, always));
    const Checkpoints checkpoints(progress);
    Owner owner;
    CHECK_THROWS_AS(owner.run(), std::domain_error);
    CHECK(owner.busy.stopped());
    CHECK_THROWS_AS(run_pieces(100, [](int) {}), std::domain_error);
    CHECK_THROWS_AS(progress.report(0.5, "a stage"), std::domain_error);
}

TEST_CASE("threads: only the thread that made a progress calls back") {
    std::atomic<int> calls = 0;
    std::atomic<bool> goes_on = true;
    const Progress progress(
        ProgressCallback([&](double, std::string_view) { return ++calls, goes_on.load(); }, always));
    progress.report(0.1, "a stage");
    const auto report = [&](bool& cancelled) {
        try {
            progress.report(0.2, "a stage");
        } catch (const Cancelled&) {
            cancelled = true;
        }
    };
    std::array<bool, 2> cancelled{};
    std::thread([&] { report(cancelled[0]); }).join();
    CHECK(calls == 1);
    goes_on = false;
    CHECK_THROWS_AS(progress.report(0.3, "a stage"), Cancelled);
    std::thread([&] { report(cancelled[1]); }).join();
    CHECK(calls == 2);
    CHECK_FALSE(cancelled[0]);
    CHECK(cancelled[1]);
}
