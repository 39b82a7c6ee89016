#include "base/background_task.h"

#include <utility>

#include "base/parallel.h"
#include "base/spin_wait.h"

namespace fairing {

BackgroundTask::Work::Work(std::function<void()> work) : work_(std::move(work)), stop_(stop_flag()) {}

void BackgroundTask::Work::do_on_helper() noexcept {
    const Checkpoints checkpoints(&stop_);
    do_here();
}

void BackgroundTask::Work::do_here() noexcept {
    try {
        work_();
    } catch (...) {
        error_ = std::current_exception();
    }
    work_ = nullptr;
    const std::scoped_lock lock(mutex_);
    done_ = true;
    ended_.notify_all();
}

void BackgroundTask::Work::wait(bool asks) noexcept {
    const auto is_done = [this] { return done_.load(); };
    if (is_done()) return;
    if (asks) ask_whether_to_stop();
    if (SpinWait::until(is_done)) return;
    std::unique_lock lock(mutex_);
    while (!ended_.wait_for(lock, between_looks, is_done)) {
        if (!asks) continue;
        lock.unlock();
        ask_whether_to_stop();
        lock.lock();
    }
}

void BackgroundTask::Work::rethrow() {
    if (!error_) return;
    throw_if_stopped();  // what the callback has thrown, rather than that the helper has seen the flag
    std::rethrow_exception(std::exchange(error_, nullptr));
}

BackgroundTask::BackgroundTask(std::function<void()> work) : work_(std::make_shared<Work>(std::move(work))) {
    if (ThreadTeam::current) ThreadTeam::current->send(work_);
}

BackgroundTask::~BackgroundTask() { end(); }

BackgroundTask& BackgroundTask::operator=(BackgroundTask&& other) noexcept {
    if (this == &other) return *this;
    end();
    work_ = std::move(other.work_);
    return *this;
}

void BackgroundTask::end() noexcept {
    if (!work_) return;
    work_->stop();
    if (!work_->take()) work_->wait(false);
    work_.reset();
}

void BackgroundTask::finish() {
    if (!work_) return;
    work_->take() ? work_->do_here() : work_->wait(true);
    const std::shared_ptr<Work> ended = std::move(work_);
    ended->rethrow();
}

}  // namespace fairing
