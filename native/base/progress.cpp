#include "base/progress.h"

#include <exception>
#include <thread>

#include "base/errors.h"

namespace fairing {

namespace {

constinit thread_local Checkpoints::Watch watch;

}  // namespace

class Progress::Run {
public:
    explicit Run(ProgressCallback callback) : callback_(std::move(callback)), stop_(stop_flag()) {}

    [[nodiscard]] const StopFlag& stop() const noexcept { return stop_; }

    // An empty range leaves the fraction where it is.
    void report(double fraction, std::string_view stage) {
        if (is_mine() && !stop_.is_raised()) {
            last_ = std::max(last_, fraction);
            stage_ = stage;
            ask();
        }
        throw_if_stopped();
    }

    void ask_in_time() noexcept {
        if (is_mine() && !stop_.is_raised() && Clock::now() - asked_ >= callback_.between_) ask();
    }

    void throw_if_stopped() const {
        if (!stop_.is_raised()) return;
        if (is_mine() && failure_) std::rethrow_exception(failure_);
        throw Cancelled();
    }

private:
    using Clock = std::chrono::steady_clock;

    // Whether this thread calls back. Others pass here too: a factorisation of a helper reports.
    [[nodiscard]] bool is_mine() const noexcept { return std::this_thread::get_id() == thread_; }

    void ask() noexcept {
        const Checkpoints in_callback(&stop_);  // what it calls of the engine doesn't call it again
        try {
            if (!callback_.function_(last_, stage_)) stop_.raise();
        } catch (...) {
            failure_ = std::current_exception();
            stop_.raise();
        }
        asked_ = Clock::now();
    }

    const ProgressCallback callback_;
    StopFlag stop_;
    const std::thread::id thread_ = std::this_thread::get_id();
    std::exception_ptr failure_;  // what the callback has thrown
    double last_ = 0.0;
    std::string stage_ = "topology";  // the first stage of every run, until one is named
    Clock::time_point asked_ = Clock::now();
};

Progress::Progress(ProgressCallback callback) {
    if (callback.function_) run_ = std::make_shared<Run>(std::move(callback));
}

void Progress::report(double fraction, std::string_view stage) const {
    if (!run_) return throw_if_stopped();
    run_->report(begin_ + (end_ - begin_) * std::clamp(fraction, 0.0, 1.0), stage);
}

Progress Progress::range(double begin, double end) const {
    Progress inner = *this;
    inner.begin_ = begin_ + (end_ - begin_) * begin;
    inner.end_ = begin_ + (end_ - begin_) * end;
    return inner;
}

Progress Progress::here() const { return range(0.0, 0.0); }

Checkpoints::Checkpoints(const Progress& progress) noexcept : previous_(watch) {
    if (progress.run_) watch = {&progress.run_->stop(), progress.run_.get()};
}

Checkpoints::Checkpoints(const StopFlag* stop) noexcept : previous_(std::exchange(watch, {stop, nullptr})) {}

Checkpoints::~Checkpoints() { watch = previous_; }

const StopFlag* stop_flag() noexcept { return watch.stop; }

void ask_whether_to_stop() noexcept {
    if (watch.run) watch.run->ask_in_time();
}

void throw_if_stopped() {
    if (!watch.stop || !watch.stop->is_raised()) return;
    if (watch.run) watch.run->throw_if_stopped();
    throw Cancelled();
}

void checkpoint() {
    ask_whether_to_stop();
    throw_if_stopped();
}

}  // namespace fairing
