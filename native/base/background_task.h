// Background work of a thread, done by one of the helpers of its `Threads`.
#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>

#include "base/progress.h"

namespace fairing {

// Work that a helper may do while the caller's thread goes on; loops run without that helper meanwhile. Scoped like a
// std::jthread: its destructor stops the work and joins it. Declare it after all that the work refers to. What the work
// reads must not change until it is finished.
class BackgroundTask {
public:
    BackgroundTask() = default;  // no work
    // Loops within the work run on its own thread. checkpoint() in it throws where the caller's run or the task stops.
    explicit BackgroundTask(std::function<void()> work);
    BackgroundTask(BackgroundTask&&) = default;
    BackgroundTask& operator=(BackgroundTask&& other) noexcept;  // the work before ends first
    // Drops work that has not begun; other work stops at its next checkpoint.
    ~BackgroundTask();

    // Does the work here if it has not begun, else waits for it and polls the caller's progress meanwhile. Rethrows its
    // exception, or throws what checkpoint() throws where the run is to stop.
    void finish();

    class Work;  // shared with the team (base/parallel)

private:
    void end() noexcept;

    std::shared_ptr<Work> work_;
};

// Done by whoever takes it first. Nothing here but finish() throws.
class BackgroundTask::Work {
public:
    explicit Work(std::function<void()> work);

    // False where another thread has taken it.
    [[nodiscard]] bool take() noexcept { return !taken_.exchange(true); }
    // Called by whoever has taken it: a helper, whose checkpoints read this work's flag, or the task's own thread.
    void do_on_helper() noexcept;
    void do_here() noexcept;

    // Called by the task's own thread; `asks`: polls its progress meanwhile.
    void wait(bool asks) noexcept;
    void rethrow();
    void stop() noexcept { stop_.raise(); }

private:
    std::function<void()> work_;  // released once it is done: its captures may be large
    StopFlag stop_;
    std::atomic<bool> taken_ = false;
    std::atomic<bool> done_ = false;
    std::exception_ptr error_;
    std::mutex mutex_;
    std::condition_variable ended_;
};

}  // namespace fairing
