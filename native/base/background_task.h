// Background work of a thread, done by one of the helpers of its `Threads`.
#pragma once

#include <functional>
#include <memory>

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

    class Work;  // shared with the team (base/thread_team)

private:
    void end() noexcept;

    std::shared_ptr<Work> work_;
};

}  // namespace fairing
