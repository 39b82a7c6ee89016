// Wall-clock time of stages.
#pragma once

#include <chrono>

namespace fairing {

class Stopwatch {
public:
    [[nodiscard]] double seconds() const { return since(start_); }

    // Seconds since the last lap, or since the start.
    double lap() {
        const double elapsed = since(lap_);
        lap_ = Clock::now();
        return elapsed;
    }

private:
    using Clock = std::chrono::steady_clock;
    static double since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

    Clock::time_point start_ = Clock::now();
    Clock::time_point lap_ = start_;
};

}  // namespace fairing
