// Whether work is to stop; any thread may raise and read it.
#pragma once

#include <atomic>

namespace fairing {

// Stays raised. A flag inside another one counts as raised where that is, and must not outlive it.
class StopFlag {
public:
    explicit StopFlag(const StopFlag* outer = nullptr) noexcept : outer_(outer) {}
    StopFlag(const StopFlag&) = delete;
    StopFlag& operator=(const StopFlag&) = delete;
    ~StopFlag() = default;

    // Nothing else is passed on by the flag: no order of memory is needed.
    void raise() noexcept { raised_.store(true, std::memory_order_relaxed); }
    [[nodiscard]] bool is_raised() const noexcept {
        return raised_.load(std::memory_order_relaxed) || (outer_ && outer_->is_raised());
    }

private:
    std::atomic<bool> raised_ = false;
    const StopFlag* outer_;
};

}  // namespace fairing
