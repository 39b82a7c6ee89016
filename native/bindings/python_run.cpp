#include "bindings/python_run.h"

#include <chrono>
#include <condition_variable>
#include <mutex>

namespace fairing::bindings {

// The runs in progress in this process.
class Runs {
public:
    void enter(PythonRun& run) {
        const std::scoped_lock lock(mutex_);
        if (ends_in_ && *ends_in_ != run.thread_) throw Cancelled();
        runs_.push_back(&run);
    }

    void leave(PythonRun& run) noexcept {
        const std::scoped_lock lock(mutex_);
        std::erase(runs_, &run);
        left_.notify_all();
    }

    // Whether another thread ends the interpreter.
    bool is_over_for(const PythonRun& run) {
        const std::scoped_lock lock(mutex_);
        return ends_in_ && *ends_in_ != run.thread_;
    }

    // Without the GIL. Later runs of other threads are refused.
    void end() {
        // A callback takes less, unless it waits for this very thread, and so for ever. It is left to CPython.
        constexpr std::chrono::seconds patience{2};
        constexpr std::chrono::milliseconds between{10};
        std::unique_lock lock(mutex_);
        ends_in_ = std::this_thread::get_id();
        for (PythonRun* run : runs_) run->stop_.raise();
        left_.wait_for(lock, patience, [this] { return !any([](const PythonRun&) { return true; }); });
        while (any([](const PythonRun& run) { return !run.in_callback_; })) left_.wait_for(lock, between);
    }

private:
    // The runs of the other threads.
    template <typename Condition>
    [[nodiscard]] bool any(const Condition& condition) const {
        return std::any_of(runs_.begin(), runs_.end(),
                           [&](const PythonRun* run) { return run->thread_ != *ends_in_ && condition(*run); });
    }

    std::mutex mutex_;
    std::condition_variable left_;
    std::vector<PythonRun*> runs_;
    std::optional<std::thread::id> ends_in_;  // the thread that ends the interpreter
};

namespace {

// Never destroyed: threads may outlive the interpreter. Replaced in a fork's child.
Runs*& all_runs() {
    static Runs* runs = new Runs;
    return runs;
}

// Until the process ends, as CPython itself does from 3.14 on.
[[noreturn]] void sleep_for_ever() noexcept {
    while (true) std::this_thread::sleep_for(std::chrono::hours{1});
}

// python(), where CPython may end the thread because the interpreter has ended. Up to 3.13 glibc does that by an
// exception, which no destructor lets through and no `catch (...)` may keep: std::terminate. No one needs the thread
// any more, so it stays.
template <typename Python>
auto or_for_ever(const Python& python) noexcept {
    try {
        return python();
    } catch (...) {
        sleep_for_ever();
    }
}

// A callback that returns its fraction would cancel at 0: truth is asked of nothing but booleans, NumPy's included.
bool goes_on(const py::object& answer) {
    if (answer.is_none()) return true;
    py::detail::make_caster<bool> boolean;
    constexpr bool convert = false;  // only True and False are an answer
    if (!boolean.load(answer, convert)) {
        throw py::type_error("progress: the callback returned " + std::string(py::repr(answer)) +
                             "; False cancels, None or True goes on");
    }
    return py::detail::cast_op<bool>(boolean);
}

}  // namespace

PythonRun::PythonRun(py::object callback) : callback_(std::move(callback)), runs_(*all_runs()), stop_(stop_flag()) {
    runs_.enter(*this);
}

PythonRun::~PythonRun() { runs_.leave(*this); }

// A daemon thread that came back would print its exception to a stream that the end is about to close: that aborts.
void PythonRun::take_gil() noexcept {
    if (runs_.is_over_for(*this)) {
        runs_.leave(*this);
        sleep_for_ever();
    }
    or_for_ever([this] { PyEval_RestoreThread(state_); });
}

bool PythonRun::with_gil(const std::function<bool()>& python) {
    in_callback_ = true;
    take_gil();
    bool result = false;
    try {
        result = python();
    } catch (...) {
        failure_ = std::current_exception();
    }
    state_ = PyEval_SaveThread();
    in_callback_ = false;
    return result;
}

// `second` may be missing.
py::object PythonRun::answer(const py::object& receiver, const py::object& first, const py::object& second) {
    PyObject* const result =
        or_for_ever([&] { return PyObject_CallFunctionObjArgs(receiver.ptr(), first.ptr(), second.ptr(), nullptr); });
    if (!result) throw py::error_already_set();
    return py::reinterpret_steal<py::object>(result);
}

bool PythonRun::report(double fraction, std::string_view stage) {
    return with_gil([&] {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        return callback_.is_none() ||
               goes_on(answer(callback_, py::float_(fraction), py::str(stage.data(), stage.size())));
    });
}

void end_runs_at_exit() {
    const auto end = [] {
        const py::gil_scoped_release released;
        all_runs()->end();
    };
    py::module_::import("atexit").attr("register")(py::cpp_function(end));
    const py::module_ os = py::module_::import("os");
    if (!py::hasattr(os, "register_at_fork")) return;
    const auto forget = [] { all_runs() = new Runs; };
    os.attr("register_at_fork")(py::arg("after_in_child") = py::cpp_function(forget));
}

}  // namespace fairing::bindings
