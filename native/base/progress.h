// Progress reports and cancellation.
#pragma once

#include <functional>
#include <memory>
#include <string_view>

namespace fairing {

// Receives the finished fraction in [0, 1] and the name of the stage; returning false asks to stop.
using ProgressCallback = std::function<bool(double fraction, std::string_view stage)>;

// A view of a callback that maps [0, 1] onto a sub-range of the whole run, so that a stage need not know its place.
// The fraction that callers see never decreases. Asked at every outer step, around each factorisation and at
// checkpoints.
class Progress {
public:
    Progress() = default;
    explicit Progress(ProgressCallback callback);

    // Reports and throws Cancelled when the callback says so.
    void report(double fraction, std::string_view stage) const;
    [[nodiscard]] Progress range(double begin, double end) const;
    // For work inside a step: asks whether to stop, without moving the fraction.
    [[nodiscard]] Progress here() const;

    // Asks whether to stop; fraction and stage stay what they are.
    void ask() const;

private:
    struct Shared;
    std::shared_ptr<Shared> shared_;
    double begin_ = 0.0;
    double end_ = 1.0;
};

// While it lives, checkpoint() in its thread asks this progress.
class Checkpoints {
public:
    explicit Checkpoints(const Progress& progress);
    ~Checkpoints();
    Checkpoints(const Checkpoints&) = delete;
    Checkpoints& operator=(const Checkpoints&) = delete;

private:
    struct Watch;
    static thread_local Watch* current;
    std::unique_ptr<Watch> watch_;
    Watch* previous_;
    friend void checkpoint();
};

// For every loop that may take long: asks, every 50 ms at most, whether to stop, and throws Cancelled then.
void checkpoint();

// The same for loops of many short steps: `step` counts them.
inline void checkpoint(int step) {
    if (step % 4096 == 0) checkpoint();
}

}  // namespace fairing
