// A large value that is made on first use.
#pragma once

#include <functional>
#include <memory>
#include <utility>

namespace fairing {

// Made at the first access, by one thread at a time.
template <typename T>
class Deferred {
public:
    Deferred() : Deferred(T{}) {}
    Deferred(T value) : value_(std::make_shared<const T>(std::move(value))) {}  // NOLINT: as a T would
    explicit Deferred(std::function<T()> make) : make_(std::move(make)) {}

    const T& operator*() const {
        if (!value_) value_ = std::make_shared<const T>(make_());
        return *value_;
    }
    const T* operator->() const { return &**this; }

private:
    std::function<T()> make_;
    mutable std::shared_ptr<const T> value_;
};

}  // namespace fairing
