// What a BackgroundTask and the team that does it share.
#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>

#include "base/background_task.h"
#include "base/stop_flag.h"

namespace fairing {

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
