// Progress reports and cancellation. A run stops once its flag is raised, by the answer of its callback or from
// outside. Only the thread that made the Progress calls back; every thread sees the flag.
#pragma once

#include <atomic>
#include <chrono>
#include <concepts>
#include <functional>
#include <memory>
#include <string_view>

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

// Receives the finished fraction in [0, 1] and the name of the stage; returning false asks to stop. Anything that can
// be called so converts to it. It is not called again once it has returned false or thrown.
class ProgressCallback {
public:
    ProgressCallback() = default;  // no callback
    // `between`: least time between two calls from checkpoints; at zero, each of them calls.
    template <std::predicate<double, std::string_view> Function>
        requires(!std::same_as<std::remove_cvref_t<Function>, ProgressCallback>)
    ProgressCallback(Function function, std::chrono::milliseconds between = std::chrono::milliseconds{50})  // NOLINT
        : function_(std::move(function)), between_(between) {}

private:
    std::function<bool(double fraction, std::string_view stage)> function_;
    std::chrono::milliseconds between_{};
    friend class Progress;
};

// A view of a callback that maps [0, 1] onto a sub-range of the whole run: a stage doesn't depend on what comes before
// it. The fraction that callers see never decreases. Called at outer steps, around factorisations, at checkpoints.
class Progress {
public:
    Progress() = default;
    explicit Progress(ProgressCallback callback);

    // Reports, and throws what checkpoint() throws.
    void report(double fraction, std::string_view stage) const;
    [[nodiscard]] Progress range(double begin, double end) const;
    // For work inside a step: calls back without moving the fraction.
    [[nodiscard]] Progress here() const;

private:
    class Run;
    friend class Checkpoints;
    std::shared_ptr<Run> run_;
    double begin_ = 0.0;
    double end_ = 1.0;
};

// While it lives, checkpoint() in its thread reads a flag, and polls a progress if there is one.
class Checkpoints {
public:
    explicit Checkpoints(const Progress& progress) noexcept;
    explicit Checkpoints(const StopFlag* stop) noexcept;
    ~Checkpoints();
    Checkpoints(const Checkpoints&) = delete;
    Checkpoints& operator=(const Checkpoints&) = delete;

    struct Watch {
        const StopFlag* stop = nullptr;
        Progress::Run* run = nullptr;
    };

private:
    Watch previous_;
};

// The flag that checkpoint() reads in this thread; null where there is none.
[[nodiscard]] const StopFlag* stop_flag() noexcept;

// For every loop that may take long: polls the callback, every 50 ms at most. Throws Cancelled where the run is to
// stop, or what the callback has thrown.
void checkpoint();

// The same for loops of many short steps: `step` counts them.
inline void checkpoint(int step) {
    if (step % 4096 == 0) checkpoint();
}

// For waiting threads: polls as checkpoint() does, and raises the flag instead of throwing.
void ask_whether_to_stop() noexcept;

// Throws what checkpoint() throws, without polling.
void throw_if_stopped();

}  // namespace fairing
