// A call of the engine from Python: without the GIL, with a callback, and finished before the interpreter ends.
#pragma once

#include <atomic>
#include <exception>
#include <thread>

#include "base/progress.h"
#include "bindings/convert.h"

namespace fairing::bindings {

class Runs;

// Made and left with the GIL held; declared before all else in a bound function, so that it lives as long as the call.
class PythonRun {
public:
    // Throws Cancelled where the interpreter has begun to end.
    explicit PythonRun(py::object callback = py::none());
    ~PythonRun();
    PythonRun(const PythonRun&) = delete;
    PythonRun& operator=(const PythonRun&) = delete;

    // Gives `receiver` the value from inside of work, with the GIL held meanwhile. An exception ends the run.
    template <typename Value>
    void give(const py::object& receiver, const Value& value) {
        if (!with_gil([&] { return answer(receiver, py::cast(value)), true; })) throw Cancelled();
    }

    // work(ProgressCallback) without the GIL; only its own thread calls back. A Python exception of the callback,
    // KeyboardInterrupt included, comes out in place of the Cancelled that it became.
    template <typename Work>
    auto without_gil(const Work& work) {
        try {
            const Released released(*this);
            const Checkpoints checkpoints(&stop_);
            return work([this](double fraction, std::string_view stage) { return report(fraction, stage); });
        } catch (const Cancelled&) {
            if (failure_) std::rethrow_exception(failure_);
            throw;
        }
    }

private:
    friend class Runs;

    struct Released {
        explicit Released(PythonRun& released_run) : run(released_run) { run.state_ = PyEval_SaveThread(); }
        ~Released() { run.take_gil(); }
        Released(const Released&) = delete;
        Released& operator=(const Released&) = delete;
        PythonRun& run;
    };

    void take_gil() noexcept;
    // False where it throws.
    bool with_gil(const std::function<bool()>& python);
    bool report(double fraction, std::string_view stage);
    static py::object answer(const py::object& receiver, const py::object& first, const py::object& second = {});

    py::object callback_;
    Runs& runs_;
    StopFlag stop_;
    const std::thread::id thread_ = std::this_thread::get_id();
    PyThreadState* state_ = nullptr;  // while the GIL is released
    std::atomic<bool> in_callback_ = false;
    std::exception_ptr failure_;  // a Python exception: destroyed with the GIL held
};

// Registers a hook with the interpreter: at its end it stops the runs of daemon threads and waits until they have left
// the engine. (It has joined all other threads by then.) A fork's child has none of its parent's runs.
void end_runs_at_exit();

}  // namespace fairing::bindings
