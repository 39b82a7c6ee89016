// Work beside a thread's own, by one of the helpers of its `Threads`.
#pragma once

#include <functional>
#include <memory>

namespace fairing {

// Work that a helper may do beside the caller's thread; loops go on without that helper meanwhile. Scoped like a
// std::jthread: its end, an exception's too, stops the work and joins it. Declare it behind all that the work refers
// to, and what the work reads stays as it is until it is finished.
class BackgroundTask {
public:
    BackgroundTask() = default;  // no work
    // Loops within the work run on its own thread. checkpoint() in it throws where the caller's run or the task stops.
    explicit BackgroundTask(std::function<void()> work);
    BackgroundTask(BackgroundTask&&) = default;
    BackgroundTask& operator=(BackgroundTask&& other) noexcept;  // the work before ends first
    // Work that no one has begun is left out, other work stops at its next checkpoint.
    ~BackgroundTask();

    // Does the work here where no one has begun it. Waits for it otherwise, and asks the caller's progress meanwhile.
    // Once it has ended its exception comes through, or what checkpoint() throws where the run is to stop.
    void finish();

    class Work;  // shared with the team (base/thread_team)

private:
    void end() noexcept;

    std::shared_ptr<Work> work_;
};

}  // namespace fairing
